/* A part of the forces on box and solids, summed over steps; forces_sum.comp adds the parts. */
#ifndef SLOSH_FORCE_PART_H
#define SLOSH_FORCE_PART_H

#include "shaders/shared/block.h"

BLOCK_STRUCT(ForcePart)
{
    vec3 force;  /* N s, in the box's axes */
    vec3 torque; /* N m s, about the box's origin; for a solid about the solid's centre */
    vec3 about;  /* torque of a solid's boundary particle about the box's origin */
}
BLOCK_END(ForcePart);

/* Of the box or a solid: what rounding left of a sum beside the sum. */
BLOCK_STRUCT(ForceSum)
{
    vec3 force, force_left;
    vec3 torque, torque_left;
}
BLOCK_END(ForceSum);

#endif
