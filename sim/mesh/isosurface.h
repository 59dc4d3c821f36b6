/* Where values on a grid cross a level: a closed mesh of triangles, by marching cubes. After: W. Lorensen,
   H. Cline, "Marching cubes: a high resolution 3D surface construction algorithm", 1987.

   Inside is where a value is at least the level; the grid's outermost values count as outside whatever they
   are. So the mesh is always closed: each edge belongs to two triangles, which run through it in opposite
   directions; triangles turn counter-clockwise seen from outside; no two vertices share a place. Values that
   are no numbers are outside. */
#ifndef SLOSH_ISOSURFACE_H
#define SLOSH_ISOSURFACE_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* On the edge from the value `at` to the next one along `axis`. */
typedef struct IsoVertex {
    size_t at;
    int axis;
    float t; /* how far along the edge, 0.001 .. 0.999 */
} IsoVertex;

typedef struct IsoMesh {
    int size[3]; /* of the grid */
    size_t vertex_count, triangle_count;
    IsoVertex *vertex;
    uint32_t (*triangle)[3]; /* vertices */
} IsoMesh;

/* `values` has size[0] size[1] size[2] numbers, x fastest. False when memory is short, or there are more than
   2^32 vertices: then the mesh is empty. */
bool isosurface(const int size[3], const float *values, float level, IsoMesh *mesh, Error *error);

void isosurface_free(IsoMesh *mesh); /* a zeroed one is allowed */

/* The place of a vertex, in cells from the first value. */
void isosurface_place(const IsoMesh *mesh, size_t vertex, double place[3]);

/* What the mesh encloses, in cells. */
double isosurface_volume(const IsoMesh *mesh);

/* Any values on the same grid at a vertex, linear along its edge. */
float isosurface_value(const IsoMesh *mesh, size_t vertex, const float *values);

/* The slope of values at a vertex, per cell: central differences at the ends of its edge, linear between. */
void isosurface_slope(const IsoMesh *mesh, size_t vertex, const float *values, float slope[3]);

#endif
