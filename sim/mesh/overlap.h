/* Overlap of parts: the excess of integrals over the triangles of a closed surface, compared with integrals
   over the union of the parts. Volumes within several parts, or within a part inside out, cause the
   excess. */
#ifndef SLOSH_OVERLAP_H
#define SLOSH_OVERLAP_H

#include "sim/base/stop.h"
#include "sim/mesh/triangles.h"

/* Integrals over a volume, of density 1: 1, x, and x x about the origin. */
typedef struct Moments {
    double volume, first[3], second[3][3];
} Moments;

/* Integrates w - 1 where the winding number w is not 0. Exact along x; in y and z by the middles of strips,
   at least 512 along the longer side; strips end where parts end. Exact for blocks along the axes, else
   within some thousandths of the excess. The same bits for any number of threads. Returns false if memory is
   short, or stopped. */
bool overlap_excess(const Triangles *triangles, int threads, const Stop *stop, Moments *excess);

#endif
