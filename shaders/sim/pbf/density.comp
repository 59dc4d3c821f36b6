// pbf: the number density after an iteration, and the growth of k in the next: density_body, finish_density, grown and
// pack_motion in sim/methods/pbf/pbf_passes.c.
#define LISTS_LATER
#define MOMENTUM PBF_MOMENTUM
#define BOUNDARY_TIMES 2.0 // boundary particles push with the particle's k too: sim/methods/shared/incompressible.h
#include "shaders/sim/pbf/pbf_block.h"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; };       // w: volume, m3
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };     // w: volume
layout(std430, binding = NEAR_BUFFER) writeonly buffer Near { vec4 near[]; };           // w: growth of k, times dt^2
layout(std430, binding = MOTIONS_BUFFER) writeonly buffer Motions { vec4 motion[]; };   // velocities at the step's end, volume
layout(location = PASS_DT_AT) uniform float dt;
#ifdef SOLIDS
layout(std430, binding = FORCES_RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; }; // w: index of the solid
#define BOUNDARY_SEEN(b, force, d) \
    solid_add(force, d);           \
    solid_flow += dot(force, mirror * boundary_flows(b));
void solid_add(vec3 force, vec3 d);
vec3 boundary_flows(uint b);
float solid_flow = 0.0; // sum F v_b . x_ib over boundary particles
#endif
#include "sim/incompressible/sums.glsl"
#include "sim/incompressible/solids.glsl"
#include "sim/incompressible/jacobi.glsl"
#include "sim/own.glsl"
#include "sim/scratch.glsl"

// Compression shared with later steps: with negative pressure, gaps too.
#ifdef NEGATIVE_PRESSURE
float found(float before) { return before; }
#else
float found(float before) { return max(before, 0.0); }
#endif

#ifdef SOLIDS
#include "sim/solids.glsl"
vec3 boundary_flows(uint b) { return solid_velocity_at(int(rest[boundary_state[b].y].w), boundary_position[b].xyz); }
#endif

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz;
    walk_pairs(i, x);
    float mass = fluids[FLUID_OF(i)].mass, n = kernel_scale * heights, ratio = n / rest_number_density;
    if (own[OWN_before + i] == 0.0 && dt > 0.0)
        own[OWN_before + i] = ratio;
    vec3 moved = vec3(own[OWN_moved + i], own[OWN_STRIDE + OWN_moved + i], own[2u * OWN_STRIDE + OWN_moved + i]);
    float more = 0.0;
#ifdef SOLIDS
    more = (dt * solid_flow - dot(solid_slope, dt * velocity[i].xyz + moved)) / rest_number_density;
    more = dot(abs(solid_slope), vec3(1)) > 0.0 ? own[OWN_boundary_part + i] + more : 0.0;
    more = clamp(more, -PBF_MIRRORED, PBF_MIRRORED);
    scratch[SCRATCH_mirrored + i] = more;
#endif
    float residual = ratio + more - 1.0 - (1.0 - PBF_SHARE(settle_rate * dt)) * found(own[OWN_before + i] - 1.0);
    float factor = 1.0 / (dot(whole, whole) / mass + squares + least_squares / mass);
    float k = own[OWN_term + i], change = next_term(k, residual, factor, scratch[SCRATCH_change + i]) - k;
#ifdef SOLIDS
    column_set(SCRATCH_solid_slope, i, solid_slope);
#endif
    scratch[SCRATCH_compressed + i] = ratio - 1.0;
    scratch[SCRATCH_miss + i] = miss_of(residual, k);
    scratch[SCRATCH_change + i] = change;
    near[i] = vec4(x, dt * dt * change);
    float volume = 1.0 / n;
    position[i].w = unit_volume * volume;
    velocity[i].w = volume;
    motion[i] = vec4(velocity[i].xyz + moved / dt, 1.0 / n);
}
