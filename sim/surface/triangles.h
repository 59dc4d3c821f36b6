/* The sampler SURFACE_TRIANGLES. After: S. Tanaka et al., "Particle-based transparent rendering of implicit
   surfaces", 2012, section 5: marching cubes, then a random triangle by area for each point. */
#ifndef SLOSH_SURFACE_TRIANGLES_H
#define SLOSH_SURFACE_TRIANGLES_H

#include "sim/surface/points.h"
#include "sim/surface/request.h"

typedef struct LineSearch LineSearch; /* sim/surface/lines.h */

bool triangles_sample(const SurfaceRequest *request, const LineSearch *search, SurfacePoints *points,
                      SurfaceResult *result, Error *error);

/* The grid of marching cubes: values per axis and cell size, m, at least `times` the field's march. Returns
   the used factor, enlarged if there would be too many values for memory; cells named in the request are
   kept. */
double triangles_grid(const SurfaceRequest *request, double times, int size[3], double cell[3]);

#endif
