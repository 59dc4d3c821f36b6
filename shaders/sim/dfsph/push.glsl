// dfsph, both solvers: accelerations by k, then velocities on the way to the middle of the next step: push, begin_motion and
// go_on in sim/methods/dfsph/dfsph_passes.c.
#define LISTS_LATER
#define PLACES near
#include "sim/dfsph/dfsph.glsl"
layout(std430, binding = NEAR_BUFFER) readonly buffer Near { vec4 near[]; };                  // w: k
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };  // w: volume
layout(std430, binding = PUSHES_BUFFER) writeonly buffer Pushes { vec4 push[]; };             // accelerations, k
layout(std430, binding = MOVES_BUFFER) writeonly buffer Moves { vec4 move[]; };               // velocities, volume
#ifdef DIVERGENCE
layout(std430, binding = ACCELERATIONS_BUFFER) readonly buffer Accelerations { vec4 acceleration[]; }; // by all but pressure
#endif
#include "sim/incompressible/push.glsl"
#include "sim/dfsph/flown.glsl"
#ifdef SOLIDS
#include "sim/incompressible/solids.glsl"
#include "sim/scratch.glsl"
#endif

// The kick comes after the solver of divergence.
vec3 accelerated(uint i, vec3 pressed)
{
#ifdef DIVERGENCE
    return acceleration[i].xyz + pressed + kick_gravity;
#else
    return pressed;
#endif
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = near[i].xyz;
    own_term = near[i].w;
    walk_pairs(i, x);
    vec3 pressed = gradient * whole / fluids[FLUID_OF(i)].mass;
#ifdef SOLIDS
    vec3 slope = column_of(SCRATCH_solid_slope, i), along = solid_along(slope, scratch[SCRATCH_solid_share + i], pressed);
    column_set(SCRATCH_solid_by, i, 2.0 * own_term / fluids[FLUID_OF(i)].mass * slope + along);
    pressed += along;
#endif
    push[i] = vec4(pressed, own_term);
    move[i] = vec4(flown(velocity[i].xyz, x, accelerated(i, pressed), dt), velocity[i].w);
}
