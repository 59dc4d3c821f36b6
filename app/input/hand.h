/* The hand: from input devices to a target of the box. Pure: no device, window or clock.

   Each device adds its part to a HandInput. Drags and rates move the box permanently; offsets (sticks)
   move the box while they last, as does the turn of a device held like the box. The hand sums up all parts
   in the axes of the picture; the filter decides how fast the box follows (include/slosh/def.h). */
#ifndef APP_INPUT_HAND_H
#define APP_INPUT_HAND_H

#include "render/frame/camera.h"
#include "render/frame/picture_def.h"
#include "slosh/def.h"

#include <stdbool.h>

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
    BoxTarget told; /* target of the last call that returned true */
} Hand;

/* Returns a hand with the box at home, upright. */
Hand hand_at_rest(void);

/* Processes input. Returns true if *target is new and a command must be sent; false if *target equals the
   last target. Input with infinite values or NaN is ignored as a whole. */
bool hand_update(Hand *hand, const HandInput *input, const double box_size[3], BoxTarget *target);

/* Call when the focus is lost, a drag is aborted, or a device is gone: the held target becomes the present
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

/* Begins with the picture of camera_make (render/frame/camera.h) for the same arguments, automatic or not.
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

/* Fills in unit vectors of the picture in the world, for HandInput (app/input/hand.h): right is horizontal,
   up is in the picture's plane, away is horizontal into the picture. */
void orbit_axes(const Orbit *orbit, double right[3], double up[3], double away[3]);

/* Returns the size of a pixel at the distance of the box's centre, m, in a picture `height` pixels high. */
double orbit_metres_per_pixel(const Orbit *orbit, const double box_size[3], const BoxState *box, int height);

/* Outline of the box at the hand's target, beside the drawn box: while time is paused or slow the box
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

#endif
