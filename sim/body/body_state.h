/* The state of solids that move by the fluid: doubles only, so that it is part of the numbers that files keep
   (WorldNumbers of sim/world/world_state.h). */
#ifndef SLOSH_BODY_STATE_H
#define SLOSH_BODY_STATE_H

#include "sim/matter/forces.h"

typedef struct BodyState {
    BoxState pose;   /* of the solid's frame, in the box's */
    double push[3];  /* what fluid accelerated its centre of mass by in the last step, m/s2, */
    double twist[3]; /* and its turning, rad/s2: in the box's axes. On a hinge only twist[0], about the axis
                      */
    Push left;       /* of guards behind the last kick, for the next: N s, N m s about the pose's position */
} BodyState;

/* By the def's solids; of one that is not free all 0. */
typedef struct BodyStates {
    BodyState of[SOLIDS_MAX];
} BodyStates;

#endif
