/* The hand's box: it follows a target pose as a critically damped spring would, within limits, in simulated
 * time. */
#ifndef SLOSH_BOX_FILTER_H
#define SLOSH_BOX_FILTER_H

#include "sim/box/box_motion.h"

/* Where the hand wants the box, on top of the scene's prescribed motion. */
typedef struct BoxTarget {
    double position[3];    /* of the box's centre from its home, m; the prescribed motion rides on it */
    double orientation[4]; /* unit quaternion x y z w; about the box's centre */
} BoxTarget;

/* What a box in the hand may do; the scene's keys `hand.*`. */
typedef struct BoxLimits {
    double response;              /* s: time constant of the filter */
    double speed;                 /* m/s */
    double acceleration;          /* m/s2 */
    double turn_speed_deg;        /* degrees/s */
    double turn_acceleration_deg; /* degrees/s2 */
} BoxLimits;

/* The state of the filter: where the hand's part of the pose is, and its rates in the world's frame. */
typedef struct BoxFilter {
    double position[3];         /* m */
    double velocity[3];         /* m/s */
    double orientation[4];      /* unit quaternion */
    double angular_velocity[3]; /* rad/s */
} BoxFilter;

/* Each with its reason beside it in box_filter.c. */
BoxLimits box_limits_default(void);
BoxFilter box_filter_at_rest(void);

/* Carries the filter dt (s) on towards the target. */
void box_filter_step(BoxFilter *filter, const BoxTarget *target, const BoxLimits *limits, double dt);

/* The prescribed pose with the hand's part on top: the hand's turn outermost, about the centre that the box
   has at home. */
void box_filter_apply(const BoxFilter *filter, double box_height, BoxState *state);

#endif
