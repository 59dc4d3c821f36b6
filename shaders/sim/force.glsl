// What the forces of methods have in common: pairs within the support, surface tension, boundary particles of solids. A
// method's force.comp says what a pair does, and adds what its walls do.
#include "shaders/sim/term_block.h"
#define PLACES near
#include "sim/walk.glsl"
#include "sim/pair_direction.glsl"
#include "sim/pair_viscosity.glsl"
layout(std430, binding = NEAR_BUFFER) readonly buffer Near { vec4 near[]; }; // w: p V^2
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
#ifndef SEEN_VELOCITY // what pairs see of each other
#define SEEN_VELOCITY(i) velocity[i].xyz
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; }; // w: what volume_of takes
#endif
#ifndef FELT_SOLIDS
layout(std430, binding = ACCELERATIONS_BUFFER) writeonly buffer Accelerations { vec4 acceleration[]; };
#endif

float volume_of(uint i); // the method's: by the velocity's w

#include "sim/tension.glsl"

// What a pair takes of one of the two.
struct Side {
    float pressure, volume, viscosity, extra, density; // pressure: p V^2; density: at rest, 0 of solids
    vec3 v;
};

float extra_of(uint fluid); // the method's: what else of a fluid its pairs want; solids have 0

Side side_of(uint i, float term)
{
    uint fluid = FLUID_OF(i);
    return Side(term, volume_of(i), fluids[fluid].viscosity, extra_of(fluid), fluids[fluid].density, SEEN_VELOCITY(i));
}

vec3 pair_force(Side one, Side other, vec3 d, float r2); // the method's: on `one`, which is d from `other`

#ifndef MEET_MORE // what else a method has of two particles that are so far apart
#define MEET_MORE(j, d, r2, term)
#endif

uint self;
Side self_side;
vec3 pair_sum = vec3(0), boundary_sum; // boundary_sum: of a row

// Two at one place are taken for a little apart, along a direction that their ids decide.
// A macro, so that nobody else reads ids.
#define SEPARATE(a, b, d, r2)                       \
    if (r2 < 1e-12 * support * support) {           \
        float least = 1e-6 * support;               \
        d = least * direction_of_ids(a, b);         \
        r2 = least * least;                         \
    }

void meet(uint j, vec3 d, float term)
{
    float r2 = dot(d, d);
    if (r2 >= support * support || j == self)
        return;
    tension_meet(j, d, r2);
    SEPARATE(name[self].x, name[j].x, d, r2)
    pair_sum += pair_force(self_side, side_of(j, term), d, r2);
    MEET_MORE(j, d, r2, term)
}

#ifdef SOLIDS
#define BOUNDARY_ID 0x80000000u

void meet_boundary(uint j, vec3 d, float volume)
{
    float r2 = dot(d, d);
    if (r2 >= support * support)
        return;
    uvec2 state = boundary_state[j];
    vec4 wall = boundary_velocity[j];
    SEPARATE(name[self].x, BOUNDARY_ID + state.y, d, r2)
    boundary_sum += pair_force(self_side, Side(uintBitsToFloat(state.x), volume, wall.w, 0.0, 0.0, wall.xyz), d, r2);
}
#endif

#ifdef FELT_SOLIDS
uint felt_by;
Side felt_side;

Side wall_side(uint b)
{
    vec4 wall = boundary_velocity[b];
    return Side(uintBitsToFloat(boundary_state[b].x), boundary_position[b].w, wall.w, 0.0, 0.0, wall.xyz);
}

#define FELT_BEGIN felt_side = wall_side(felt_by);
#ifndef FELT_FORCE
#define FELT_FORCE(i, term, d, r2) pair_force(side_of(i, term), felt_side, d, r2)
#endif
#endif

void add_boundary_row()
{
    pair_sum += boundary_sum;
    boundary_sum = vec3(0);
}

// All of it on particle i at x, in the cell `at`.
vec3 neighbours_force(uint i, vec3 x, ivec3 at)
{
    self = i;
    self_side = side_of(i, near[i].w);
    boundary_sum = vec3(0);
    tension_begin(i);
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, add_boundary_row())
    return pair_sum + tension_force(i);
}
