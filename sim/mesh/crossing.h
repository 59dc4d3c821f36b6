/* Where lines along x meet triangles: through a closed surface, as often inwards as outwards. */
#ifndef SLOSH_CROSSING_H
#define SLOSH_CROSSING_H

#include "sim/mesh/triangles.h"

/* Where the line along x through p meets the triangle: 1 where it comes out there, -1 where it goes in, 0: it
   does not meet it, and *x is left as it was. A line that meets an edge meets one of two triangles there. */
int triangle_crossing(const Triangles *of, size_t t, const double p[3], double *x);

#endif
