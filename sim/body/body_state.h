/* State of solids moved by the fluid: doubles only, since files keep the state as part of WorldNumbers
   (sim/world/world_state.h). */
#ifndef SLOSH_BODY_STATE_H
#define SLOSH_BODY_STATE_H

#include "sim/matter/forces.h"

typedef struct BodyState {
    BoxState pose;   /* of the solid's frame, in the box's frame */
    double push[3];  /* acceleration of the centre of mass by fluid in the last step, m/s2, */
    double twist[3]; /* and angular acceleration, rad/s2: in the box's axes. On a hinge only twist[0], about
                        the axis */
    Push left;       /* by guards after the last kick, for the next: N s, N m s about the pose's position */
} BodyState;

/* Indexed as the def's solids; all 0 for fixed solids. */
typedef struct BodyStates {
    BodyState of[SOLIDS_MAX];
} BodyStates;

#endif
