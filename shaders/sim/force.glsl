// Shared code of the methods' forces: pairs within the support, surface tension, boundary particles of solids. A
// method's force.comp defines the pair force and adds the forces of walls.
#include "shaders/sim/term_block.h"
#define PLACES near
#include "sim/walk.glsl"
#include "sim/pair_direction.glsl"
#include "sim/pair_viscosity.glsl"
layout(std430, binding = NEAR_BUFFER) readonly buffer Near { vec4 near[]; }; // w: p V^2
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
#ifndef SEEN_VELOCITY // velocity for pair forces
#define SEEN_VELOCITY(i) velocity[i].xyz
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; }; // w: input of volume_of
#endif
#ifndef FORCES_ON_SOLIDS
layout(std430, binding = ACCELERATIONS_BUFFER) writeonly buffer Accelerations { vec4 acceleration[]; };
#endif

float volume_of(uint i); // defined by the method: from the velocity's w

#include "sim/tension.glsl"

// Data of a particle for a pair force.
struct Side {
    float pressure, volume, viscosity, extra, density; // pressure: p V^2; density: rest density, 0 for solids
    vec3 v;
};

float extra_of(uint fluid); // defined by the method: further data of a fluid for pairs; 0 for solids

Side side_of(uint i, float term)
{
    uint fluid = FLUID_OF(i);
    return Side(term, volume_of(i), fluids[fluid].viscosity, extra_of(fluid), fluids[fluid].density, SEEN_VELOCITY(i));
}

vec3 pair_force(Side one, Side other, vec3 d, float r2); // defined by the method: force on `one`; d: vector from `other` to `one`

#ifndef MEET_MORE // further sums of a method over pairs
#define MEET_MORE(j, d, r2, term)
#endif

uint self;
Side self_side;
vec3 pair_sum = vec3(0), boundary_sum; // boundary_sum: of a row

// Coincident particles are separated slightly, along a direction from their ids. A macro, so that ids are read only
// if needed.
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

#ifdef FORCES_ON_SOLIDS
uint boundary_by;
Side boundary_side;

Side wall_side(uint b)
{
    vec4 wall = boundary_velocity[b];
    return Side(uintBitsToFloat(boundary_state[b].x), boundary_position[b].w, wall.w, 0.0, 0.0, wall.xyz);
}

#define FORCES_BEGIN boundary_side = wall_side(boundary_by);
#define FORCES_IMAGE boundary_side.volume = 0.0;
#ifndef FORCES_FORCE
#define FORCES_FORCE(i, term, d, r2) pair_force(side_of(i, term), boundary_side, d, r2)
#endif
#endif

void add_boundary_row()
{
    pair_sum += boundary_sum;
    boundary_sum = vec3(0);
}

// Total pair force on particle i at x, in the cell `at`.
vec3 neighbours_force(uint i, vec3 x, ivec3 at)
{
    self = i;
    self_side = side_of(i, near[i].w);
    boundary_sum = vec3(0);
    tension_begin(i);
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, add_boundary_row())
    return pair_sum + tension_force(i);
}
