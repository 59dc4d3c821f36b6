/* Points of uniform density on a triangle mesh: polygons among transparent surfaces. After: S. Tanaka et
   al., "Particle-based transparent rendering of implicit surfaces and its application to fused
   visualization", 2012, section 5; but with a random triangle by area for each point, so that sets are
   independent. */
#ifndef SLOSH_SURFACE_POLYGONS_H
#define SLOSH_SURFACE_POLYGONS_H

#include "sim/surface/points.h"
#include "sim/surface/request.h"

/* Zero-initialise. Owns arrays made by polygons_reserve. */
typedef struct Polygons {
    size_t vertex_count, triangle_count;
    float (*place)[3];     /* per vertex, m */
    float (*normal)[3];    /* per vertex, any length; interpolated over a triangle */
    uint32_t (*corner)[3]; /* per triangle: indices of vertices */
} Polygons;

/* Makes room; old contents are lost. Returns false, with empty polygons, if memory is short. */
bool polygons_reserve(Polygons *polygons, size_t vertices, size_t triangles, Error *error);
void polygons_free(Polygons *polygons); /* a zeroed struct is allowed */

/* Least and greatest coordinates of the vertices, m; requires at least a vertex. */
void polygons_bounds(const Polygons *polygons, double low[3], double high[3]);

double polygons_area(const Polygons *polygons); /* m2 */

/* As surface_sample, with the triangles instead of the field's level. Used members of the request:
   `density`, `sets`, `seed`, `surface`, `threads` and `points_most`; a point's value is `level`. Returns
   false if the total area of the triangles is 0. */
bool polygons_sample(const Polygons *polygons, const SurfaceRequest *request, SurfacePoints *points,
                     SurfaceResult *result, Error *error);

#endif
