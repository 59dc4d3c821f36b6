// wcsph with surface tension by curvature: takes the mean of its force off each body; sim/methods/wcsph/drops.c.
#include "sim/constants.glsl"
#include "shaders/sim/term_block.h"
#include "sim/wcsph/drops.glsl"
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = ACCELERATIONS_BUFFER) buffer Accelerations { vec4 acceleration[]; };

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    uint root = drop_root(i), tally = drop[drop_at(DROP_TALLY, root)], fluid = FLUID_OF(i);
    float scale = drop_scale(fluid) * fluids[fluid].mass * float(tally / DROP_ONE);
    for (int k = 0; k < 3; k++)
        if (scale > 0.0 && (tally >> k & 1u) == 0u)
            acceleration[i][k] -= drop_sum(drop_at(DROP_SUM + 2u * uint(k), root)) / scale;
}
