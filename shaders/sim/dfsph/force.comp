// dfsph: accelerations except pressure, by friction, surface tension and the hold of walls: others_body in sim/methods/dfsph/dfsph_passes.c.
#define LISTS_LATER
#include "sim/constants.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
#ifdef FORCES_ON_SOLIDS
#define FORCES_FORCE(i, term, d, r2) (pair_force(side_of(i, term), boundary_side, d, r2) + hold_solid(i, d, r2))
vec3 hold_solid(uint i, vec3 d, float r2);
#endif
#include "sim/incompressible/friction.glsl"
#ifdef SOLIDS
#include "sim/incompressible/solids.glsl"
#include "sim/scratch.glsl"
#endif

float volume_of(uint i) { return velocity[i].w; }

#ifdef FORCES_ON_SOLIDS
vec3 hold_solid(uint i, vec3 d, float r2)
{
    float f = gradient * shape(sqrt(r2) * inverse_support);
    return fluids[FLUID_OF(i)].mass * solid_part(column_of(SCRATCH_solid_slope, i), d, f) * column_of(SCRATCH_solid_by, i);
}

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
    vec3 g = apparent_at(x), held = lift_at(x, g, fluid.density, pressure[i].x);
#ifdef SOLIDS
    vec3 by = solid_hold(column_of(SCRATCH_solid_slope, i), scratch[SCRATCH_solid_lift + i], g, lift_fade(g, fluid.density, pressure[i].x));
    column_set(SCRATCH_solid_by, i, by);
    held += by;
#endif
    acceleration[i] = vec4(other_forces(i) / fluid.mass + held, 0.0);
}
#endif
