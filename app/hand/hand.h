/* The hand: from input devices to a target of the box. Pure: no device, window or clock.

   Each device adds its part to a HandInput. Drags and rates move the box permanently; offsets (sticks)
   move the box while they last, as does the turn of a device held like the box. The hand sums up all parts
   in the axes of the picture; the filter decides how fast the box follows (sim/box/box_filter.h). */
#ifndef SLOSH_HAND_H
#define SLOSH_HAND_H

#include "sim/box/box_filter.h"

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
void hand_let_go(Hand *hand, const BoxTarget *now, const HandInput *still, const double box_size[3]);

/* Sends the box home, upright, by the next hand_update. */
void hand_home(Hand *hand);

/* Applies dead zone and curve to a stick's two axes (-1 .. 1): fine near the middle, full at the rim. The
   direction stays, the length becomes 0 .. 1. Not finite: 0. */
void hand_stick(const double axes[2], double out[2]);

#endif
