/* Intersections of lines along x with triangles. A line enters a closed surface as often as it leaves. */
#ifndef SLOSH_CROSSING_H
#define SLOSH_CROSSING_H

#include "sim/mesh/triangles.h"

/* Intersects triangle t with the line along x through p. Returns 1 where the line leaves the solid (*x: the
   position), -1 where the line enters, 0 without an intersection (*x unchanged). A line through an edge
   counts as moved slightly aside, so that each crossing counts once. */
int triangle_crossing(const Triangles *of, size_t t, const double p[3], double *x);

/* The range along y of triangle t between z - `margin` and z + `margin`, and `margin` more. Lines along x
   elsewhere at this z do not cross the triangle. Empty (low above high) if the triangle is not there. */
void triangle_slice(const Triangles *of, size_t t, double z, double margin, double *low, double *high);

#endif
