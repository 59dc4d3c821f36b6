// Friction in the form of Morris (friction_sums in sim/incompressible/pairs.h); with surface tension all forces but
// pressure. A pass says volume_of, and FRICTION where that is not all of `friction_gradient`.
#define KERNEL_WENDLAND_C2 1
#include "sim/force.glsl"
#include "sim/shapes.glsl"
#ifndef FRICTION
#define FRICTION friction_gradient
#endif

float extra_of(uint fluid) { return 0.0; }

vec3 pair_force(Side one, Side other, vec3 d, float r2)
{
#ifdef RUBS
    float f = FRICTION * shape(sqrt(r2) * inverse_support);
    return f * one.volume * other.volume * (one.viscosity + other.viscosity) * (other.v - one.v);
#else
    return vec3(0);
#endif
}

vec3 other_forces(uint i)
{
#if defined RUBS || defined TENSION
    vec3 x = near[i].xyz;
    return neighbours_force(i, x, cell_of(x));
#else
    return vec3(0);
#endif
}
