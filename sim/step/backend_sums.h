/* Contribution of a particle to a world's sums, for the backends. */
#ifndef SIM_STEP_BACKEND_SUMS_H
#define SIM_STEP_BACKEND_SUMS_H

#include "sim/step/constants.h"
#include "sim/step/method.h"
#include "slosh/state.h"
#include "slosh/world.h"

#include <math.h>

/* Adds a particle of mass m (kg) at x (m) with velocity v (m/s). `centre` is not yet divided by the mass. */
static inline void sums_add(WorldSums *sums, double m, const double x[3], const double v[3])
{
    double speed2 = 0, l2 = 0;
    sums->mass += m;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const double l = m * (x[a] * v[b] - x[b] * v[a]);
        sums->momentum[k] += m * v[k];
        sums->angular_momentum[k] += l;
        sums->centre[k] += m * x[k];
        speed2 += v[k] * v[k];
        l2 += l * l;
    }
    sums->momentum_scale += m * sqrt(speed2);
    sums->angular_scale += sqrt(l2);
    sums->kinetic_energy += 0.5 * m * speed2;
    sums->max_speed = fmax(sums->max_speed, sqrt(speed2));
}

/* Contribution of a particle to a world's gauge (include/slosh/world.h), for the backends. A gauge gathers
   nothing else of the state. */

/* Adds a particle at x (m) with velocity v (m/s) and `compression` to the sums; the mean is not yet divided
   by the count. `gravity` in the box's frame, m/s2. */
static inline void gauge_add(WorldGauge *gauge, const Constants *constants, const double gravity[3],
                             int fluid, double compression, const float x[3], const float v[3])
{
    const double m = constants_mass(constants, fluid), c = (double)constants->sound_speed;
    const double pressed = compression > 0 ? compression : 0;
    double speed2 = 0, height = 0;
    for (int k = 0; k < 3; k++) {
        speed2 += (double)v[k] * (double)v[k];
        height -= gravity[k] * (double)x[k];
    }
    gauge->density_error_mean += pressed;
    gauge->density_error_max = fmax(gauge->density_error_max, pressed);
    gauge->kinetic_energy += 0.5 * m * speed2;
    gauge->potential_energy += m * height;
    if (constants->method->energy)
        gauge->compression_energy +=
            m * c * c * constants->method->energy(constants->negative_pressure ? compression : pressed);
}

/* The same for EnergySums; `turning`: with the sums for a turning box. */
static inline void energy_add(EnergySums *sums, const Constants *constants, int fluid, double compression,
                              const float at[3], const float velocity[3], bool turning)
{
    const double m = constants_mass(constants, fluid), c = (double)constants->sound_speed;
    double x[3], v[3];
    for (int k = 0; k < 3; k++) {
        x[k] = (double)at[k];
        v[k] = (double)velocity[k];
    }
    energy_sums_add(sums, m, x, v);
    if (turning)
        energy_sums_add_turning(sums, m, x, v);
    if (constants->method->energy && (compression > 0 || constants->negative_pressure))
        sums->own += m * c * c * constants->method->energy(compression);
}

/* Host-side column functions shared by all backends: initial state and reading. */

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
