/* From input to the pose of the box: motion devices alone (ControlDevices), all input of the window
   (BoxControl), and a recording of motion devices in simulated time (DeviceReplay). */
#ifndef APP_INPUT_BOX_CONTROL_H
#define APP_INPUT_BOX_CONTROL_H

#include "app/input/device/device.h"
#include "app/input/device/devices.h"
#include "app/input/device/report_log.h"
#include "app/input/hand.h"
#include "app/input/mapping.h"
#include "app/scene/scene.h"
#include "slosh/error.h"
#include "slosh/world.h"

enum { CONTROL_DEVICES_MAX = 8, CONTROL_PROBLEM_SIZE = 512, CONTROL_BUTTONS_MAX = 32 };

/* s without a report until a device's rates count as zero, as if released: a deflected device reports all
   the time, so the link is broken. 3Dconnexion's example programs do the same. */
#define CONTROL_SILENCE 0.5

/* Motion devices: from reports to a target of the box. Pure: no lock, thread or clock. */

typedef struct ControlDevice {
    int number; /* of DeviceEvent; 0: unused entry */
    DeviceFamily family;
    uint16_t vendor, product;
    char name[64];
    char problem[CONTROL_PROBLEM_SIZE]; /* why the device may not be opened, with advice; or "" */
    DeviceState state;
    DeviceMap map;
    Orientation orientation;
    double silent; /* s since its last report */
} ControlDevice;

typedef struct ControlDevices {
    Mapping mapping;
    Hand hand;
    HandInput own;      /* all other input for the box, and the picture's axes; without dt */
    double box_size[3]; /* m */
    ControlDevice list[CONTROL_DEVICES_MAX]; /* in the order of plugging in, without gaps */
    double left[4], without[4]; /* box orientation at the unplugging of the last turning device: with and
                                   without the device's turn */
} ControlDevices;

/* Starts without devices, the box at home. */
void control_devices_start(ControlDevices *devices, const Mapping *mapping);

/* Handles DEVICE_PLUGGED and DEVICE_REFUSED: adds a device, replacing refused devices of its kind. Returns
   false if there are too many. */
bool control_devices_add(ControlDevices *devices, const DeviceEvent *event);

/* Handles DEVICE_UNPLUGGED: the box stays at its last target, though no longer held there. Returns false,
   with *gone unchanged, if there is no such device. */
bool control_devices_remove(ControlDevices *devices, int number, ControlDevice *gone);

/* Handles DEVICE_REPORTED: takes over the state. A device's first pose replaces the pose left by an
   unplugged device, so that a device plugged in again does not count twice. Returns false if there is no
   such device. `pressed` gets the commands of newly pressed buttons. The pose takes effect in the next
   control_devices_update. */
bool control_devices_report(ControlDevices *devices, const DeviceEvent *event,
                            PlayCommand pressed[CONTROL_BUTTONS_MAX], int *pressed_count);

/* Advances by dt seconds. Returns true if *target has a new target. `camera` gains the rates of orbit
   right, up and zoom times dt. */
bool control_devices_update(ControlDevices *devices, double dt, double camera[3], BoxTarget *target);

void control_devices_neutral(ControlDevices *devices); /* makes the present poses neutral */
void control_devices_home(ControlDevices *devices);    /* likewise, and moves the box home, upright */

/* hand_release of all input except the devices, which go on. */
void control_devices_release(ControlDevices *devices, const BoxTarget *now);

/* Likewise, without reporting the new target as news. */
void control_devices_set_target(ControlDevices *devices, const BoxTarget *target);

/* True if the device moves the box. */
bool control_device_in_use(const ControlDevice *device);

/* The hand behind a lock: combines all input for the box. Mouse, keys and gamepad come from the window's
   thread, once per picture; motion devices from their threads, once per report. Each report becomes a
   command at once, even during a picture, using the camera's axes last set by the window. */

typedef struct BoxControl BoxControl;

/* Sends a target for the box; returns the command's number, 0: not accepted. Called on either thread, with
   the lock held: must not block or call functions of this file. */
typedef uint64_t BoxControlSend(void *user, const BoxTarget *target);

/* Creates the control. `wake` is called on the devices' thread on news for the window; may be NULL. Returns
   NULL if memory is short. */
BoxControl *box_control_create(const Mapping *mapping, void (*wake)(void));
void box_control_destroy(BoxControl *control); /* NULL is allowed */

/* box_control_open: a scene opens or restarts, with the box at home. Nothing is sent before the first
   box_control_update or after box_control_close. */
void box_control_open(BoxControl *control, BoxControlSend *send, void *user);
void box_control_close(BoxControl *control);

/* A DeviceListener; `user` is the BoxControl. */
void box_control_device_event(void *user, const DeviceEvent *event);

enum {
    BOX_CONTROL_COMMANDS_MAX = 16,
    BOX_CONTROL_SENT_MAX = 64,
    BOX_CONTROL_MESSAGES_MAX = 4,
    BOX_CONTROL_MESSAGE_SIZE = CONTROL_PROBLEM_SIZE
};

