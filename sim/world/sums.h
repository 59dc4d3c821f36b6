/* Contribution of a particle to a world's sums, for the backends. */
#ifndef SLOSH_SUMS_H
#define SLOSH_SUMS_H

#include "sim/world/reading.h"

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

#endif
