// dfsph: terms from positions alone, number density and effect of a particle's k on its own rate: finish_factor in
// sim/methods/dfsph/dfsph_passes.c.
#define LISTS_FIRST
#define OWN_ACCESS readonly
#define BOUNDARY_TIMES 2.0 // boundary particles push with the particle's k too: sim/methods/dfsph/dfsph.h
#include "shaders/sim/dfsph/dfsph_block.h"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; };             // w: volume, m3
layout(std430, binding = PRESSURES_BUFFER) writeonly buffer Pressures { vec2 pressure[]; };   // p, k
layout(std430, binding = VELOCITIES_BUFFER) writeonly buffer Velocities { vec4 velocity[]; }; // w: volume
layout(std430, binding = NEAR_BUFFER) writeonly buffer Near { vec4 near[]; };                 // x y z, k
#ifdef SOLIDS
#define BOUNDARY_SEEN(b, force, d) boundary_seen(b, force, d);
void boundary_seen(uint b, vec3 force, vec3 d);
#endif
#include "sim/incompressible/sums.glsl"
#include "sim/incompressible/solids.glsl"
#include "sim/own.glsl"
#include "sim/scratch.glsl"

#ifdef SOLIDS
#include "sim/solids.glsl"
layout(std430, binding = RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; }; // w: index of the solid

float solid_flow = 0.0; // sum F v_b . x_ib, 1/s

void boundary_seen(uint b, vec3 force, vec3 d)
{
    solid_add(force, d);
    solid_flow += dot(force, mirror * solid_velocity_at(int(rest[boundary_state[b].y].w), boundary_position[b].xyz));
}
#endif

// What a surface lacks: lack_of in sim/methods/dfsph/dfsph_passes.c.
float lack_of(vec3 slope, float full)
{
    float part = (length(slope) / surface_slope - SURFACE_FROM) / (1.0 - SURFACE_FROM);
    return clamp(part, 0.0, 1.0) * clamp(LACK_OVER_GAP * (1.0 - full), 0.0, surface_lack);
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz;
    walk_pairs(i, x);
    float mass = fluids[FLUID_OF(i)].mass, n = kernel_scale * heights;
    float d = max(dot(whole, whole) / mass + squares, least_squares / mass);
#ifdef SOLIDS
    column_set(SCRATCH_solid_slope, i, solid_slope);
    vec2 shares = solid_shares();
    scratch[SCRATCH_solid_share + i] = shares.x;
    scratch[SCRATCH_solid_lift + i] = shares.y;
    scratch[SCRATCH_solid_flow + i] = solid_flow;
#endif
    vec3 slope = whole - twice;
#ifdef SOLIDS
    slope -= solid_slope;
#endif
    scratch[SCRATCH_lack + i] = lack_of(slope, n / rest_number_density);
    scratch[SCRATCH_factor + i] = d > 0.0 ? min(1.0, rest_number_density / n) / d : 0.0;
    float volume = 1.0 / n;
    position[i].w = unit_volume * volume;
    velocity[i].w = volume;
    pressure[i] = vec2(pressure_of_term * own[OWN_kept_term + i], 0.0);
    near[i] = vec4(x, 0.0);
}
