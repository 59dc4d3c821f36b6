/* Poses and colours of the solids; filled by render/frame/solids.c. */
#ifndef SLOSH_SOLID_BLOCK_H
#define SLOSH_SOLID_BLOCK_H

#include "shaders/shared/bindings.h"
#include "shaders/shared/block.h"

BLOCK_STRUCT(DrawnSolid)
{
    mat4 to_eye; /* from the solid's own frame */
    mat4 to_light;
    vec4 color;
}
BLOCK_END(DrawnSolid);

#define SOLIDS_DRAWN_MAX 16

UNIFORM_BLOCK(SolidBlock, SOLID_BLOCK)
{
    DrawnSolid solids[SOLIDS_DRAWN_MAX];
}
BLOCK_END(SolidBlock);

#endif
