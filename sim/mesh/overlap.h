/* Volumes within several parts of a closed surface, or within a part inside out: by how much integrals over
   the triangles exceed integrals over the union of the parts. */
#ifndef SLOSH_OVERLAP_H
#define SLOSH_OVERLAP_H

#include "sim/mesh/triangles.h"

/* Integrals over a volume, of density 1: 1, x, and x x about the origin. */
typedef struct Moments {
    double volume, first[3], second[3][3];
} Moments;

/* The integrals of w - 1 where the winding number w is not 0: exact along x, by the middles of at least 512
   strips of the longer of the other two sides; strips end where parts end. Exact for blocks along the axes,
   else within some thousandths of the excess. The same bits for any number of threads. False when memory is
   short. */
bool overlap_excess(const Triangles *triangles, int threads, Moments *excess);

#endif
