// dfsph, both solvers: the residual, then k of the next iteration: dfsph_rate in sim/methods/dfsph/pairs_dfsph.c, rate and pack_place in
// sim/methods/dfsph/dfsph_passes.c.
#define LISTS_LATER
#define PLACES near
#include "sim/dfsph/dfsph.glsl"
layout(std430, binding = NEAR_BUFFER) buffer Near { vec4 near[]; };            // w: k, of the particle alone
layout(std430, binding = MOVES_BUFFER) readonly buffer Moves { vec4 move[]; }; // velocities, volume
#include "sim/incompressible/pairs.glsl"
#include "sim/incompressible/jacobi.glsl"
#include "sim/scratch.glsl"
#ifdef SOLIDS
#define OWN_ACCESS readonly
#include "sim/own.glsl"
#include "sim/solids.glsl"
layout(std430, binding = RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; }; // w: index of the solid
#endif

// The particle's velocity; the sum of F v_ij . x_ij.
vec3 own_velocity;
float sum = 0.0;

void pair(uint j, vec3 d, float q, float term) { sum += shape(q) * dot(mirror * own_velocity - move[j].xyz, d); }

#ifdef SOLIDS
void boundary_pair(uint j, vec3 d, float q)
{
    vec3 v = solid_velocity_at(int(rest[boundary_state[j].y].w), boundary_position[j].xyz);
    sum += BOUNDARY_TIMES * shape(q) * dot(mirror * own_velocity - v, d);
}
#endif

// n / n0 + `lack` - 1 after the step. For divergence an excess at the begin counts as 0; with negative pressure a lack counts as
// 0 too.
float residual_of(float volume, float lack)
{
    float now = 1.0 / (volume * rest_number_density) + lack - 1.0;
#if defined DIVERGENCE && defined NEGATIVE_PRESSURE
    now = 0.0;
#elif defined DIVERGENCE
    now = min(now, 0.0);
#endif
    return now - dt * gradient * sum / rest_number_density;
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec4 place = near[i], own_move = move[i];
    own_velocity = own_move.xyz;
    walk_pairs(i, place.xyz);
    float lack = scratch[SCRATCH_lack + i];
#ifdef SOLIDS
    lack += own[OWN_boundary_part + i];
#endif
    float residual = residual_of(own_move.w, lack);
    float k = next_term(place.w, residual, scratch[SCRATCH_factor + i], scratch[SCRATCH_change + i]);
    scratch[SCRATCH_miss + i] = miss_of(residual, place.w);
#ifdef DIVERGENCE
    scratch[SCRATCH_residual + i] = residual; // for coarse.comp
#endif
    scratch[SCRATCH_change + i] = (scratch[SCRATCH_change + i] == 0.0 ? BEGINS : 1.0) * (k - place.w);
    near[i].w = k;
}
