/* The box in the hand: follows a target pose like a critically damped spring, within limits, in simulated
   time. */
#ifndef SLOSH_BOX_FILTER_H
#define SLOSH_BOX_FILTER_H

#include "sim/box/box_motion.h"

/* The hand's target for the box, on top of the scene's prescribed motion. */
typedef struct BoxTarget {
    double position[3];    /* of the box's centre from its home, m; the prescribed motion is added */
    double orientation[4]; /* unit quaternion x y z w; about the box's centre */
} BoxTarget;

/* Limits of a box in the hand; the scene's keys `hand.*`. */
typedef struct BoxLimits {
    double response;              /* s: time constant of the filter */
    double speed;                 /* m/s */
    double acceleration;          /* m/s2 */
    double turn_speed_deg;        /* degrees/s */
    double turn_acceleration_deg; /* degrees/s2 */
} BoxLimits;

/* State of the filter: the hand's part of the pose, and its rates in the world's frame. */
typedef struct BoxFilter {
    double position[3];         /* m */
    double velocity[3];         /* m/s */
    double orientation[4];      /* unit quaternion */
    double angular_velocity[3]; /* rad/s */
} BoxFilter;

/* box_filter.c gives the reason for each value. */
BoxLimits box_limits_default(void);
BoxFilter box_filter_at_rest(void);

/* Advances the filter by dt (s) towards the target. */
void box_filter_step(BoxFilter *filter, const BoxTarget *target, const BoxLimits *limits, double dt);

/* Adds the hand's part to the prescribed pose: the hand's rotation is outermost, about the home position of
   the box's centre. */
void box_filter_apply(const BoxFilter *filter, double box_height, BoxState *state);

#endif
