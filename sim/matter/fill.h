/* The region of a fill, a drain or a guide. */
#ifndef SLOSH_FILL_H
#define SLOSH_FILL_H

#include "sim/matter/world_def.h"

/* True if x (m) is in the region. Both faces of a block are shifted down by `tolerance` (m): a point so near
   outside the low side is in. A point so near inside the high side is not. */
bool fill_holds(const Fill *fill, int dimensions, const double x[3], double tolerance);

/* True if the fill ends at a height by formula or table; writes the height at x and z to *y, m. */
bool fill_ends(const Fill *fill, double x, double z, double *y);

/* Corners of the smallest block around the fill with faces along the axes, m; in two dimensions a ball has a
   z range too. */
void fill_bounds(const Fill *fill, double low[3], double high[3]);

/* Volume of the fill without regard to `below`, m3; in two dimensions area, m2. */
double fill_volume(const Fill *fill, int dimensions);

#endif
