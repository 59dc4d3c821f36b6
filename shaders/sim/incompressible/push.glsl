// `whole` is the sum of (k_i + k_j) F x_ij over `gradient`: push_sums in sim/methods/shared/pair_incompressible.h.
#include "sim/incompressible/pairs.glsl"

float own_term; // the particle's k; neighbours' k are in their places

void pair(uint j, vec3 d, float q, float term) { part += (own_term + term) * shape(q) * d; }

#ifndef BOUNDARY_SEEN // as in sums.glsl
#define BOUNDARY_SEEN(b, force, d)
#endif

void boundary_pair(uint j, vec3 d, float q)
{
    vec3 slope = shape(q) * d;
    part += BOUNDARY_TIMES * own_term * slope;
    BOUNDARY_SEEN(j, gradient * mirror * slope, mirror * d)
}
