/* Level set of values on a grid, as a closed mesh of triangles, by marching cubes. After: W. Lorensen, H.
   Cline, "Marching cubes: a high resolution 3D surface construction algorithm", 1987.

   Values at or above the level are inside. The outermost values of the grid always count as outside, and so
   does NaN. So the mesh is always closed: each edge belongs to two triangles with opposite directions along
   the edge. Triangles turn counter-clockwise seen from outside; no two vertices share a position. */
#ifndef SLOSH_ISOSURFACE_H
#define SLOSH_ISOSURFACE_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A vertex on the edge from value number `at` to the next value along `axis`. */
typedef struct IsoVertex {
    size_t at;
    int axis;
    float t; /* position along the edge, 0.001 .. 0.999 */
} IsoVertex;

typedef struct IsoMesh {
    int size[3]; /* of the grid */
    size_t vertex_count, triangle_count;
    IsoVertex *vertex;
    uint32_t (*triangle)[3]; /* vertices */
} IsoMesh;

/* Makes the mesh; free with isosurface_free. `values`: size[0] size[1] size[2] numbers, x fastest. Returns
   false and an empty mesh if memory is short or the mesh needs more than 2^32 - 1 vertices. */
bool isosurface(const int size[3], const float *values, float level, IsoMesh *mesh, Error *error);

void isosurface_free(IsoMesh *mesh); /* a zeroed mesh is allowed */

/* Position of a vertex, in cells from the first value. */
void isosurface_place(const IsoMesh *mesh, size_t vertex, double place[3]);

/* Enclosed volume, in cells. */
double isosurface_volume(const IsoMesh *mesh);

/* Interpolates any values of the same grid linearly along a vertex's edge. */
float isosurface_value(const IsoMesh *mesh, size_t vertex, const float *values);

/* Gradient of values at a vertex, per cell: central differences at the ends of the vertex's edge, linear
   between. */
void isosurface_slope(const IsoMesh *mesh, size_t vertex, const float *values, float slope[3]);

#endif
