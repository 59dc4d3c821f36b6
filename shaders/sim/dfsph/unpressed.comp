// dfsph: all accelerations after the terms, less the pressure's: unpressed_body in sim/methods/dfsph/dfsph_passes.c.
#include "sim/constants.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
layout(std430, binding = ACCELERATIONS_BUFFER) buffer Accelerations { vec4 acceleration[]; };
layout(std430, binding = PUSHES_BUFFER) readonly buffer Pushes { vec4 push[]; };

void main()
{
    uint i = invocation();
    if (i < particle_count())
        acceleration[i].xyz -= push[i].xyz;
}
