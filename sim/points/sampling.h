/* Points of uniform density on a level of a field, as many as an opacity needs.

   SURFACE_WALK: many walkers in Brownian motion on the surface by a stochastic differential equation.
   After: S. Tanaka et al., "Particle-based transparent rendering of implicit surfaces and its application
   to fused visualization", 2012, eq. 2, 3. Walkers begin at crossings of the surface with straight lines of
   all directions, so starts are uniform and on every part of the surface found by such lines. Counting
   spheres determine the end.

   SURFACE_TRIANGLES: points on triangles from marching cubes, with a random triangle by area for each
   point: faster and less exact.

   The points depend on the request alone, neither on the number of threads nor on the processor. */
#ifndef SIM_POINTS_SAMPLING_H
#define SIM_POINTS_SAMPLING_H

#include "sim/points/points.h"

/* Appends to `points`, whose capacity is kept between calls. Returns false, with the points unchanged, if
   the level is empty, out of the field's range, touched but never crossed or without a gradient; if the
   field is not finite, the request invalid, or memory short. A density not reached is no error: see
   `result` and `lack`. */
bool surface_sample(const SurfaceRequest *request, SurfacePoints *points, SurfaceResult *result,
                    Error *error);

/* "walk", "triangles"; NULL past the last. */
const char *surface_sampler_name(SurfaceSampler sampler);

/* The sampler SURFACE_TRIANGLES. After: S. Tanaka et al., "Particle-based transparent rendering of implicit
   surfaces", 2012, section 5: marching cubes, then a random triangle by area for each point. */

typedef struct LineSearch LineSearch; /* sim/points/points.h */

bool triangles_sample(const SurfaceRequest *request, const LineSearch *search, SurfacePoints *points,
                      SurfaceResult *result, Error *error);

/* The grid of marching cubes: values per axis and cell size, m, at least `times` the field's march. Returns
   the used factor, enlarged if there would be too many values for memory; cells named in the request are
   kept. */
double triangles_grid(const SurfaceRequest *request, double times, int size[3], double cell[3]);

/* The Brownian walk of walk.h for fields that are costly to sample and change with each picture. Walkers
   begin on triangles near the level instead of at crossings of lines, so neither lines nor counting spheres
   cost samples. The starts are uniform, as random points by area, and moved to the level by Newton's
   method. */

/* As surface_sample, with `near`: triangles within a step of the level, as from marching cubes. Used
   members of the request: `field`, `level`, `density`, `sets`, `seed`, `surface`, `threads`, `points_most`,
   `pixel` and `step`. The area is the triangles' area. Triangles without the level within six steps do not
   belong to the surface: `result->stayed` counts walkers with a start there, which give no points. Returns
   false, with the points unchanged, if no triangle is near the level or memory is short. */
bool near_walk(const SurfaceRequest *request, const Polygons *near, SurfacePoints *points,
               SurfaceResult *result, Error *error);

/* A device that runs a walk's steps and colours its points instead of the CPU's threads: sim/gpu/surface.
   Seeds, counting spheres and the end of sampling stay with sampling.h. */

typedef struct Walk Walk;         /* sim/points/walk.h */
typedef struct Counting Counting; /* sim/points/level_kind.h */

/* Functions return false with an error if the device cannot take the field or the memory; call `end` in any
   case. */
struct SurfaceDevice {
    void *own;
    /* Takes field, walkers and spheres for about `points` points. */
    bool (*begin)(void *own, const Walk *walk, const Counting *counting, size_t points, Error *error);
    /* Runs the walk's next steps. Appends the points in the order of Walk.out and adds to the counting
       spheres' `inside`. Without `keep` the points are dropped. */
    bool (*steps)(void *own, const Walk *walk, bool keep, Counting *counting, Error *error);
    bool (*colour)(void *own, const LevelField *field, Error *error);
    /* Copies the first `count` points to `out`; if `out` is NULL the points stay on the device. */
    bool (*points)(void *own, size_t count, SurfacePoint *out, Error *error);
    size_t (*taken)(void *own); /* accepted steps of all walkers */
    void (*end)(void *own);
};

#endif
