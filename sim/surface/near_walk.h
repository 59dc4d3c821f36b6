/* The Brownian walk of walk.h for a field whose samples are dear and whose surface changes with each picture:
   walkers begin on triangles near the level instead of where lines cross it, so neither lines nor counting
   spheres cost samples. Uniform from the start, as points by area are, and on the level by Newton's method.
 */
#ifndef SLOSH_SURFACE_NEAR_WALK_H
#define SLOSH_SURFACE_NEAR_WALK_H

#include "sim/surface/polygons.h"

/* As surface_sample, where `near` are triangles within a step of the level, as marching cubes make them. Of
   the request `field`, `level`, `density`, `sets`, `seed`, `surface`, `threads`, `points_most`, `pixel` and
   `step` count. The area is that of the triangles; those of them that have none of the level within six steps
   are the surface's no more: `result->stayed` counts the walkers that began there, which have no points.
   False, with the points as they were, where that is all of them, or memory is short. */
bool near_walk(const SurfaceRequest *request, const Polygons *near, SurfacePoints *points,
               SurfaceResult *result, Error *error);

#endif
