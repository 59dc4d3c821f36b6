/* Points of uniform density on a level of a field, as many as an opacity needs.

   SURFACE_WALK: many walkers in Brownian motion on the surface by a stochastic differential equation.
   After: S. Tanaka et al., "Particle-based transparent rendering of implicit surfaces and its application
   to fused visualization", 2012, eq. 2, 3. Walkers begin at crossings of the surface with straight lines of
   all directions, so starts are uniform and on every part of the surface found by such lines. Counting
   spheres determine the end.

   SURFACE_TRIANGLES: points on triangles from marching cubes, with a random triangle by area for each
   point: faster and less exact.

   The points depend on the request alone, neither on the number of threads nor on the processor. */
#ifndef SLOSH_SURFACE_SAMPLING_H
#define SLOSH_SURFACE_SAMPLING_H

#include "sim/surface/points.h"
#include "sim/surface/request.h"

/* Appends to `points`, whose capacity is kept between calls. Returns false, with the points unchanged, if
   the level is empty, out of the field's range, touched but never crossed or without a gradient; if the
   field is not finite, the request invalid, or memory short. A density not reached is no error: see
   `result` and `lack`. */
bool surface_sample(const SurfaceRequest *request, SurfacePoints *points, SurfaceResult *result,
                    Error *error);

/* "walk", "triangles"; NULL past the last. */
const char *surface_sampler_name(SurfaceSampler sampler);

#endif
