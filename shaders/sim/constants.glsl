// Constants of a world, data of a step, and numbers of invocations.
#include "shaders/sim/constant_block.h"
#include "shaders/sim/step_block.h"
#include "shaders/sim/watch_block.h"

// Apparent gravity at x.
vec3 apparent_at(vec3 x) { return apparent_origin - cross(apparent_alpha, x) - cross(apparent_omega, cross(apparent_omega, x)); }

// particles_there: number of particles, for passes that move or count particles. particle_count: number to process; 0
// after a step that blew up: all fluid in a single cell would delay the rest of the frame for minutes.
uint particles_there() { return uint(particle_total); }
uint particle_count() { return went_too_far != 0u ? 0u : particles_there(); }
uint cell_count() { return went_too_far != 0u ? 0u : uint(cell_total); }

// The fluid of a particle in name[]; not read with a single fluid.
#ifdef ONE_FLUID
#define FLUID_OF(i) 0u
#else
#define FLUID_OF(i) name[i].y
#endif

#ifdef PERIODIC
const bvec3 periodic = PERIODIC; // axes with periodic sides
#endif

layout(local_size_x = 64) in;

// Groups are in rows, since a driver may allow only 65,535 along an axis.
uint invocation() { return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x; }
