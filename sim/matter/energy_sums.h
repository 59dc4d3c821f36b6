/* Sums over matter for the energy watch (sim/world/energy_watch.h), in the box's frame. Inflow, outflow and
   floating solids add their own sums. */
#ifndef SLOSH_ENERGY_SUMS_H
#define SLOSH_ENERGY_SUMS_H

/* The last fields are needed only in a box that turns. */
typedef struct EnergySums {
    double own;         /* energy of motion and of compression, J */
    double mass;        /* kg */
    double momentum[3]; /* kg m/s */
    double first[3];    /* sum m x, kg m */
    double bare; /* upper bound on the surface of fluid with surface tension, m2: sides between cells of h
                    with fluid and empty cells; from backends that know their cells */
    double second[6]; /* sum m x x: xx, yy, zz, xy, yz, zx, kg m2 */
    double turn[3];   /* sum m x cross v, kg m2/s */
} EnergySums;

/* Adds a mass m (kg) at x (m) with velocity v (m/s). */
static inline void energy_sums_add(EnergySums *sums, double m, const double x[3], const double v[3])
{
    sums->own += 0.5 * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    sums->mass += m;
    for (int k = 0; k < 3; k++) {
        sums->momentum[k] += m * v[k];
        sums->first[k] += m * x[k];
    }
}

/* Adds the mass's sums for a box that turns. */
static inline void energy_sums_add_turning(EnergySums *sums, double m, const double x[3], const double v[3])
{
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        sums->second[k] += m * x[k] * x[k];
        sums->second[3 + k] += m * x[k] * x[next];
        sums->turn[k] += m * (x[next] * v[last] - x[last] * v[next]);
    }
}

#endif
