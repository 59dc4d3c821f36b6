/* Points on a mesh of triangles, as dense everywhere: polygons among transparent surfaces. After: S. Tanaka
   et al., "Particle-based transparent rendering of implicit surfaces and its application to fused
   visualization", 2012, section 5; but each point on a triangle drawn by chance, by its area, so that sets
   are independent. */
#ifndef SLOSH_SURFACE_POLYGONS_H
#define SLOSH_SURFACE_POLYGONS_H

#include "sim/surface/points.h"
#include "sim/surface/request.h"

/* Zero-initialise it. Arrays that polygons_reserve made belong to it. */
typedef struct Polygons {
    size_t vertex_count, triangle_count;
    float (*place)[3];     /* of each vertex, m */
    float (*normal)[3];    /* of each vertex, of any length; mixed over a triangle */
    uint32_t (*corner)[3]; /* of each triangle: numbers of vertices */
} Polygons;

/* Makes room, with what is there not kept. False, and they are empty, when memory is short. */
bool polygons_reserve(Polygons *polygons, size_t vertices, size_t triangles, Error *error);
void polygons_free(Polygons *polygons); /* a zeroed one is allowed */

/* The least and greatest coordinates of the vertices, m; there is one at least. */
void polygons_bounds(const Polygons *polygons, double low[3], double high[3]);

double polygons_area(const Polygons *polygons); /* m2 */

/* As surface_sample, with the triangles in place of the field's level. Of the request `density`, `sets`,
   `seed`, `surface`, `threads` and `points_most` count; a point's value is `level`. False where all triangles
   together have no area. */
bool polygons_sample(const Polygons *polygons, const SurfaceRequest *request, SurfacePoints *points,
                     SurfaceResult *result, Error *error);

#endif
