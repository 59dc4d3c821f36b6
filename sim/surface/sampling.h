/* Points of uniform density on a level of a field, as many as an opacity needs.

   SURFACE_WALK: many walkers in Brownian motion on the surface by a stochastic differential equation. After:
   S. Tanaka et al., "Particle-based transparent rendering of implicit surfaces and its application to fused
   visualization", 2012, eq. 2, 3. They begin where straight lines of all directions cross the surface, so
   they are uniform from the start and reach every part of it that such lines find. Counting spheres end it.
   SURFACE_TRIANGLES: points on triangles by marching cubes, each triangle drawn by chance, by its area:
   faster and less exact.

   The points depend on the request alone: not on the number of threads, nor on the processor. */
#ifndef SLOSH_SURFACE_SAMPLING_H
#define SLOSH_SURFACE_SAMPLING_H

#include "sim/surface/points.h"
#include "sim/surface/request.h"

/* Appends to `points`, which keep their capacity from call to call. False, with the points as they were, when
   the level is empty, out of the field's range, touched but never crossed, without a gradient, or the field
   is no number; when the request makes no sense; or when memory is short. A density that was not reached is
   no error: `result` has it, and `lack` says why. */
bool surface_sample(const SurfaceRequest *request, SurfacePoints *points, SurfaceResult *result,
                    Error *error);

/* "walk", "triangles"; NULL past the last. */
const char *surface_sampler_name(SurfaceSampler sampler);

#endif
