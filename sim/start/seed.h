/* The initial state: the fills of a def become particles, each fill on its lattice
   (sim/start/fill.h). A lattice is half a layer from touching walls and in line with touching fills,
   so fluids never overlap. Where fills overlap, the first fill of the first fluid gets the point. No point is
   within half a spacing of a solid. */
#ifndef SIM_START_SEED_H
#define SIM_START_SEED_H

#include "slosh/def.h"

/* Writes position (3 each, m) and fluid of every lattice point in a fill, fill by fill, and returns the
   number of points. The order in a fill is z, y, x (x fastest). With NULLs only counts. */
size_t seed_lattice(const WorldDef *def, float *position, uint8_t *fluid);

/* Number of particles in the fills at `spacing` (m); SIZE_MAX if more than 2^32 or if the box has more than
   10^7 spacings along an axis. Walks the lattice points of each fill, allocates nothing. A bowl's thickness
   of 0 stands for the support radius. */
size_t seed_count(const WorldDef *def, double spacing);

/* Number of particles of each fluid, at the def's spacing. */
void seed_counts(const WorldDef *def, size_t counts[FLUIDS_MAX]);

/* True if the fill's height by formula or table is not finite over a point of the fill; writes x and z (m) of
   the point to `at`. */
bool seed_lacks_height(const WorldDef *def, const Fill *fill, double at[2]);

/* Moves each of `count` points by up to WorldDef.jitter spacings along each axis, the same way in each run;
   walls are no limit. */
void seed_jitter(const WorldDef *def, float *position, size_t count);

/* Greatest fall of fluid, which bounds its depth. */

/* Distance from the highest start or emitter of the def's fluids, against gravity, down to the end of the
   box, m; 0 without fluid or gravity. */
double greatest_fall(const WorldDef *def);

/* The vortices of G. I. Taylor and A. E. Green, "Mechanism of the production of small eddies from large
   ones", 1937, in the plane: an exact solution, decaying as exp(-nu (kx^2 + ky^2) t), kx = 2 pi / width, ky =
   2 pi / height,

     u = -U cos(kx x) sin(ky y),  v = U (kx / ky) sin(kx x) cos(ky y),
     p = -rho U^2 / 4 (cos(2 kx x) + (kx / ky)^2 cos(2 ky y)),

   in the box's frame, two by two vortices in the box. */

/* Adds the velocity of the fluid's vortices at x (m) to v (m/s); returns their pressure, Pa. */
double vortices_add(const WorldDef *def, const FluidDef *fluid, const float x[3], float v[3]);

/* True if some fluid starts with vortices. */
bool vortices_any(const WorldDef *def);

#endif
