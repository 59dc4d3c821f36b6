/* A part of what box and solids feel, summed over steps; sim/gl/compute/forces.c adds the parts up. */
#ifndef SLOSH_FELT_PART_H
#define SLOSH_FELT_PART_H

#include "shaders/shared/block.h"

BLOCK_STRUCT(FeltPart)
{
    vec3 force;  /* N s, in the box's axes */
    vec3 torque; /* N m s, about the box's origin; of a solid about the solid's own */
    vec3 about;  /* of a solid's boundary particle: about the box's origin */
}
BLOCK_END(FeltPart);

#endif
