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

layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
#include "sim/incompressible/solids.glsl"
#include "sim/scratch.glsl"

vec3 push_solid(uint i, vec3 d, float r2)
{
    float f = gradient * shape(sqrt(r2) * inverse_support);
    return fluids[FLUID_OF(i)].mass * solid_part(column_of(SCRATCH_solid_slope, i), d, f) * column_of(SCRATCH_solid_by, i);
}

#define FORCES_BEGIN
#define FORCES_IMAGE
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
