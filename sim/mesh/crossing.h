/* Where lines along x meet triangles: through a closed surface, as often inwards as outwards. */
#ifndef SLOSH_CROSSING_H
#define SLOSH_CROSSING_H

#include "sim/mesh/triangles.h"

/* Where the line along x through p meets the triangle: 1 where the line comes out there, -1 where the line
   goes in; 0: no meeting, and *x stays. A line through an edge meets one of two triangles there. */
int triangle_crossing(const Triangles *of, size_t t, const double p[3], double *x);

#endif
