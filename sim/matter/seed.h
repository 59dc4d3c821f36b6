/* The initial state: the fills of a def become particles, each fill on its lattice
   (sim/matter/fill_lattice.h): half a layer from the walls that it touches, and in line with the fills that
   it touches, so that fluids never overlap. Where fills overlap, the first fill of the first fluid has the
   point; none is within half a spacing of a solid. */
#ifndef SLOSH_SEED_H
#define SLOSH_SEED_H

#include "sim/matter/world_def.h"

/* Writes positions (3 each) and fluid of every lattice point that a fill covers, fill by fill and in each in
   the order z, y, x (x fastest), and returns how many there are; with NULLs it only counts. */
size_t seed_lattice(const WorldDef *def, float *position, uint8_t *fluid);

/* How many particles the fills give at `spacing` (m); SIZE_MAX when more than 2^32. Walks the
   lattice's points in each fill, allocates nothing. A bowl's thickness of 0 stands for the support radius. */
size_t seed_count(const WorldDef *def, double spacing);

/* How many of them each fluid has. */
void seed_counts(const WorldDef *def, size_t counts[FLUIDS_MAX]);

/* Whether a height by formula has no value over a point of that fill, which is then put into `at` (x, z, m).
 */
bool seed_lacks_height(const WorldDef *def, const Fill *fill, double at[2]);

/* Moves each of `count` points by up to WorldDef.jitter spacings along each axis, the same way in each run;
   walls are no bounds to it. */
void seed_jitter(const WorldDef *def, float *position, size_t count);

#endif
