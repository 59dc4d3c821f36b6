/* The Brownian walk of walk.h for fields that are costly to sample and change with each picture. Walkers
   begin on triangles near the level instead of at crossings of lines, so neither lines nor counting spheres
   cost samples. The starts are uniform, as random points by area, and moved to the level by Newton's
   method. */
#ifndef SLOSH_SURFACE_NEAR_WALK_H
#define SLOSH_SURFACE_NEAR_WALK_H

#include "sim/surface/polygons.h"

/* As surface_sample, with `near`: triangles within a step of the level, as from marching cubes. Used
   members of the request: `field`, `level`, `density`, `sets`, `seed`, `surface`, `threads`, `points_most`,
   `pixel` and `step`. The area is the triangles' area. Triangles without the level within six steps do not
   belong to the surface: `result->stayed` counts walkers with a start there, which give no points. Returns
   false, with the points unchanged, if no triangle is near the level or memory is short. */
bool near_walk(const SurfaceRequest *request, const Polygons *near, SurfacePoints *points,
               SurfaceResult *result, Error *error);

#endif
