/* Data of a step; filled by sim/gpu/compute/blocks.c. */
#ifndef SLOSH_STEP_BLOCK_H
#define SLOSH_STEP_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

UNIFORM_BLOCK(StepBlock, STEP_BLOCK)
{
    vec4 rotation[3]; /* the drift: sim/box/box.h; rows, w: 0 */
    vec3 omega0;
    float drift_dt; /* s */
    vec3 omega1;
    int still; /* 1: the box is at rest */
    vec3 shift;
    vec3 velocity_change;
    vec3 gravity;         /* of the kick */
    float kick_dt;        /* s */
    vec3 apparent_origin; /* apparent gravity */
    vec3 apparent_alpha;
    vec3 apparent_omega;
    vec3 kick_gravity; /* of this step's kick, for earlier passes, m/s2 */
}
BLOCK_END(StepBlock);

#endif
