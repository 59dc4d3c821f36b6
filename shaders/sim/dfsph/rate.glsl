// dfsph, of both solvers: what is left of the residual, and k of the next iteration by it, Jacobi's step and a part of the
// step before: dfsph_rate in sim/dfsph/pairs.c, rate and pack_place in
// sim/dfsph/passes.c.
#define LISTS_LATER
#define PLACES near
#include "sim/dfsph/dfsph.glsl"
#ifdef DIVERGENCE
#define MOMENTUM DIVERGENCE_MOMENTUM
#else
#define MOMENTUM DENSITY_MOMENTUM
#endif
#include "sim/scratch.glsl"
#ifdef SOLIDS
#include "sim/solids.glsl"
layout(std430, binding = RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; }; // w: which solid
#endif
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = NEAR_BUFFER) buffer Near { vec4 near[]; };           // w: k, its own alone
layout(std430, binding = MOVES_BUFFER) readonly buffer Moves { vec4 move[]; }; // velocities, volume
layout(location = PASS_DT_AT) uniform float dt;

// Velocities of the particle and of its image; sums of F v_ij . x_ij.
vec3 own_velocity, image_velocity;
float sum = 0.0;

void meet(uint j, vec3 d, float term)
{
    if (dot(d, d) >= support * support || j == self)
        return;
    SEPARATE(name[self].x, name[j].x, d)
    sum += shape(q_of(d)) * dot(own_velocity - move[j].xyz, d);
}

void image_flow(vec3 v, vec3 d)
{
    if (dot(d, d) < support * support)
        sum += shape(image_q(d)) * dot(image_velocity - v, d);
}

void meet_image(uint j, vec3 d, float term) { image_flow(move[j].xyz, d); }

#ifdef SOLIDS
vec3 solid_velocity_of(uint j) { return solid_velocity_at(int(rest[boundary_state[j].y].w), boundary_position[j].xyz); }

void meet_boundary(uint j, vec3 d, float volume)
{
    if (dot(d, d) >= support * support)
        return;
    SEPARATE(name[self].x, BOUNDARY_ID + boundary_state[j].y, d)
    sum += BOUNDARY_TIMES * shape(q_of(d)) * dot(own_velocity - solid_velocity_of(j), d);
}

void meet_boundary_image(uint j, vec3 d, float volume)
{
    vec3 v = solid_velocity_of(j);
    image_flow(image_velocity + BOUNDARY_TIMES * (v - image_velocity), d);
}
#endif

void walk_images(vec3 x, ivec3 at)
{
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        image_velocity = image.sign * own_velocity;
        WALK_NEIGHBOURS(self, image.x, at, meet_image, meet_boundary_image, 0)
    }
}

// n / n0 - 1 after the step; of divergence that of a particle that was at rest density, or below it where nothing pulls.
float residual_of(float volume)
{
    float now = 1.0 / (volume * rest_number_density) - 1.0;
#if defined DIVERGENCE && defined NEGATIVE_PRESSURE
    now = 0.0;
#elif defined DIVERGENCE
    now = min(now, 0.0);
#endif
    return now - dt * gradient * sum / rest_number_density;
}

float next_term(uint i, float residual, float before)
{
    float relaxed = dt > 0.0 ? relaxation * rest_number_density / (dt * dt) : 0.0;
    float momentum = dt > 0.0 ? MOMENTUM : 0.0;
    float k = before + relaxed * residual * scratch[SCRATCH_factor + i] + momentum * scratch[SCRATCH_change + i];
#ifndef NEGATIVE_PRESSURE
    k = k > 0.0 ? k : 0.0;
#endif
    scratch[SCRATCH_change + i] = k - before;
    return k;
}

float miss_of(float residual, float term)
{
#ifdef NEGATIVE_PRESSURE
    return abs(residual);
#else
    return term > 0.0 ? abs(residual) : residual < 0.0 ? 0.0 : residual;
#endif
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec4 place = near[i], own_move = move[i];
    ivec3 at = cell_of(place.xyz);
    self = i;
    own_velocity = own_move.xyz;
    WALK_NEIGHBOURS(i, place.xyz, at, meet, meet_boundary, 0)
    walk_images(place.xyz, at);
    float residual = residual_of(own_move.w);
    scratch[SCRATCH_miss + i] = miss_of(residual, place.w);
    near[i].w = next_term(i, residual, place.w);
}
