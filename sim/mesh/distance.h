/* The signed distance from a closed surface of triangles on a grid: less than 0 inside.

   Values belong to the corners of cubic cells, x fastest, and are straight lines between them. Near the
   surface each is exact; far from it, where nothing but its size matters, it is that of a grid four times as
   coarse, up to 2 % too much. What is inside is said by the winding number along lines of the grid, so that
   parts that overlap are one body, and surfaces of parts within the body do not count. A part thinner than a
   cell may be lost. */
#ifndef SLOSH_DISTANCE_H
#define SLOSH_DISTANCE_H

#include "sim/mesh/triangle_tree.h"

typedef struct DistanceGrid {
    int size[3];     /* corners of cells, along each axis */
    double low[3];   /* where the first stands */
    double cell;     /* from one to the next */
    double inner[3]; /* the surface is within -inner .. inner */
    bool overlaps;   /* some node is in several parts, or in a part inside out */
    float *value;
} DistanceGrid;

/* Of the tree's triangles, around 0. The same bits for any number of threads. False when memory is short. */
bool distance_make(DistanceGrid *grid, const TriangleTree *tree, int threads);
void distance_free(DistanceGrid *grid); /* a zeroed one is allowed */

size_t distance_count(const DistanceGrid *grid);

/* At x; beyond the grid no more than the distance. `slope` (may be NULL): how it grows along each axis,
   beyond the grid as at its edge. */
double distance_at(const DistanceGrid *grid, const double x[3], double slope[3]);

/* How deep the deepest value is below 0, and the volume that is deeper than `depth`. */
double distance_deepest(const DistanceGrid *grid);
double distance_volume_below(const DistanceGrid *grid, double depth);

#endif
