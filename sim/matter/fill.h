/* The region that a fill, a drain or a guide names. */
#ifndef SLOSH_FILL_H
#define SLOSH_FILL_H

#include "sim/matter/world_def.h"

/* Whether x (m) is in the region; a point that is `tolerance` m outside a block's low side is, and one as
   near inside its high side is not. */
bool fill_holds(const Fill *fill, int dimensions, const double x[3], double tolerance);

/* Whether the fill ends at a height by formula or table, which is then put into *y (m). */
bool fill_ends(const Fill *fill, double x, double z, double *y);

/* The corners of the least block around the fill whose faces are along the axes, m; a ball in two dimensions
 * has one too. */
void fill_bounds(const Fill *fill, double low[3], double high[3]);

/* m3, or in two dimensions m2. */
double fill_volume(const Fill *fill, int dimensions);

#endif
