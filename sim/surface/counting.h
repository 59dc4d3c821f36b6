/* Counting spheres: measure the density of points on nearly flat parts of a surface. After: S. Tanaka et
   al., "Particle-based transparent rendering of implicit surfaces", 2012, section 4: a small sphere about
   each of a hundred random points of the surface. The surface cuts the sphere in a great circle of area S,
   and n points fall into the sphere.

   A sphere that holds more surface than its great circle would count too many points. So in a valid sphere
   all known points of the surface are near the tangent plane and have similar normals, and the bounds do
   not cut the sphere. If few spheres are valid, all are made smaller. On surfaces folded more finely than
   the known points show, n is still wrong: sampling.c compares n with the area. */
#ifndef SLOSH_SURFACE_COUNTING_H
#define SLOSH_SURFACE_COUNTING_H

#include "sim/surface/lines.h"
#include "sim/surface/points.h"

enum { COUNTING_SPHERES = 250, COUNTING_CANDIDATES = 750, COUNTING_CELLS = 24 };

typedef struct Counting {
    int count; /* of spheres, at most COUNTING_SPHERES */
    float centre[COUNTING_SPHERES][3], radius;
    uint32_t inside[COUNTING_SPHERES]; /* points counted so far */
    double low[3], cell[3];            /* of a grid over the surface that lists the spheres near a cell */
    uint32_t begin[COUNTING_CELLS * COUNTING_CELLS * COUNTING_CELLS + 1];
    uint8_t *member;
} Counting;

/* Chooses spheres about crossings from number `walkers` on, where no walker began: around its own start a
   walker would count too many points. With fewer than COUNTING_CANDIDATES further crossings, about any
   crossing. Returns false if memory is short. */
bool counting_begin(Counting *counting, const LineSearch *search, const Crossings *crossings, size_t walkers,
                    Error *error);

void counting_add(Counting *counting, const SurfacePoint *point, size_t count, int threads);

double counting_mean(const Counting *counting); /* n */

void counting_end(Counting *counting);

#endif
