/* A field on a grid, and an isosurface of the field as a closed mesh of triangles: the fluid's surface as
   `slosh export` writes it. Bins share work over threads without a change of bits. */
#ifndef SIM_MESH_H
#define SIM_MESH_H

#include "sim/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Bins in a row, and items that each reach into a span of adjacent bins. Lists the items of each bin in
   item order, so that work done bin by bin by threads has the same bits for any number of threads. */

/* Reused, so that later fills need no new memory; zero-initialise. */
typedef struct Bins {
    size_t begin_capacity, member_capacity;
    size_t *begin;    /* bins + 1 entries: begin of each bin in `member` */
    uint32_t *member; /* items, ascending in each bin */
} Bins;

/* Bins reached by an item: first <= b < end; none if first is end. */
typedef struct BinSpan {
    size_t first, end;
} BinSpan;

typedef BinSpan (*BinsReached)(const void *context, size_t item);

/* Sorts `items` items, fewer than 2^32, into `count` bins. Returns false if memory is short. */
bool bins_fill(Bins *bins, size_t count, size_t items, BinsReached reached, const void *context);
void bins_free(Bins *bins); /* a zeroed struct is allowed */

/* The fluid's field on a grid, summed on the CPU: F(r) = sum_j V_j W_poly6(|r - r_j|, h), after Müller,
   Charypar, Gross 2003, eq. 20. F is about 1 inside a fluid, 0.5 at its surface, and 0 farther than h from
   any particle. */

/* Cubic cells. The value i, j, k belongs to corner + cell (i + 1/2, j + 1/2, k + 1/2), at index i + size[0]
   (j + size[1] k). */
typedef struct VolumeGrid {
    int size[3];      /* cells, each at least 1 */
    double corner[3]; /* m: of the first cell */
    double cell;      /* m */
} VolumeGrid;

size_t volume_grid_cells(const VolumeGrid *grid);

/* The particles to sum. A particle whose position, volume or scalar is not finite is left out. */
typedef struct FieldParticles {
    size_t count;
    const float *position; /* 4 a particle: x y z (m), volume (m3) */
    const float *scalar;   /* 1 a particle, or NULL */
    double support;        /* h, m */
} FieldParticles;

/* Least and greatest coordinates of the particles not left out, m. Returns false if no particle remains. */
bool field_bounds(const FieldParticles *particles, double low[3], double high[3]);

/* Lists of the particles within reach of each slab of the grid; kept between sums to reuse the memory.
   Zero-initialise. */
typedef struct FieldSlabs {
    Bins bins;
} FieldSlabs;

void field_slabs_free(FieldSlabs *slabs); /* zeroed slabs are allowed */

/* Sets each grid value: `field` to sum V W, `weighted` to sum V W scalar; either array may be NULL. Slabs of
   the grid are summed in parallel, each value in particle order: the same bits for any number of threads.
   Weights are rounded to float before the sum. Returns false if memory is short: the values are then not
   set. */
bool field_sum(const FieldParticles *particles, const VolumeGrid *grid, int threads, FieldSlabs *slabs,
               float *field, float *weighted, Error *error);

/* For tests: the field at point r (m), summed in double over all particles: a reference to check other sums.
   `weighted` may be NULL. */
double field_at(const FieldParticles *particles, const double r[3], double *weighted);

/* Level set of values on a grid, as a closed mesh of triangles, by marching cubes. After: W. Lorensen, H.
   Cline, "Marching cubes: a high resolution 3D surface construction algorithm", 1987.

   Values at or above the level are inside. The outermost values of the grid always count as outside, and so
   does NaN. So the mesh is always closed: each edge belongs to two triangles with opposite directions along
   the edge. Triangles turn counter-clockwise seen from outside; no two vertices share a position. */

/* The triangles of a cube, by the bits of its inside corners: bit x + 2 y + 4 z for the corner at x, y, z of
   0 or 1. Edges are 4 axis + the bits of the two axes that follow. */
enum { ISO_CASES = 256, ISO_TRIANGLES_MOST = 5 };

typedef struct IsoCases {
    uint8_t triangles[ISO_CASES];                    /* number */
    uint8_t edge[ISO_CASES][3 * ISO_TRIANGLES_MOST]; /* three for each triangle */
} IsoCases;

void isosurface_cases(IsoCases *cases);

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
