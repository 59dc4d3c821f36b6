/* The pairs of sim/incompressible/pairs.h with boundary particles, one at a time (sim/cpu/forces.c). */
#ifndef SLOSH_INCOMPRESSIBLE_SOLID_FORCE_H
#define SLOSH_INCOMPRESSIBLE_SOLID_FORCE_H

#include "sim/cpu/pass.h"

/* Pair of push_sums: k F x_ib. */
void incompressible_push(const SolidPair *pair, float k, float force[3]);

/* Pair of friction_sums, with velocity u (m/s) of b relative to i; 0 if forces have no friction. */
void incompressible_rub(const SolidPair *pair, const float u[3], float force[3]);

#endif
