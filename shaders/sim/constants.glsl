// What is constant while a world lives, what one step brings, and who runs.
#include "shaders/sim/constant_block.h"
#include "shaders/sim/step_block.h"
#include "shaders/sim/watch_block.h"

// Apparent gravity at x.
vec3 felt_at(vec3 x) { return felt_origin - cross(felt_alpha, x) - cross(felt_omega, cross(felt_omega, x)); }

// How many there are; how many a pass has to do with. None behind a step that blew up: all fluid in one cell would keep the
// rest of the frame for minutes. What moves particles to other places, or counts them, goes by those that are there.
uint particles_there() { return uint(particle_total); }
uint particle_count() { return went_too_far != 0u ? 0u : particles_there(); }
uint cell_count() { return went_too_far != 0u ? 0u : uint(cell_total); }

// The fluid of a particle of name[]: of one nobody has to ask.
#ifdef ONE_FLUID
#define FLUID_OF(i) 0u
#else
#define FLUID_OF(i) name[i].y
#endif

#ifdef PERIODIC
const bvec3 periodic = PERIODIC; // across which axes its sides are one
#endif

layout(local_size_x = 64) in;

// Groups stand in rows, since a driver may allow 65,535 along an axis only.
uint invocation() { return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x; }
