// dfsph: accelerations except pressure, by friction, surface tension and the hold of walls: others_body in sim/methods/dfsph/dfsph_passes.c.
#define LISTS_LATER
#include "sim/constants.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
#include "sim/incompressible/friction.glsl"

float volume_of(uint i) { return velocity[i].w; }

#ifdef FORCES_ON_SOLIDS
#include "sim/solid_forces.glsl"
#else
#include "sim/wall_lift.glsl"
layout(std430, binding = PRESSURES_BUFFER) readonly buffer Pressures { vec2 pressure[]; }; // p, k

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = near[i].xyz;
    Fluid fluid = fluids[FLUID_OF(i)];
    acceleration[i] = vec4(other_forces(i) / fluid.mass + lift_at(x, apparent_at(x), fluid.density, pressure[i].x), 0.0);
}
#endif
