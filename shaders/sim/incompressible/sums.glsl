// The number density, and the effect of a particle's k on its own number density: density_sums in sim/methods/shared/pair_incompressible.h.
#include "sim/incompressible/pairs.glsl"

// Sums of W, and of F^2 r^2 / m_j; the sum of F x_ij is `whole`.
float heights = 1.0, squares = 0.0;
// The part of `whole` by the particle's own images' k.
vec3 twice = vec3(0);

vec3 weigh(vec3 d, float q, float inverse_mass)
{
    vec3 force = gradient * shape(q) * d;
    heights += height(q);
    squares += dot(force, force) * inverse_mass;
    return force;
}

// The particle's own image has the particle's k too.
void pair(uint j, vec3 d, float q, float term)
{
    float inverse_mass = j == self ? 0.0 : 1.0 / fluids[FLUID_OF(j)].mass, times = j == self ? 2.0 : 1.0;
    vec3 force = weigh(d, q, inverse_mass);
    part += times * force;
    if (j == self)
        twice += mirror * force;
}

#ifndef BOUNDARY_SEEN // further use of a boundary particle in a pass: its index, F x_ib, x_ib
#define BOUNDARY_SEEN(b, force, d)
#endif

void boundary_pair(uint j, vec3 d, float q)
{
    vec3 force = weigh(d, q, 0.0);
    part += BOUNDARY_TIMES * force;
    BOUNDARY_SEEN(j, mirror * force, mirror * d)
}
