/* Counting spheres: how dense points on a surface are where it is as good as flat. After: S. Tanaka et al.,
   "Particle-based transparent rendering of implicit surfaces", 2012, section 4: about each of a hundred
   random places of the surface a small sphere; the surface cuts it in its great circle, of area S, and n
   points fall into it.

   A sphere into which more of the surface reaches than its great circle would count too many: only those are
   taken in which all known places of the surface lie near the tangent plane and have about the same normal,
   and which the bounds do not cut. Where hardly any is, all are made smaller. Where it is folded more
   finely than the known places tell, n is wrong all the same: sampling.c checks it against the area. */
#ifndef SLOSH_SURFACE_COUNTING_H
#define SLOSH_SURFACE_COUNTING_H

#include "sim/surface/lines.h"
#include "sim/surface/points.h"

enum { COUNTING_SPHERES = 250, COUNTING_CANDIDATES = 750, COUNTING_CELLS = 24 };

typedef struct Counting {
    int count; /* of spheres, at most COUNTING_SPHERES */
    float centre[COUNTING_SPHERES][3], radius;
    uint32_t inside[COUNTING_SPHERES]; /* points so far */
    double low[3], cell[3]; /* of a grid over the surface that says which spheres may hold a point */
    uint32_t begin[COUNTING_CELLS * COUNTING_CELLS * COUNTING_CELLS + 1];
    uint8_t *member;
} Counting;

/* About places where no walker began, from the given number on, since a walker about its own first place
   would count too much; about any where there are not COUNTING_CANDIDATES more. False when memory is short.
 */
bool counting_begin(Counting *counting, const LineSearch *search, const Crossings *crossings, size_t walkers,
                    Error *error);

void counting_add(Counting *counting, const SurfacePoint *point, size_t count, int threads);

double counting_mean(const Counting *counting); /* n */

void counting_end(Counting *counting);

#endif
