/* libslosh: the surface of a fluid as a closed mesh of triangles. slosh/scene.h has the rules for all
   functions. */
#ifndef SLOSH_MESH_H
#define SLOSH_MESH_H

#include "slosh/world.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct slosh_mesh slosh_mesh;

/* Makes the surface of the present state in the box's frame, by marching cubes over F(r) = sum V W(r - r_j):
   about 1 within the fluid, 0.5 at the surface. `level`: of F, above 0 and below 1; 0: 0.5. `cell`: of the
   grid, in spacings, 0.1 to 10; 0: 0.5. Worlds of two dimensions have no surface. Free with slosh_mesh_free.
 */
SLOSH_API slosh_mesh *slosh_mesh_create(slosh_world *world, double level, double cell, slosh_error *error);
SLOSH_API void slosh_mesh_free(slosh_mesh *mesh); /* NULL is allowed */

/* Vertices: three float32 each, m. Triangles: three indices each, counter-clockwise seen from outside. Valid
   until slosh_mesh_free. */
SLOSH_API size_t slosh_mesh_vertex_count(const slosh_mesh *mesh);
SLOSH_API const float *slosh_mesh_vertices(const slosh_mesh *mesh);
SLOSH_API size_t slosh_mesh_triangle_count(const slosh_mesh *mesh);
SLOSH_API const uint32_t *slosh_mesh_triangles(const slosh_mesh *mesh);

/* Enclosed volume, m3. */
SLOSH_API double slosh_mesh_volume(const slosh_mesh *mesh);

#ifdef __cplusplus
}
#endif

#endif
