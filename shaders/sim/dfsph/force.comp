// dfsph: accelerations but those of pressure, by friction and surface tension: dfsph_friction in sim/dfsph/pairs.c.
#define KERNEL_WENDLAND_C2 1
#define LISTS_LATER
#include "sim/constants.glsl"
#include "sim/force.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
#include "sim/shapes.glsl"

float volume_of(uint i) { return velocity[i].w; }

float extra_of(uint fluid) { return 0.0; }

vec3 pair_force(Side one, Side other, vec3 d, float r2)
{
#ifdef VISCOUS
    float f = friction_gradient * shape(sqrt(r2) * inverse_support);
    return f * one.volume * other.volume * (one.viscosity + other.viscosity) * (other.v - one.v);
#else
    return vec3(0);
#endif
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 force = vec3(0);
#if defined VISCOUS || defined TENSION
    vec3 x = near[i].xyz;
    force = neighbours_force(i, x, cell_of(x));
#endif
    acceleration[i] = vec4(force / fluids[FLUID_OF(i)].mass, 0.0);
}
