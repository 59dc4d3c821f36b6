/* The hand behind a lock: combines all input for the box. Mouse, keys and gamepad come from the window's
   thread, once per picture; motion devices from their threads, once per report. Each report becomes a
   command at once, even during a picture, using the camera's axes last set by the window. */
#ifndef SLOSH_HAND_POST_H
#define SLOSH_HAND_POST_H

#include "app/held/held_devices.h"

typedef struct HandPost HandPost;

/* Sends a target for the box; returns the command's number, 0: not accepted. Called on either thread, with
   the lock held: must not block or call functions of this file. */
typedef uint64_t HandSend(void *user, const BoxTarget *target);

/* Creates the post. `wake` is called on the devices' thread on news for the window; may be NULL. Returns
   NULL if memory is short. */
HandPost *hand_post_create(const Mapping *mapping, void (*wake)(void));
void hand_post_destroy(HandPost *post); /* NULL is allowed */

/* hand_post_open: a scene opens or restarts, with the box at home. Nothing is sent before the first
   hand_post_look or after hand_post_close. */
void hand_post_open(HandPost *post, HandSend *send, void *user);
void hand_post_close(HandPost *post);

/* A DeviceListener; `user` is the post. */
void hand_post_hear(void *user, const DeviceEvent *event);

enum { NEWS_COMMANDS_MAX = 16, NEWS_SENT_MAX = 64, NEWS_WORDS_MAX = 4, NEWS_WORDS_SIZE = HELD_PROBLEM_SIZE };

/* Requests of the devices to the window. */
typedef struct HandNews {
    double camera[3]; /* speeds (1: full) integrated over time: the scene moves to the right, up; nearer */
    int command_count;
    PlayCommand commands[NEWS_COMMANDS_MAX]; /* buttons pressed */
    int sent_count;
    struct {
        double when_ms; /* time of the report */
        uint64_t number;
    } sent[NEWS_SENT_MAX]; /* commands made from reports */
    BoxTarget target;      /* last sent target of the box */
    int words_count;
    struct {
        bool wrong;
        char text[NEWS_WORDS_SIZE];
    } words[NEWS_WORDS_MAX]; /* messages about plugged and unplugged devices */
} HandNews;

/* Call once per turn of the window's loop. `input`: mouse, keys and gamepad (without dt), and the
   picture's axes; *news gets all news since the last call. Returns the number of the sent command, or 0. */
uint64_t hand_post_look(HandPost *post, const HandInput *input, const double box_size[3], HandNews *news);

void hand_post_home(HandPost *post);    /* moves the box home, upright however devices are held */
void hand_post_neutral(HandPost *post); /* makes the devices' present poses neutral */

/* hand_let_go for the window's keys and drags; devices go on. */
void hand_post_let_go(HandPost *post, const BoxTarget *now);

/* The box has jumped to another time: the hand takes over the target of that time. Nothing is sent until
   an input moves the box. */
void hand_post_follow(HandPost *post, const BoxTarget *target);

/* Returns true if such a device is in use: the window's gamepad of that kind is the same device. */
bool hand_post_claims(HandPost *post, uint16_t vendor, uint16_t product);

enum { HAND_POST_DEVICES_MAX = HELD_DEVICES_MAX };

/* A device, as shown in the panel. */
typedef struct HandDevice {
    int number;
    DeviceFamily family;
    uint16_t vendor, product;
    char name[64];
    char problem[NEWS_WORDS_SIZE]; /* why the device may not be opened, with advice; or "" */
    DeviceState state;
    DeviceMap map;
    bool has_pose;             /* the orientation is known */
    double turned[4];          /* since the neutral pose: unit quaternion */
    double down[3];            /* direction of gravity in the device's frame: a unit vector */
    bool resting;              /* at rest: the gyro is being calibrated */
    double axes[MAPPING_AXES]; /* -1 .. 1, as reported */
} HandDevice;

/* Fills in the present devices, in the order of plugging in; returns their count. */
int hand_post_devices(HandPost *post, HandDevice devices[HAND_POST_DEVICES_MAX]);

/* Sets gain and dead zone of a device, and of later devices of its kind. */
void hand_post_tune(HandPost *post, int number, double gain, double dead_zone);

/* hand_post_reports: count of reports so far. hand_post_latency: the quantile `fraction` of the delay from
   hand_post_hear to the sent command, ms, over the last reports with a command; 0 without any. */
uint64_t hand_post_reports(HandPost *post);
double hand_post_latency(HandPost *post, double fraction);

#endif
