/* Contribution of a particle to a world's gauge (sim/world/world.h), for the backends. A gauge gathers
   nothing else of the state. */
#ifndef SLOSH_GAUGE_H
#define SLOSH_GAUGE_H

#include "sim/matter/energy_sums.h"
#include "sim/world/constants.h"
#include "sim/world/method.h"
#include "sim/world/reading.h"

#include <math.h>

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

#endif
