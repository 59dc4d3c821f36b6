/* From input devices to the box, the camera and the fluid. Here are the hand (HandInput), mappings of motion
   devices (Mapping), control of the box by all devices (BoxControl), and the touch tool. */
#ifndef APP_INPUT_INPUT_H
#define APP_INPUT_INPUT_H

#include "app/input/actions.h"
#include "app/input/device/device.h"
#include "app/run/recording/recording.h"
#include "app/scene/scene.h"
#include "render/frame/frame.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/flow/flow.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* The hand: from input devices to a target of the box. Pure: no device, window or clock.

   Each device adds its part to a HandInput. Drags and rates move the box permanently; offsets (sticks)
   move the box while they last, as does the turn of a device held like the box. The hand sums up all parts
   in the axes of the picture; the filter decides how fast the box follows (sim/def.h). */

/* Input of all devices since the last call. Zero: devices at rest. */
typedef struct HandInput {
    double dt;              /* wall seconds since the last call, at most HAND_DT_MOST */
    double right[3], up[3]; /* unit vectors of the picture in the world; right is horizontal */
    double away[3];         /* unit vector: horizontally into the picture */
    double move_drag[2];    /* m along right and up */
    double turn_drag[2];    /* rad by which the near face moves to the right and up */
    double move_rate[3];    /* -1 .. 1 along right, the world's y, away, while keys are held */
    double tilt_rate[2];    /* -1 .. 1: the top goes to the right; away */
    double move_offset[3];  /* -1 .. 1 along right, the world's y, away, while the stick is deflected */
    double tilt_offset[2];  /* -1 .. 1: the top leans to the right; away */
    double spin_rate;       /* -1 .. 1: around the world's y, the near face moves to the right */
    double spin_offset;     /* -1 .. 1: the same, while deflected */
    double turned[4]; /* quaternion x y z w: turn of a device in the user's frame: x to the right, y up, z
                         towards the user; any length, 0: none */
} HandInput;

#define HAND_DT_MOST    0.25 /* s: after a stall a held key must not throw the box */
#define HAND_SPEED      1.0  /* longest sides of the box per second, at rate 1 */
#define HAND_TURN_SPEED 90.0 /* degrees per second, at rate 1 */
#define HAND_SWAY       0.5  /* longest sides, at offset 1 */
#define HAND_LEAN       45.0 /* degrees, at offset 1 */
#define HAND_REACH      3.0  /* longest sides: greatest distance from home, so that the box is never lost */
#define HAND_DEAD_ZONE  0.15 /* of a stick's range: worn sticks do not return to 0 */

typedef struct Hand {
    BoxTarget held; /* target without the offsets of sticks */
    BoxTarget sent; /* target of the last call that returned true */
} Hand;

/* Returns a hand with the box at home, upright. */
Hand hand_at_rest(void);

/* Processes input. Returns true if *target is new and a command must be sent; false if *target equals the
   last target. Input with infinite values or NaN is ignored as a whole. */
bool hand_update(Hand *hand, const HandInput *input, const double box_size[3], BoxTarget *target);

/* Call when the focus is lost, a drag is aborted, or a device is gone. The held target becomes the present
   pose of the box (of its BoxFilter, or the last target), so that the box stops. The next hand_update
   returns the target. `still`: continuing offsets and turn, to be added again later; may be NULL. A pose
   that is not finite is ignored. */
void hand_release(Hand *hand, const BoxTarget *now, const HandInput *still, const double box_size[3]);

/* Sends the box home, upright, by the next hand_update. */
void hand_home(Hand *hand);

/* Applies dead zone and curve to a stick's two axes (-1 .. 1): fine near the middle, full at the rim. The
   direction stays, the length becomes 0 .. 1. Not finite: 0. */
void hand_stick(const double axes[2], double out[2]);

/* The camera in the hand: an orbit around a pivot. Pure: only writes the camera of a ViewDef. */

typedef struct Orbit {
    double pivot[3];          /* m, world */
    double distance;          /* m, from the eye to the plane through the pivot parallel to the picture */
    double yaw;               /* rad around y; 0: seen from +z, a quarter turn: from +x */
    double pitch;             /* radians, -pi/2 .. pi/2: above the horizon */
    double beyond;            /* rad of the drag beyond a pole, where the eye stops */
    double shift[2];          /* offset of the eye from the pivot, right and up, in units of the distance: an
                                 automatic camera makes room for the legend */
    double fov_deg;           /* vertical field of view, degrees */
    double nearest, farthest; /* bounds of the distance, m */
} Orbit;

