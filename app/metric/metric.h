/* What the cases of `slosh validate` measure: pure functions over particles. Lengths in m. */
#ifndef SLOSH_METRIC_H
#define SLOSH_METRIC_H

#include "app/metric/cloud.h"
#include "app/metric/curve.h"
#include "sim/matter/world_def.h"

/* The front of a flow along a floor y = 0, with x: the highest x among particles below two spacings that have
   at least five neighbours (others nearer than the support radius), plus half a spacing. NaN without one. */
double metric_front(const Cloud *cloud);

/* How high the fluid stands at the wall x = `wall`, from the floor y = 0: the mean height of the particles
   less than three spacings away from it that are less than half a spacing below the highest of them, plus
   half a spacing. */
double metric_wall_height(const Cloud *cloud, double wall);

/* The mean height of the particles that are less than half a spacing below the highest one, plus half a
   spacing: the flat surface of a fluid at rest. */
double metric_surface(const Cloud *cloud);

/* rms of p - density gravity (surface - y) over density gravity surface, of a fluid at rest on a floor
   y = 0; `points` (may be NULL) gets each particle's height and pressure. */
double metric_hydrostatic(const Cloud *cloud, double density, double gravity, Curve *points);

/* The slope of height over r^2 = x^2 + z^2, by least squares over the highest particle of each square cell
   of a side of one spacing, in a box of that width; those at the walls are left out. `points` (may be NULL)
   gets r and height. */
double metric_paraboloid(const Cloud *cloud, double width, Curve *points);

/* The centre of mass of the particles with low <= x < high (m), equal masses. */
void metric_centre(const Cloud *cloud, double low, double high, double centre[3]);

/* Semi-axes along x and y of the ellipse with the second moments of the particles in the plane:
   2 sqrt(<(x - mean)^2>). The particles' own extent, spacing^2 / 12, is added to the moments. */
void metric_axes(const Cloud *cloud, double axes[2]);

/* Mean pressure of the particles within `radius` of `centre`; NaN where there are none. */
double metric_mean_pressure(const Cloud *cloud, const double centre[3], double radius);

typedef struct Energies {
    double kinetic, potential, elastic; /* J; potential over y = 0; elastic: of compression */
} Energies;

/* Of the particles in the box's frame, with the masses and the equation of state of `def`. */
void metric_energies(const Cloud *cloud, const WorldDef *def, Energies *energies);

/* The velocity at a point, by the normalised sum over particles with the cubic of the support radius:
   Shepard's interpolation, made linear in space (moving least squares); false where fewer than six
   particles are near. 2D. */
bool metric_velocity(const Cloud *cloud, const double at[2], double velocity[2]);

#endif
