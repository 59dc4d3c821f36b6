/* The initial state: the fills of a def become particles, each fill on its lattice (sim/fill_lattice.h): half
   a layer from the walls that it touches, and in line with the fills that it touches, so that fluids never
   overlap. Where fills overlap, the first fill of the first fluid has the point; none is within half a
   spacing of a solid. */
#ifndef SLOSH_SEED_H
#define SLOSH_SEED_H

#include "sim/world_def.h"

/* Writes positions (3 each) and fluid of every lattice point that a fill covers, fill by fill and in each in
   the order z, y, x (x fastest), and returns how many there are; with NULLs it only counts. */
size_t seed_lattice(const WorldDef *def, float *position, uint8_t *fluid);

/* How many of them each fluid has. */
void seed_counts(const WorldDef *def, size_t counts[FLUIDS_MAX]);

/* Whether x (m) is in the region; a point that is `tolerance` m outside a block's low side is, and one as
   near inside its high side is not. */
bool fill_holds(const Fill *fill, int dimensions, const double x[3], double tolerance);

/* The corners of the least block with faces along the axes around it, m; of a ball in two dimensions too. */
void fill_bounds(const Fill *fill, double low[3], double high[3]);

/* m3, or in two dimensions m2. */
double fill_volume(const Fill *fill, int dimensions);

/* Moves each of `count` points by up to WorldDef.jitter spacings along each axis, the same way in each run;
   walls are no bounds to it. */
void seed_jitter(const WorldDef *def, float *position, size_t count);

#endif