/* Begins with the picture of camera_make (render/frame/frame.h) for the same arguments, automatic or not.
   The pivot is the box's centre, or the target of the def's own camera. */
Orbit orbit_begin(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                  CoveredParts covered);

/* Drags the scene by radians to the right and up; the eye stops short of the poles, and a drag there and
   back ends at its start. All three functions ignore numbers that are not finite. */
void orbit_turn(Orbit *orbit, double right, double up);

/* Call at the start of a drag: forgets how far the last drag went beyond a pole. */
void orbit_begin_drag(Orbit *orbit);

/* Drags the scene by picture heights to the right and up: points in the plane of the pivot follow the
   mouse. */
void orbit_pan(Orbit *orbit, double right, double up);

/* Moves nearer by a tenth per step, within bounds; negative: farther. */
void orbit_zoom(Orbit *orbit, double steps);

/* Writes the camera into the def. */
void orbit_apply(const Orbit *orbit, ViewDef *def);

/* Fills in unit vectors of the picture in the world, for HandInput: right is horizontal,
   up is in the picture's plane, away is horizontal into the picture. */
void orbit_axes(const Orbit *orbit, double right[3], double up[3], double away[3]);

/* Returns the size of a pixel at the distance of the box's centre, m, in a picture `height` pixels high. */
double orbit_metres_per_pixel(const Orbit *orbit, const double box_size[3], const BoxState *box, int height);

/* Outline of the box at the hand's target, beside the drawn box. While time is paused or slow the box
   follows much later, and users would move it blindly without an outline. Pure. */

enum { OUTLINE_EDGES = 12 };

/* Fills in the box's pose at `time` after reaching the target: prescribed motions plus the hand's part.
   `box_height` in m. */
void outline_pose(const Motion motions[], int count, double box_height, double time, const BoxTarget *target,
                  BoxState *pose);

/* Returns the greatest distance between corresponding corners, in longest sides of the box. */
double outline_distance(const BoxState *a, const BoxState *b, const double box_size[3]);

/* Returns true if the outline must be visible: appears when the box lags behind the hand, paused or slow,
   and stays until the box arrives. `apart`: from outline_distance. */
bool outline_is_needed(bool shown, bool lags, double apart);

/* Fills in both ends of an edge in the box's frame, m. */
void outline_edge(const double box_size[3], int edge, double a[3], double b[3]);

/* Mapping: the effect of a motion device's axes, buttons and pose. Built in per family, changeable by a
   small YAML file and in the panel. Pure, except the functions with a path.

   An axis passes dead zone, curve, gains and inversion, then moves or turns the box or the camera. All
   directions are the user's: x to the right, y up, z towards the user, right-handed turns: a cap pushed to
   the right moves the box to the right of the picture. */

/* In the order of mapping_to_name. */
typedef enum MapTo {
    MAP_NOTHING,
    MAP_MOVE_X,
    MAP_MOVE_Y,
    MAP_MOVE_Z,
    MAP_TURN_X,
    MAP_TURN_Y,
    MAP_TURN_Z,
    MAP_ORBIT_X, /* of the camera, speeds only: the scene moves to the right */
    MAP_ORBIT_Y, /* up */
    MAP_ZOOM     /* nearer */
} MapTo;

typedef enum MapAs {
    MAP_RATE,  /* a speed: the box stays where it was moved */
    MAP_OFFSET /* an offset or angle while the axis is deflected */
} MapAs;

typedef struct AxisMap {
    int to, as;  /* MapTo, MapAs */
    double gain; /* 0 .. 10 */
    bool invert;
} AxisMap;

enum {
    MAPPING_AXES = 6,
    MAPPING_BUTTONS_MAX = 48, /* button names of a family, over all products */
    MAPPING_OWN_MAX = 8       /* products with their own entry */
};

typedef struct ButtonMap {
    const char *name;         /* from device_rows */
    const UserAction *action; /* NULL: nothing */
} ButtonMap;

typedef struct DeviceMap {
    DeviceFamily family;
    double gain;      /* for all axes and the pose, 0 .. 10 */
    double dead_zone; /* fraction of an axis's range, 0 .. 0.9 */
    double curve;     /* exponent, 1 .. 5; 1: linear; 2: square, fine near the middle */
    AxisMap axes[MAPPING_AXES];
    int pose;         /* true if the box follows the device's turn */
    double pose_gain; /* box's angle over the device's angle, 0 .. 4 */
    int button_count;
    ButtonMap buttons[MAPPING_BUTTONS_MAX];
} DeviceMap;

