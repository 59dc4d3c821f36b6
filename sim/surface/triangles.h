/* The sampler SURFACE_TRIANGLES. After: S. Tanaka et al., "Particle-based transparent rendering of implicit
   surfaces", 2012, section 5: marching cubes, then each triangle gets points in proportion to its area. */
#ifndef SLOSH_SURFACE_TRIANGLES_H
#define SLOSH_SURFACE_TRIANGLES_H

#include "sim/surface/lines.h"
#include "sim/surface/points.h"
#include "sim/surface/request.h"

bool triangles_sample(const SurfaceRequest *request, const LineSearch *search, SurfacePoints *points,
                      SurfaceResult *result, Error *error);

#endif
