/* The initial state: the fills of a def become particles, each fill on its lattice
   (sim/matter/fill_lattice.h). A lattice is half a layer from touching walls and in line with touching fills,
   so fluids never overlap. Where fills overlap, the first fill of the first fluid gets the point. No point is
   within half a spacing of a solid. */
#ifndef SLOSH_SEED_H
#define SLOSH_SEED_H

#include "sim/matter/world_def.h"

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

#endif