/* Requests of the devices to the window. */
typedef struct BoxControlNews {
    double camera[3]; /* speeds (1: full) integrated over time: the scene moves to the right, up; nearer */
    int command_count;
    PlayCommand commands[BOX_CONTROL_COMMANDS_MAX]; /* buttons pressed */
    int sent_count;
    struct {
        double when_ms; /* time of the report */
        uint64_t number;
    } sent[BOX_CONTROL_SENT_MAX]; /* commands made from reports */
    BoxTarget target;             /* last sent target of the box */
    int words_count;
    struct {
        bool wrong;
        char text[BOX_CONTROL_MESSAGE_SIZE];
    } words[BOX_CONTROL_MESSAGES_MAX]; /* messages about plugged and unplugged devices */
} BoxControlNews;

/* Call once per turn of the window's loop. `input`: mouse, keys and gamepad (without dt), and the
   picture's axes; *news gets all news since the last call. Returns the number of the sent command, or 0. */
uint64_t box_control_update(BoxControl *control, const HandInput *input, const double box_size[3],
                            BoxControlNews *news);

void box_control_home(BoxControl *control);    /* moves the box home, upright however devices are held */
void box_control_neutral(BoxControl *control); /* makes the devices' present poses neutral */

/* hand_release for the window's keys and drags; devices go on. */
void box_control_release(BoxControl *control, const BoxTarget *now);

/* The box has jumped to another time: the hand takes over the target of that time. Nothing is sent until
   an input moves the box. */
void box_control_set_target(BoxControl *control, const BoxTarget *target);

/* Returns true if such a device is in use: the window's gamepad of that kind is the same device. */
bool box_control_uses(BoxControl *control, uint16_t vendor, uint16_t product);

enum { BOX_CONTROL_DEVICES_MAX = CONTROL_DEVICES_MAX };

/* A device, as shown in the panel. */
typedef struct BoxControlDevice {
    int number;
    DeviceFamily family;
    uint16_t vendor, product;
    char name[64];
    char problem[BOX_CONTROL_MESSAGE_SIZE]; /* why the device may not be opened, with advice; or "" */
    DeviceState state;
    DeviceMap map;
    bool has_pose;             /* the orientation is known */
    double turned[4];          /* since the neutral pose: unit quaternion */
    double down[3];            /* direction of gravity in the device's frame: a unit vector */
    bool resting;              /* at rest: the gyro is being calibrated */
    double axes[MAPPING_AXES]; /* -1 .. 1, as reported */
} BoxControlDevice;

/* Fills in the present devices, in the order of plugging in; returns their count. */
int box_control_devices(BoxControl *control, BoxControlDevice devices[BOX_CONTROL_DEVICES_MAX]);

/* Sets gain and dead zone of a device, and of later devices of its kind. */
void box_control_tune(BoxControl *control, int number, double gain, double dead_zone);

/* box_control_reports: count of reports so far. box_control_latency: the quantile `fraction` of the delay
   from box_control_device_event to the sent command, ms, over the last reports with a command; 0 without any.
 */
uint64_t box_control_reports(BoxControl *control);
double box_control_latency(BoxControl *control, double fraction);

enum { DEVICE_REPLAY_HASH_SIZE = 17 };

/* Hash of a recording of motion devices, its mapping and its camera, for a resumed run must use the same:
   fills in 16 hexadecimal digits, equal for equal entries, mappings and axes (right, up, away). Returns
   false if memory is short. */
bool device_replay_hash(const ReportLog *log, const Mapping *mapping, const HandInput *axes,
                        char mark[DEVICE_REPLAY_HASH_SIZE]);

/* A recording of motion devices moves the box of a world without a window (`render`, `run`, `bench`), in
   simulated time: reports from t seconds after the recording's start are applied at time t, with the
   mapping, by ControlDevices. The target depends only on recording and time, not on steps,
   threads or clocks: two runs give the same bits, also if a run is resumed. */

typedef struct DeviceReplay DeviceReplay;

/* Opens a recording. `source`: of --device. `mapping`: of --mapping, or NULL (mapping_load). Right, left
   and away are those of the scene's camera. Returns NULL with the reason: recording or mapping missing or
   wrong. */
DeviceReplay *device_replay_open(const char *source, const char *mapping, const Scene *scene, Error *error);
void device_replay_close(DeviceReplay *replay); /* NULL is allowed */

/* Returns 16 digits identifying the recording, its mapping and the camera: device_replay_hash. NULL: "". */
const char *device_replay_mark(const DeviceReplay *replay);

/* Returns the target of a box of the given size (m) at `time` (s). Before the first report the box is at
   home, after the recording's end the box stays. A time earlier than in the last call restarts the
   recording. */
BoxTarget device_replay_target(DeviceReplay *replay, const double box_size[3], double time);

/* Calls world_set_target for the present time; call before a step of the world. NULL: does nothing. */
void device_replay_apply(DeviceReplay *replay, World *world);

#endif
