/* Poses of the solids over half a step, and their shapes; filled by sim/gpu/compute/solids.c. */
#ifndef SLOSH_SOLID_STEPS_BLOCK_H
#define SLOSH_SOLID_STEPS_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

#define SOLID_BOX      1
#define SOLID_CYLINDER 2
#define SOLID_BOWL     3
#define SOLID_MESH     4

BLOCK_STRUCT(Pose)
{
    vec3 x;
    vec4 r[3]; /* rows, w: 0; x_box = x + r x_solid */
}
BLOCK_END(Pose);

BLOCK_STRUCT(Solid)
{
    Pose begin;
    Pose end;
    vec3 velocity; /* at the end, m/s */
    int sticks;    /* 1: viscous fluid sticks to the solid */
    vec3 spin;     /* rad/s */
    int kind;
    vec3 change;     /* rate of the velocity over the step, m/s2 */
    vec3 alpha;      /* of the spin, rad/s2 */
    vec3 half_edges; /* of a box; half the height of a cylinder in y, m */
    float radius;    /* m */
    float thickness; /* of a bowl, m */
    float reach;     /* from its centre, m */
}
BLOCK_END(Solid);

UNIFORM_BLOCK(SolidStepsBlock, SOLID_STEPS_BLOCK)
{
    int solid_total;
    int boundary_total; /* boundary particles */
    Solid solids[SOLIDS_MOST];
}
BLOCK_END(SolidStepsBlock);

#endif
