/* The hand: from what input devices say to where the box shall be. Pure: no device, no window, no clock.

   Each device adds its part to a HandInput: drags and rates move the box for good; offsets (sticks) move it
   for as long as they last, and so does the turn of a device that is held like the box. The hand sums them up
   in the axes of the picture; how fast the box follows is the filter's affair (sim/box/box_filter.h). */
#ifndef SLOSH_HAND_H
#define SLOSH_HAND_H

#include "sim/box/box_filter.h"

#include <stdbool.h>

/* What all devices say since the last call. Zero is a device at rest. */
typedef struct HandInput {
    double dt;              /* wall seconds since the last call; more than HAND_DT_MOST count as that */
    double right[3], up[3]; /* unit vectors of the picture in the world; right is horizontal */
    double away[3];         /* unit vector: horizontally into the picture */
    double move_drag[2];    /* m along right and up */
    double turn_drag[2];    /* radians by which the near face goes to the right and up */
    double move_rate[3];    /* -1 .. 1 along right, the world's y, away, while keys are held */
    double tilt_rate[2];    /* -1 .. 1: the top goes to the right; away */
    double move_offset[3];  /* -1 .. 1 along right, the world's y, away, as long as the stick is held */
    double tilt_offset[2];  /* -1 .. 1: the top leans to the right; away */
    double spin_rate;       /* -1 .. 1: about the world's y, the near face goes to the right */
    double spin_offset;     /* -1 .. 1: the same, as long as it is held */
    double turned[4]; /* quaternion x y z w: how a device is turned, in the user's frame: x to the right,
                         y up, z towards him; of any length, 0: there is none */
} HandInput;

#define HAND_DT_MOST    0.25 /* s: after a stall a held key must not throw the box */
#define HAND_SPEED      1.0  /* longest sides of the box a second, at rate 1 */
#define HAND_TURN_SPEED 90.0 /* degrees a second, at rate 1 */
#define HAND_SWAY       0.5  /* longest sides, at offset 1 */
#define HAND_LEAN       45.0 /* degrees, at offset 1 */
#define HAND_REACH      3.0  /* longest sides: no farther from home, so that the box is never lost */
#define HAND_DEAD_ZONE  0.15 /* of a stick's way: worn sticks do not come to rest at 0 */

typedef struct Hand {
    BoxTarget held; /* without the offsets of sticks */
    BoxTarget told; /* what the last call that returned true gave */
} Hand;

/* The box at home, upright. */
Hand hand_at_rest(void);

/* Takes the input in. True: *target is where the box shall be and a command is to be sent; false: *target is
   what it was when last told. Input that is not finite is ignored as a whole. */
bool hand_update(Hand *hand, const HandInput *input, const double box_size[3], BoxTarget *target);

/* The focus is lost, a drag is broken off, a device is gone: what is held becomes where the box is now (the
   pose of its BoxFilter, or what was told), so that it stops there. The next hand_update tells it. `still`
   has the offsets and the turn that go on, on top of which it stays there; NULL: none. Without a finite pose
   nothing changes. */
void hand_let_go(Hand *hand, const BoxTarget *now, const HandInput *still, const double box_size[3]);

/* The box shall go home, upright; the next hand_update tells it. */
void hand_home(Hand *hand);

/* A stick's two axes (-1 .. 1) without the dead zone about its middle, with a curve that is fine near the
   middle and full at the rim: the direction stays, the length becomes 0 .. 1. Not finite: 0. */
void hand_stick(const double axes[2], double out[2]);

#endif
