/* What a closed surface encloses more than once, or less than nothing: by how much integrals over its
   triangles are more than those over the union of its parts. */
#ifndef SLOSH_OVERLAP_H
#define SLOSH_OVERLAP_H

#include "sim/mesh/triangles.h"

/* Integrals over a volume, of density 1: 1, x, and x x about the origin. */
typedef struct Moments {
    double volume, first[3], second[3][3];
} Moments;

/* The integrals of w - 1 where the winding number w is not 0: exact along x, by the middles of at least 512
   strips of the longer one of the other two sides, which end where parts do. Exact for blocks that stand
   along the axes, else within some thousandths of itself. The same bits for any number of threads. False when
   memory is short. */
bool overlap_excess(const Triangles *triangles, int threads, Moments *excess);

#endif
