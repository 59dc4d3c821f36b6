/* Poses, shapes and colours of the solids; filled by render/frame/solids.c. */
#ifndef SLOSH_SOLID_BLOCK_H
#define SLOSH_SOLID_BLOCK_H

#include "shaders/shared/bindings.h"
#include "shaders/shared/block.h"

/* Shapes that are cut off at the box; 0: whole, wherever the solid is */
#define SOLID_CUT_SPHERE   1 /* size: radius */
#define SOLID_CUT_BOX      2 /* half the sides */
#define SOLID_CUT_CYLINDER 3 /* radius, half the height */
#define SOLID_CUT_BOWL     4 /* radii of inside and outside */

BLOCK_STRUCT(DrawnSolid)
{
    mat4 to_eye; /* from the solid's own frame */
    mat4 to_light;
    mat4 to_box;
    vec4 color;
    vec3 size; /* m, by shape */
    uint cut;
    vec4 across; /* x: 1; 0 in a flat box, where the shape is the same at any depth */
}
BLOCK_END(DrawnSolid);

#define SOLIDS_DRAWN_MAX 16

UNIFORM_BLOCK(SolidBlock, SOLID_BLOCK)
{
    DrawnSolid solids[SOLIDS_DRAWN_MAX];
}
BLOCK_END(SolidBlock);

#endif
