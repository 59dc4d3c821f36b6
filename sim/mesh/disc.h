/* A flat cylinder around a few triangles, along their mean normal: where a surface leans, a block stands out
   of it, and a disc does not. */
#ifndef SLOSH_DISC_H
#define SLOSH_DISC_H

#include "sim/mesh/triangles.h"

typedef struct Disc {
    float middle[3], axis[3]; /* the axis: of length 1, or 0 */
    float radius, half;       /* half: of its thickness */
} Disc;

/* Around those triangles whose numbers are in `item`. */
Disc disc_around(const Triangles *of, const uint32_t *item, uint32_t count);

/* The square of the distance from x, or a little less: never more. */
double disc_distance2(const Disc *disc, const double x[3]);

#endif
