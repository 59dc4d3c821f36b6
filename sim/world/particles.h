/* Host-side column functions shared by all backends: initial state and reading. */
#ifndef SLOSH_PARTICLES_H
#define SLOSH_PARTICLES_H

#include "sim/world/constants.h"
#include "sim/world/reading.h"

/* Writes an initial state to zeroed columns; ids count from 0. */
void particles_set(const ParticleColumns *to, const Constants *constants, const InitialState *initial);

/* rho / rho0 - 1: carried, or calibrated to p = c^2 (rho - rho0). */
static inline float particle_compression(const ParticleColumns *p, const Constants *constants, size_t i)
{
    if (p->compression)
        return p->compression[i];
    return constants->stiffness_scale * (1 / (p->volume[i] * constants->rest_number_density) - 1);
}

/* Fills entries [begin, end) of `out` with particles at[k], or particles k if `at` is NULL. */
void particles_read(const ParticleColumns *p, const Constants *constants, const uint32_t *at, size_t begin,
                    size_t end, const ParticleArrays *out);

/* Sums over particles 0 to count - 1, in sequence; without `neighbours_mean`. */
void particles_sums(const ParticleColumns *p, const Constants *constants, size_t count, WorldSums *sums);

#endif