typedef struct Mapping {
    DeviceMap family[DEVICE_FAMILY_COUNT];
    int own_count;
    struct OwnMap {
        uint16_t vendor, product;
        DeviceMap map;
    } own[MAPPING_OWN_MAX];
} Mapping;

/* Fills in the built-in mapping. */
void mapping_default(Mapping *mapping);

/* Returns the product's own entry, or its family's. */
DeviceMap *mapping_of(Mapping *mapping, DeviceFamily family, uint16_t vendor, uint16_t product);

/* Names of the family's axes, and the axis values of a state: -1 .. 1. */
const char *mapping_axis_name(DeviceFamily family, int axis);
void mapping_axis_values(DeviceFamily family, const DeviceState *state, double values[MAPPING_AXES]);
const char *mapping_to_name(int to); /* NULL after the last */
bool mapping_has_pose(DeviceFamily family);

/* Applies dead zone, curve, gains and inversion to an axis's value. Infinite values and NaN count as 0. */
double mapping_shape(const DeviceMap *map, int axis, double value);

/* Adds the axes of a state to the hand's rates and offsets, and to the camera's speeds: orbit right and
   up, zoom; range -1 .. 1 and beyond. */
void mapping_add(const DeviceMap *map, const DeviceState *state, HandInput *hand, double camera[3]);

/* Computes the box's turn from a device turned by `turned`: unit quaternions x y z w. */
void mapping_pose(const DeviceMap *map, const double turned[4], double out[4]);

/* Returns the action of the product's button in bit `bit`, or NULL. */
const UserAction *mapping_button(const DeviceMap *map, uint16_t vendor, uint16_t product, int bit);

/* Reads a file's text on top of the built-in mapping; `path` is for messages. Returns false with
   "path:line:column: problem; advice", and *mapping unchanged. */
bool mapping_parse(const char *path, const char *bytes, size_t size, Mapping *mapping, Error *error);

/* Loads the file at `path`. NULL: the user's own file ($XDG_CONFIG_HOME/slosh/mapping.yaml or
   ~/.config/slosh/mapping.yaml) if it exists, else the built-in mapping. */
bool mapping_load(const char *path, Mapping *mapping, Error *error);

/* Makes the path of the user's own file; returns false if no folder is known, or the path is too long. */
bool mapping_user_path(char path[1024]);

/* Writes the mapping as a file for mapping_parse, with comments. */
void mapping_write(const Mapping *mapping, FILE *file);

/* Writes the mapping into a new file; an existing file is an error and stays. */
bool mapping_write_new(const Mapping *mapping, const char *path, Error *error);

/* Describes each axis and button in words. */
void mapping_explain(const Mapping *mapping, FILE *file);

/* From input to the pose of the box: motion devices alone (ControlDevices), all input of the window
   (BoxControl), and a recording of motion devices in simulated time (DeviceReplay). */

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
   such device. `pressed` gets the actions of newly pressed buttons. The pose takes effect in the next
   control_devices_update. */
bool control_devices_report(ControlDevices *devices, const DeviceEvent *event,
                            const UserAction *pressed[CONTROL_BUTTONS_MAX], int *pressed_count);

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
    BOX_CONTROL_ACTIONS_MAX = 16,
    BOX_CONTROL_SENT_MAX = 64,
    BOX_CONTROL_MESSAGES_MAX = 4,
    BOX_CONTROL_MESSAGE_SIZE = CONTROL_PROBLEM_SIZE
};

