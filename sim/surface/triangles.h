/* The sampler SURFACE_TRIANGLES. After: S. Tanaka et al., "Particle-based transparent rendering of implicit
   surfaces", 2012, section 5: marching cubes, then each point on a triangle drawn by chance, by its area. */
#ifndef SLOSH_SURFACE_TRIANGLES_H
#define SLOSH_SURFACE_TRIANGLES_H

#include "sim/surface/points.h"
#include "sim/surface/request.h"

typedef struct LineSearch LineSearch; /* sim/surface/lines.h */

bool triangles_sample(const SurfaceRequest *request, const LineSearch *search, SurfacePoints *points,
                      SurfaceResult *result, Error *error);

/* The grid that marches: its values along each axis, and its cells, m, of at least so many `times` the
   field's own march. Returns how many times they are where there would be too many for memory; cells that the
   request names stay. */
double triangles_grid(const SurfaceRequest *request, double times, int size[3], double cell[3]);

#endif
