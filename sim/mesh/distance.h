/* Signed distance from a closed triangle surface, on a grid: negative inside.

   Values belong to the corners of cubic cells, x fastest, and are linear between corners. Near the surface
   each value is exact. Far from the surface only the magnitude matters: values come from a grid four times as
   coarse, up to 2 % too large. The winding number along grid lines decides between inside and outside:
   overlapping parts form a single body, and surfaces of parts within the body do not count. A part thinner
   than a cell may be lost. */
#ifndef SLOSH_DISTANCE_H
#define SLOSH_DISTANCE_H

#include "sim/base/stop.h"
#include "sim/mesh/triangle_tree.h"

typedef struct DistanceGrid {
    int size[3];     /* cell corners along each axis */
    double low[3];   /* position of the first corner */
    double cell;     /* distance between neighbouring corners */
    double inner[3]; /* the surface is within -inner .. inner */
    bool overlaps;   /* some node is in several parts, or in a part inside out */
    float *value;
} DistanceGrid;

/* Makes the grid for the triangles of `tree`, centred on 0; free with distance_free. The same bits for any
   number of threads. Returns false if memory is short, or stopped. */
bool distance_make(DistanceGrid *grid, const TriangleTree *tree, int threads, const Stop *stop);
void distance_free(DistanceGrid *grid); /* a zeroed grid is allowed */

size_t distance_count(const DistanceGrid *grid);

/* Signed distance at x; beyond the grid a lower bound. `slope` (may be NULL): derivative along each axis,
   beyond the grid as at the grid's edge. */
double distance_at(const DistanceGrid *grid, const double x[3], double slope[3]);

/* Depth of the deepest value below the surface, and the volume deeper than `depth`. */
double distance_deepest(const DistanceGrid *grid);
double distance_volume_below(const DistanceGrid *grid, double depth);

#endif
