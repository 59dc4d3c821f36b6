/* The edges of a triangle surface, and the triangles at each edge. */
#ifndef SIM_MESH_DISTANCE_H
#define SIM_MESH_DISTANCE_H

#include "sim/base/stop.h"
#include "sim/mesh/triangles.h"

typedef struct Edges {
    size_t count;
    uint32_t *first; /* count + 1 entries: begin of each edge's sides in `side` */
    uint32_t *side;  /* 3 t + c: from corner c of triangle t to the next corner; ascending at each edge */
} Edges;

/* Finds the edges; free with edges_free. Vertices are equal if their numbers are equal. Returns false if
   memory is short. */
bool edges_make(Edges *edges, const Triangles *triangles);
void edges_free(Edges *edges); /* zeroed edges are allowed */

/* True if a side runs from the vertex with the lesser number to the vertex with the greater. */
bool side_forward(const Triangles *triangles, uint32_t side);

/* A flat cylinder around a few triangles, along the mean normal. On an oblique surface a disc fits closer
   than an axis-aligned block. */

typedef struct Disc {
    float middle[3], axis[3]; /* axis: length 1, or 0 */
    float radius, half;       /* half: half the thickness */
} Disc;

/* Makes a disc around the `count` triangles whose numbers are in `item`. */
Disc disc_around(const Triangles *of, const uint32_t *item, uint32_t count);

/* Squared distance from x to the disc, rounded slightly down: a lower bound. */
double disc_distance2(const Disc *disc, const double x[3]);

/* Bounding volume tree of triangles: a binary tree of axis-aligned blocks, with discs around few
   triangles. The block of a long triangle askew is mostly empty, so such triangles are there in pieces, each
   with a block: M. Ernst, G. Greiner, "Early split clipping for bounding volume hierarchies", 2007. */

typedef struct TreeNode {
    float low[3], high[3];
    uint32_t first; /* leaf: first place in `order`; else second child; the first child comes next */
    uint32_t count; /* triangles of a leaf; 0: inner node */
    Disc disc;      /* around few triangles; many triangles: infinite radius */
} TreeNode;

typedef struct TriangleTree {
    const Triangles *of;
    TreeNode *node;
    uint32_t *order;    /* triangles; a triangle in pieces is there several times */
    size_t piece_count; /* places of `order` */
    float (*corner)[9]; /* corners of the triangle at each place of `order` */
    double (*plane)[4]; /* unit normal, and the plane's offset from 0; all 0 for a needle */
    size_t node_count;
} TriangleTree;

/* Makes the tree; free with triangle_tree_free. `triangles` must outlive the tree. `pieces`: with long
   triangles in pieces, for distances. Returns false if memory is short. */
bool triangle_tree_make(TriangleTree *tree, const Triangles *triangles, bool pieces);
void triangle_tree_free(TriangleTree *tree);

/* Distance from x to the nearest triangle. *near, a place of `order`: on entry the first guess, on return the
   nearest triangle. Neighbouring points mostly share the nearest triangle, so pass the last result. */
double triangle_tree_nearest(const TriangleTree *tree, const double x[3], uint32_t *near);

/* Approximate distance, too large by at most the fraction `part`. Faster than the exact search where many
   triangles are almost equally near. */
double triangle_tree_near(const TriangleTree *tree, const double x[3], double part, uint32_t *near);

/* Calls `met` for each triangle that may be crossed by the line from p along x, upwards. For a tree without
   pieces. */
void triangle_tree_ahead(const TriangleTree *tree, const double p[3],
                         void (*met)(void *context, uint32_t triangle), void *context);

enum { CUTS_MOST = 1000 };

/* Counts intersecting pairs of triangles without a shared vertex: at most CUTS_MOST pairs, after at most
   `tests` tested pairs. *whole: true if all pairs were tested. */
size_t triangle_tree_cuts(const TriangleTree *tree, size_t tests, bool *whole);

/* Signed distance from a closed triangle surface, on a grid: negative inside.

   Values belong to the corners of cubic cells, x fastest, and are linear between corners. Near the surface
   each value is exact. Far from the surface only the magnitude matters: values come from a grid four times as
   coarse, up to 2 % too large. The winding number along grid lines decides between inside and outside:
   overlapping parts form a single body, and surfaces of parts within the body do not count. A part thinner
   than a cell may be lost. */

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