/* Requests of the devices to the window. */
typedef struct BoxControlNews {
    double camera[3]; /* speeds (1: full) integrated over time: the scene moves to the right, up; nearer */
    int action_count;
    const UserAction *actions[BOX_CONTROL_ACTIONS_MAX]; /* of the pressed buttons */
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

/* Hash of a recording of motion devices, its mapping and its camera, for a resumed run must use the same.
   Fills in 16 hexadecimal digits, equal for equal entries, mappings and axes (right, up, away). Returns
   false if memory is short. */
bool device_replay_hash(const ReportLog *log, const Mapping *mapping, const HandInput *axes,
                        char mark[DEVICE_REPLAY_HASH_SIZE]);

/* A recording of motion devices moves the box of a world without a window (`render`, `run`, `bench`), in
   simulated time. Reports from t seconds after the recording's start are applied at time t, with the
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

/* What a drag of the mouse does inside the box: the touch tool, with a finger in the fluid (TouchTool), a
   solid in the hand (SolidDrag), and walls as handles. Pure: no window, no GL. Positions are in the box's
   frame, m. */

/* Solids in the hand: the mouse grabs a solid, and moves it in the plane facing the camera, or turns it.
   Pure: no window, no GL. Positions are in the box's frame, m. */

/* Zero-initialise before use. */
typedef struct SolidDrag {
    bool pressed; /* a drag has begun */
    bool holds;   /* and has grabbed a solid: */
    bool turns;   /* true: turns the solid; false: moves it */
    int solid;
    int dimensions;
    double reach;            /* of the solid, m */
    double from[3];          /* where the mouse grabbed the solid */
    double at[3], turn[4];   /* the hand's part of the solid's pose at the grab */
    double forward[3];       /* direction of the camera at the grab */
    double sent[3], spun[4]; /* last sent */
} SolidDrag;

/* Returns the first solid on the ray at `time` (s), and the hit point; -1: none. `floating`: poses of
   floating solids (WorldInfo), indexed like the def's solids. */
int solid_drag_under(const WorldDef *def, double time, const BoxState *floating, const SightRay *ray,
                     double at[3]);

/* Begins a drag, and grabs the solid on the ray; returns false if there is none. */
bool solid_drag_press(SolidDrag *hold, const WorldDef *def, double time, const BoxState *floating,
                      const SightRay *ray, const double forward[3], bool turns);

/* Moves the mouse; returns true if `command` must be sent. */
bool solid_drag_move(SolidDrag *hold, const SightRay *ray, SolidCommand *command);

void solid_drag_release(SolidDrag *hold);

/* The walls of the box as handles: an arrow on each movable wall, dragged along the wall's normal. The
   floor stays; opposite walls move together, as the middle of the floor stays. */

enum { WALL_HANDLES_MAX = 5 };

/* Fills in the arrows of the walls that are not open; returns their count. */
int wall_handles(const double size[3], const bool open[3], int dimensions, Handle handles[WALL_HANDLES_MAX]);

/* Handles a drag of the arrow `taken` to `at`: `size` gets the new box size, at least `least` along the
   axis. */
void wall_drag(const Handle *taken, const double at[3], double least, double size[3]);

/* The touch tool: a finger put into the fluid by a mouse drag. Pure: no window, no GL. Positions are in
   the box's frame, m. */

/* Zero-initialise before use. */
typedef struct TouchTool {
    bool on;          /* drags belong to the tool */
    bool holds;       /* a drag has a position: */
    bool spent;       /* time has jumped during the drag: the drag has no more effect */
    FingerWay way;    /* effect of the finger */
    double at[3];     /* position of the pointer; without a drag, where a drag would begin */
    Finger sent;      /* last sent */
    SolidDrag hold;   /* a grabbed solid, instead of the finger */
    unsigned travels; /* count of time jumps seen */
    bool scripted;    /* a recorded session was played at that time */
} TouchTool;

/* A further effect of the left button, besides the ways of a finger: grabbing solids. Numbered like a
   FingerWay less one. */
enum { TOUCH_TOOL_SOLIDS = FINGER_POUR };

/* Returns the effect of the second button: pull, or push if `way` is pull. */
FingerWay touch_tool_other(FingerWay way);

/* Begins a drag with the given effect, at a position. */
void touch_tool_press(TouchTool *tool, FingerWay way, const double at[3]);

/* Ends the drag. `behind`: later states are kept, and would be cut off by an end command. */
void touch_tool_release(TouchTool *tool, bool behind);

/* Removes the finger: the scene restarts, or another scene is open. */
void touch_tool_reset(TouchTool *tool);

/* Reports the count of time jumps: after a jump a drag has no more effect. While a recorded session is
   played, its commands count as jumps, and the drag takes over. */
void touch_tool_travel(TouchTool *tool, unsigned travels, bool scripted);

/* Moves the tool to the point where `ray` meets the plane through the tool's position facing a camera
   looking along `forward`, or the plane of a two-dimensional fluid. Returns false if the ray misses. */
bool touch_tool_move(TouchTool *tool, const SightRay *ray, const double forward[3], int dimensions);

/* Fills in the finger to send; returns false if the last sent finger still applies. */
bool touch_tool_finger(TouchTool *tool, const TouchDef *def, double spacing, Finger *finger);

/* Returns the outline of the ball, or of the poured fluid, seen along `forward`. */
Handle touch_tool_outline(const TouchTool *tool, const TouchDef *def, double spacing,
                          const double forward[3]);

/* Returns `value` changed by notches of the wheel, within the key's bounds. */
double touch_tool_notches(double value, double notches, double least, double most);

#endif
