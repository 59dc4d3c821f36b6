// dfsph: what the solver of divergence has found becomes acceleration, pressure, and k to begin the next step with.
#ifndef FELT_SOLIDS
#define OWN_ACCESS writeonly
#endif
#include "sim/constants.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
#include "sim/own.glsl"
#ifdef FELT_SOLIDS
#define LISTS_LATER
#define KERNEL_WENDLAND_C2 1
#include "sim/shapes.glsl"
#define PLACES near
#include "sim/walk.glsl"
layout(std430, binding = NEAR_BUFFER) readonly buffer Near { vec4 near[]; };

uint felt_by;

// k for whom the boundary particle pushes, and for itself.
#define FELT_BEGIN
#define FELT_FORCE(i, term, d, r2) 2.0 * own[OWN_kept_term + i] * gradient * shape(sqrt(r2) * inverse_support) * d
#include "sim/felt_solids.glsl"
#else
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
#endif
