/* A part of the forces on box and solids, summed over steps; sim/gpu/compute/solids.c adds the parts. */
#ifndef SLOSH_FELT_PART_H
#define SLOSH_FELT_PART_H

#include "shaders/shared/block.h"

BLOCK_STRUCT(FeltPart)
{
    vec3 force;  /* N s, in the box's axes */
    vec3 torque; /* N m s, about the box's origin; for a solid about the solid's centre */
    vec3 about;  /* torque of a solid's boundary particle about the box's origin */
}
BLOCK_END(FeltPart);

#endif
