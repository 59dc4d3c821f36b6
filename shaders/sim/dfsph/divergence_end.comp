// dfsph: what the solver of divergence has found becomes acceleration, pressure, and k to begin the next step with.
#define OWN_ACCESS writeonly
#include "sim/constants.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
#include "sim/own.glsl"
layout(std430, binding = PRESSURES_BUFFER) writeonly buffer Pressures { vec2 pressure[]; };   // p, k
layout(std430, binding = ACCELERATIONS_BUFFER) buffer Accelerations { vec4 acceleration[]; };
layout(std430, binding = PUSHES_BUFFER) readonly buffer Pushes { vec4 push[]; };              // accelerations, k

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec4 found = push[i];
    acceleration[i].xyz += found.xyz;
    own[OWN_kept_term + i] = found.w;
    pressure[i] = vec2(pressure_of_term * found.w, found.w);
}
