/* The hand behind a lock, where all that moves the box comes together: mouse, keys and gamepad from the
   window's thread, picture by picture, and motion devices from theirs, report by report. Each report becomes
   a command at once, also while a picture is being drawn; it finds the camera's axes as the window left them.
 */
#ifndef SLOSH_HAND_POST_H
#define SLOSH_HAND_POST_H

#include "app/held/held_devices.h"

typedef struct HandPost HandPost;

/* Sends the box there; returns the command's number, 0: it was not taken. Called on either thread, with the
   lock held: it must not block, nor call this file. */
typedef uint64_t HandSend(void *user, const BoxTarget *target);

/* `wake` is called on the devices' thread when there is news for the window; NULL: nothing is. NULL without
   memory. */
HandPost *hand_post_create(const Mapping *mapping, void (*wake)(void));
void hand_post_destroy(HandPost *post); /* NULL is allowed */

/* A scene is opened, or begins anew: the box is at home. Nothing is sent before the first hand_post_look, nor
   after hand_post_close. */
void hand_post_open(HandPost *post, HandSend *send, void *user);
void hand_post_close(HandPost *post);

/* The DeviceListener; `user` is the post. */
void hand_post_hear(void *user, const DeviceEvent *event);

enum { NEWS_COMMANDS_MAX = 16, NEWS_SENT_MAX = 64, NEWS_WORDS_MAX = 4, NEWS_WORDS_SIZE = HELD_PROBLEM_SIZE };

/* What the devices want of the window. */
typedef struct HandNews {
    double camera[3]; /* rates of 1 over their seconds: the scene goes to the right, up; nearer */
    int command_count;
    PlayCommand commands[NEWS_COMMANDS_MAX]; /* buttons pressed */
    int sent_count;
    struct {
        double when_ms; /* of the report */
        uint64_t number;
    } sent[NEWS_SENT_MAX]; /* commands that reports became */
    BoxTarget target;      /* where the box shall be, as it was last sent */
    int words_count;
    struct {
        bool wrong;
        char text[NEWS_WORDS_SIZE];
    } words[NEWS_WORDS_MAX]; /* who came and went */
} HandNews;

/* For each turn of the window's loop: `input` is what mouse, keys and gamepad say (its dt does not count),
   and the picture's axes; *news is what has come since the last call. Returns the number of the command that
   was sent, or 0. */
uint64_t hand_post_look(HandPost *post, const HandInput *input, const double box_size[3], HandNews *news);

void hand_post_home(HandPost *post);    /* the box goes home, upright however devices are held */
void hand_post_neutral(HandPost *post); /* the devices' present poses become the neutral ones */

/* hand_let_go, of what the window's keys and drags hold: devices go on. */
void hand_post_let_go(HandPost *post, const BoxTarget *now);

/* The box is at another time, and the hand holds it as it was wanted there: nothing is sent until something
   moves it. */
void hand_post_follow(HandPost *post, const BoxTarget *target);

/* Whether such a device is in use here: the window's gamepad of that kind is the same one. */
bool hand_post_claims(HandPost *post, uint16_t vendor, uint16_t product);

enum { HAND_POST_DEVICES_MAX = HELD_DEVICES_MAX };

/* A device, for the panel. */
typedef struct HandDevice {
    int number;
    DeviceFamily family;
    uint16_t vendor, product;
    char name[64];
    char problem[NEWS_WORDS_SIZE]; /* it may not be opened: why, and what would help; "" */
    DeviceState state;
    DeviceMap map;
    bool has_pose;             /* it has told how it is turned */
    double turned[4];          /* since its neutral pose: unit quaternion */
    double down[3];            /* which way gravity points in its frame: a unit vector */
    bool resting;              /* it lies still: its gyro is being calibrated */
    double axes[MAPPING_AXES]; /* -1 .. 1, as reported */
} HandDevice;

/* Those that are there now, in the order in which they came; how many. */
int hand_post_devices(HandPost *post, HandDevice devices[HAND_POST_DEVICES_MAX]);

/* Sets the gain and the dead zone of a device, and of those of its kind that come later. */
void hand_post_tune(HandPost *post, int number, double gain, double dead_zone);

/* Reports so far; from the call of hand_post_hear to its command sent, ms, of the last ones that became one:
   what `fraction` of them do not exceed; 0 without any. */
uint64_t hand_post_reports(HandPost *post);
double hand_post_latency(HandPost *post, double fraction);

#endif
