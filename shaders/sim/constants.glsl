// What is constant while a world lives, and what one step brings: mirrors sim/gl/compute/blocks.c.
#define FLUIDS_MAX 8

layout(std140, binding = 1) uniform Constants {
    vec4 kernel;         // h, 1 / h, n0, spacing
    vec4 scales;         // of density, pressure, viscosity; relative compression
    ivec4 cell_first;    // of the grid; w: particles
    ivec4 cell_size;     // w: cells
    ivec4 rows;          // first, after the last; the same of single cells, where sides are periodic
    vec4 half_size;      // of the box; w: range of the walls
    ivec4 wall_nodes;    // of the tables of one, two, three faces
    vec4 wall_steps;     // their inverse steps
    ivec4 wall_offset;   // where they begin, in entries
    vec4 fluids[FLUIDS_MAX]; // mass, rest density, stiffness, viscosity
    vec4 cell_origin;    // with periodic sides: floor((x - origin) * inverse) is the cell
    vec4 cell_inverse;
    vec4 box_low;        // and where the box begins, how large it is
    vec4 box_whole;
};

layout(std140, binding = 2) uniform Step {
    vec4 rotation[3];     // rows of D; w of the first: dt; of the second: 1 where the box stands still
    vec4 omega0;
    vec4 omega1;
    vec4 shift;
    vec4 velocity_change;
    vec4 gravity;         // w: dt of the kick
    vec4 felt_origin;     // apparent gravity
    vec4 felt_alpha;
    vec4 felt_omega;
};

// Apparent gravity at x.
vec3 felt_at(vec3 x)
{
    return felt_origin.xyz - cross(felt_alpha.xyz, x) - cross(felt_omega.xyz, cross(felt_omega.xyz, x));
}

// What the kicks have found so far: greatest speed, acceleration, compression; guarded; whether a particle went too far. A
// pass that writes there reads there, too: it has no second block of the same buffer.
#ifdef WRITES_WATCH
layout(std430, binding = 2) buffer Watch { uint watch[8]; };
bool went_too_far() { return watch[4] != 0u; }
#else
layout(std140, binding = 4) uniform Watched { uvec4 watched[2]; };
bool went_too_far() { return watched[1].x != 0u; }
#endif

// How many there are; how many a pass has to do with. None behind a step that blew up: all fluid in one cell would keep the
// rest of the frame for minutes. What moves particles to other places, or counts them, goes by those that are there.
uint particles_there() { return uint(cell_first.w); }
uint particle_count() { return went_too_far() ? 0u : particles_there(); }
uint cell_count() { return went_too_far() ? 0u : uint(cell_size.w); }

#ifdef PERIODIC
const bvec3 periodic = PERIODIC; // across which axes its sides are one
#endif

layout(local_size_x = 64) in;

// Groups stand in rows, since a driver may allow 65,535 along an axis only.
uint invocation() { return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x; }
