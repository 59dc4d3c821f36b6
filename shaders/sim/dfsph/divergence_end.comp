// dfsph: the result of the solver of divergence becomes acceleration, pressure, and the first k of the next step.
#ifndef FORCES_ON_SOLIDS
#define OWN_ACCESS writeonly
#endif
#include "sim/constants.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
#include "sim/own.glsl"
#ifdef FORCES_ON_SOLIDS
#define LISTS_LATER
#define KERNEL_WENDLAND_C2 1
#include "sim/shapes.glsl"
#define PLACES near
#include "sim/walk.glsl"
layout(std430, binding = NEAR_BUFFER) readonly buffer Near { vec4 near[]; };

uint boundary_by;

layout(std430, binding = PUSHES_BUFFER) readonly buffer Pushes { vec4 push[]; };              // accelerations, k
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
#include "sim/dfsph/along.glsl"

// k for the pushed particle, k for the boundary particle itself; along the solid: push_solid in sim/methods/dfsph/dfsph_passes.c.
vec3 push_solid(uint i, vec3 d, float r2)
{
    vec3 slope = gradient * shape(sqrt(r2) * inverse_support) * d, force = 2.0 * own[OWN_kept_term + i] * slope;
    float share = scratch[SCRATCH_solid_share + i];
    if (share <= 0.0)
        return force;
    float part = dot(slope, along_solid(i, d)) / float(dimensions - 1) * rest_number_density / pressure_of_term;
    return force + part * share_of(i) / share * fluids[FLUID_OF(i)].mass * along_solid(i, push[i].xyz);
}

#define FORCES_BEGIN
#define FORCES_FORCE(i, term, d, r2) push_solid(i, d, r2)
#include "sim/solid_forces.glsl"
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
