// pbf: positions by the growth of multipliers: move_one in sim/methods/pbf/pbf_passes.c.
#define LISTS_LATER
#define PLACES near
#define BOUNDARY_TIMES 2.0 // boundary particles push with the particle's k too: sim/methods/shared/incompressible.h
#include "shaders/sim/pbf/pbf_block.h"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; };
#ifdef FIRST_MOVE
layout(location = PASS_DT_AT) uniform float dt;
#endif
layout(std430, binding = NEAR_BUFFER) readonly buffer Near { vec4 near[]; }; // w: growth of k, times dt^2
#ifdef SOLIDS
#define BOUNDARY_SEEN(b, force, d) solid_add(force, d);
void solid_add(vec3 force, vec3 d);
#endif
#include "sim/incompressible/push.glsl"
#include "sim/incompressible/solids.glsl"
#include "sim/own.glsl"
#include "sim/place.glsl"
#include "sim/scratch.glsl"
#ifdef SOLIDS
#define SOLID_BEGIN(k) solids[k].end // solids stand still
#include "sim/solid_guard.glsl"
#endif

vec3 shortened(vec3 way)
{
    float most = WAY_LONGEST * spacing, length2 = dot(way, way);
    if (length2 <= most * most)
        return way;
    return length2 < 1e38 ? most / sqrt(length2) * way : vec3(0);
}

// Moves x out of solids, then into the box: up to the walls after a solid, else up to WALL_LEAST before the walls.
void hold_back(vec3 from, inout vec3 x)
{
    float apart = WALL_LEAST * spacing;
#ifdef SOLIDS
    vec3 v = vec3(0);
    if (solids_guard(from, x, v))
        apart = 0.0;
#endif
    for (int a = 0; a < 3; a++) { // as in drift.comp
        if (a >= dimensions)
            continue;
#ifdef PERIODIC
        if (periodic[a])
            continue;
#endif
        float low = a == 1 ? 0.0 : -half_size[a], high = a == 1 ? 2.0 * half_size.y : half_size[a];
        x[a] = min(max(x[a], low + apart), high - apart);
    }
}

#ifdef SOLIDS
void add_by_solid(uint i, vec3 way)
{
    for (uint a = 0u; a < 3u; a++)
        own[a * OWN_STRIDE + OWN_solid_by + i] += way[a];
}

// The way by all k, `way` with what boundary particles do with the particle's k.
vec3 pushed(uint i, vec3 way)
{
    vec3 along = solid_along(solid_slope, solid_shares().x, way);
    add_by_solid(i, 2.0 * own_term / fluids[FLUID_OF(i)].mass * solid_slope + along);
    return way + along;
}
#else
#define pushed(i, way) (way)
#endif

#ifdef FIRST_MOVE
#include "sim/wall_lift.glsl"

// Fallen again, but for what walls and solids hold: fall_run.
vec3 fallen(uint i, vec3 seen)
{
    float warm = 1.0 - min(FORGOTTEN, FORGOTTEN_RATE * (settle_rate * dt)), p = pressure_of_term * own[OWN_term + i] / warm;
    vec3 g = apparent_at(seen);
    float layer = fluids[FLUID_OF(i)].density * spacing * length(g), layers = layer > 0.0 ? p / layer : 0.0;
    vec3 way = -dt * dt * clamp(PBF_WALL_FADE(layers), 0.0, 1.0) * walls_lift(seen) * g;
#ifdef SOLIDS
    vec3 held = dt * dt * solid_hold(solid_slope, solid_shares().y, g, clamp(PBF_SOLID_FADE(layers), 0.0, 1.0));
    add_by_solid(i, held);
    way += held;
#endif
    for (uint a = 0u; a < 3u; a++)
        own[a * OWN_STRIDE + OWN_moved + i] = way[a];
    return place_after(i, position[i].xyz, way);
}
#else
#define fallen(i, seen) (seen)
#endif

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 seen = near[i].xyz;
    own_term = near[i].w;
    walk_pairs(i, seen);
    vec3 from = fallen(i, seen), way = shortened(pushed(i, gradient * whole / fluids[FLUID_OF(i)].mass)), x = from, left = left_of(i);
    place_move(x, left, way);
    vec3 free = x;
    hold_back(from, x);
    place_put(free, x, left);
    keep_left(i, left);
    way = mix(way, x - from, notEqual(x, free)); // a difference of places has fewer digits
    position[i].xyz = x;
    for (uint a = 0u; a < 3u; a++)
        own[a * OWN_STRIDE + OWN_moved + i] += way[a];
    own[OWN_term + i] += scratch[SCRATCH_change + i];
    scratch[SCRATCH_way + i] += length(way) / spacing;
}
