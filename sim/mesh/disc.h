/* A flat cylinder around a few triangles, along the mean normal. On an oblique surface a disc fits closer
   than an axis-aligned block. */
#ifndef SLOSH_DISC_H
#define SLOSH_DISC_H

#include "sim/mesh/triangles.h"

typedef struct Disc {
    float middle[3], axis[3]; /* axis: length 1, or 0 */
    float radius, half;       /* half: half the thickness */
} Disc;

/* Makes a disc around the `count` triangles whose numbers are in `item`. */
Disc disc_around(const Triangles *of, const uint32_t *item, uint32_t count);

/* Squared distance from x to the disc, rounded slightly down: a lower bound. */
double disc_distance2(const Disc *disc, const double x[3]);

#endif
