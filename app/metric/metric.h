/* Measurements for the cases of `slosh validate`: pure functions of particles. Lengths in m. */
#ifndef SLOSH_METRIC_H
#define SLOSH_METRIC_H

#include "app/metric/cloud.h"
#include "app/metric/curve.h"
#include "sim/matter/world_def.h"

/* Front of a flow along a floor y = 0, in direction x: the highest x of particles below two spacings with
   at least five neighbours (nearer than the support radius), plus half a spacing. NaN if there is none. */
double metric_front(const Cloud *cloud);

/* Height of the fluid at the wall x = `wall`, above the floor y = 0. Of the particles less than three
   spacings from the wall, the mean height of the topmost half spacing, plus half a spacing. */
double metric_wall_height(const Cloud *cloud, double wall);

/* Height of the flat surface of a fluid at rest: the mean height of particles less than half a spacing
   below the highest, plus half a spacing. */
double metric_surface(const Cloud *cloud);

/* rms of p - density gravity (surface - y), over density gravity surface, of a fluid at rest on a floor y
   = 0. `points` (may be NULL) gets each particle's height and pressure. */
double metric_hydrostatic(const Cloud *cloud, double density, double gravity, Curve *points);

/* Slope of height over r^2 = x^2 + z^2, by least squares over the highest particle of each square cell
   (side: one spacing) in a box of the given width; cells at the walls are left out. `points` (may be NULL)
   gets r and height. */
double metric_paraboloid(const Cloud *cloud, double width, Curve *points);

/* The centre of mass of the particles with low <= x < high (m), equal masses. */
void metric_centre(const Cloud *cloud, double low, double high, double centre[3]);

/* Semi-axes along x and y of the ellipse with the same second moments as the particles in the plane: 2
   sqrt(<(x - mean)^2>). The particles' own extent, spacing^2 / 12, is added to the moments. */
void metric_axes(const Cloud *cloud, double axes[2]);

/* Mean pressure of the particles within `radius` of `centre`; NaN without particles. */
double metric_mean_pressure(const Cloud *cloud, const double centre[3], double radius);

typedef struct Energies {
    double kinetic, potential, elastic; /* J; potential over y = 0; elastic: of compression */
} Energies;

/* Energies of the particles in the box's frame, with the masses and the equation of state of `def`. */
void metric_energies(const Cloud *cloud, const WorldDef *def, Energies *energies);

/* Velocity at a point in 2D, by moving least squares (Shepard interpolation, linear in space) with the
   cubic kernel of the support radius. Returns false if fewer than six particles are near. */
bool metric_velocity(const Cloud *cloud, const double at[2], double velocity[2]);

#endif
