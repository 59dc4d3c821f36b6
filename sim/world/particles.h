/* What every backend does with columns on this side: it fills them with an initial state, and shows them. */
#ifndef SLOSH_PARTICLES_H
#define SLOSH_PARTICLES_H

#include "sim/world/constants.h"
#include "sim/world/reading.h"

/* Puts an initial state into zeroed columns; ids count from 0. */
void particles_set(const ParticleColumns *to, const Constants *constants, const InitialState *initial);

/* rho / rho0 - 1: carried, or calibrated so that p = c^2 (rho - rho0) holds. */
static inline float particle_compression(const ParticleColumns *p, const Constants *constants, size_t i)
{
    if (p->compression)
        return p->compression[i];
    return constants->stiffness_scale * (1 / (p->volume[i] * constants->rest_number_density) - 1);
}

/* Entries [begin, end) of `out`: the particles at[k], or with NULL the particles k. */
void particles_read(const ParticleColumns *p, const Constants *constants, const uint32_t *at, size_t begin,
                    size_t end, const ParticleArrays *out);

/* Sums over the particles 0 to before `count`, one behind the other; without `neighbours_mean`. */
void particles_sums(const ParticleColumns *p, const Constants *constants, size_t count, WorldSums *sums);

#endif
