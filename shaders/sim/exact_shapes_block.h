/* Shapes of solids in double precision, for worlds with the CPU's bits; filled by
   sim/gpu/compute/solids.c. */
#ifndef SLOSH_EXACT_SHAPES_BLOCK_H
#define SLOSH_EXACT_SHAPES_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

BLOCK_STRUCT(ExactShape)
{
    dvec3 half_edges; /* as in solid_steps_block.h */
    double radius;
    double thickness;
    double reach;
}
BLOCK_END(ExactShape);

UNIFORM_BLOCK(ExactShapesBlock, EXACT_SHAPES_BLOCK)
{
    ExactShape exact_shapes[SOLIDS_MOST];
}
BLOCK_END(ExactShapesBlock);

#endif
