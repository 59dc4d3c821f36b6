/* Triangle meshes as solids: triangles with their measures, a tree of triangles, signed distance on a grid,
   repair, and the shape made of all. */
#ifndef SIM_MESH_MESH_SHAPE_H
#define SIM_MESH_MESH_SHAPE_H

#include "sim/base/base.h"
#include "sim/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A surface of triangles as plain arrays, with volume, area and bounds. */

enum { TRIANGLES_MAX = 2000000 }; /* can be processed within some seconds and some hundred MB */

/* Triangles turn counter-clockwise seen from outside. The creator owns the arrays. */
typedef struct Triangles {
    size_t vertex_count, triangle_count;
    float (*vertex)[3];
    uint32_t (*triangle)[3];
    double largest; /* largest float in the file, before the move to 0; 0: irrelevant */
} Triangles;

void triangles_free(Triangles *triangles); /* zeroed triangles are allowed */

/* Enclosed volume and area, in the cube and the square of the mesh's unit. */
double triangles_volume(const Triangles *triangles);
double triangles_area(const Triangles *triangles);

/* Corners of the bounding box. */
void triangles_bounds(const Triangles *triangles, double low[3], double high[3]);

/* Normal of a triangle, twice the area long; and six times the signed volume of the tetrahedron with the
   origin. */
void triangle_normal(const Triangles *triangles, size_t t, double normal[3]);
double triangle_volume6(const Triangles *triangles, size_t t);

/* Reverses the triangle's direction: the back becomes the front. */
void triangle_turn(Triangles *triangles, size_t t);

/* Intersections of lines along x with triangles. A line enters a closed surface as often as it leaves. */

/* Intersects triangle t with the line along x through p. Returns 1 where the line leaves the solid (*x: the
   position), -1 where the line enters, 0 without an intersection (*x unchanged). A line through an edge
   counts as moved slightly aside, so that each crossing counts once. */
int triangle_crossing(const Triangles *of, size_t t, const double p[3], double *x);

/* The range along y of triangle t between z - `margin` and z + `margin`, and `margin` more. Lines along x
   elsewhere at this z do not cross the triangle. Empty (low above high) if the triangle is not there. */
void triangle_slice(const Triangles *of, size_t t, double z, double margin, double *low, double *high);

/* The edges of a triangle surface, and the triangles at each edge. */

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

/* Vertices at the same place become a single vertex. */

/* Connected parts of a closed surface: triangles joined by edges. Parts may touch, cut or cover each
   other. */

typedef struct Parts {
    uint32_t count;
    uint32_t *of; /* each triangle's part */
} Parts;

/* Finds the parts; free with parts_free. Where more than two triangles meet at an edge, neighbours in file
   order with opposite directions belong together. Returns false if memory is short. */
bool parts_make(Parts *parts, const Triangles *triangles, const Edges *edges);
void parts_free(Parts *parts); /* zeroed parts are allowed */

/* Repair of closed triangle surfaces from elsewhere: finds faults, and mends some. */

/* Faults found by triangles_mend. */
typedef struct TrianglesState {
    size_t open;     /* edges with a single triangle */
    size_t crowded;  /* edges with an odd number of triangles, three or more */
    size_t opposed;  /* edges whose triangles turn opposite ways */
    size_t flat;     /* triangles without area; removed if corners coincide */
    size_t doubled;  /* copies of triangles, and walls between parts: removed */
    size_t turned;   /* single parts turned outwards */
    bool inside_out; /* the whole enclosed a negative volume, and was turned */
    double gap;      /* open surface: least width, relative to the length, at which joined vertices close the
                        surface; 0: no width up to a thousandth does */
} TrianglesState;

/* Mends the surface in place. Joins vertices within a millionth of the longest side, drops unused vertices,
   turns the whole to a positive volume, then each closed part outwards, except cavities. Removes copies of
   triangles and walls between parts. Moves the middle of the bounding box to 0; `middle`: the former
   position. Returns false with the error set if all triangles are degenerate, a number is not finite, memory
   is short, or stopped. The caller must refuse open, crowded and opposed edges. */
bool triangles_mend(Triangles *triangles, const Stop *stop, double middle[3], TrianglesState *state,
                    Error *error);

/* Overlap of parts: the excess of integrals over the triangles of a closed surface, compared with integrals
   over the union of the parts. Volumes within several parts, or within a part inside out, cause the
   excess. */

/* Integrals over a volume, of density 1: 1, x, and x x about the origin. */
typedef struct Moments {
    double volume, first[3], second[3][3];
} Moments;

/* A closed mesh as a shape: triangles, distance grid and measures. Positions are relative to the middle of
   the bounding box; lengths are in the file's unit. */

typedef struct MeshShape {
    Triangles triangles;
    DistanceGrid distance;
    double half[3];      /* half the sides of the bounding box */
    double reach;        /* from the middle to the farthest vertex */
    double volume, area; /* volume: of the union of the parts; area: of the triangles */
    Moments excess;      /* integrals over the triangles less integrals over the union; 0 without overlaps */
    double depth;        /* from the surface to the place deepest inside */
    uint64_t hash;       /* of the vertices and triangles */
} MeshShape;

/* Faults of an accepted mesh. Parts overlap if the shape's excess is not 0. */
typedef struct MeshState {
    TrianglesState triangles;
    double middle[3];   /* of the bounding box, before the move to 0 */
    size_t cutting;     /* intersecting pairs of triangles */
    bool all_looked_at; /* all pairs were tested; false: there may be more */
    char coarse[200];   /* message for the user if the file's floats are too coarse so far from 0; "": fine
                           enough */
} MeshState;

/* Makes a shape; free with mesh_shape_free. Takes ownership of the triangles: `triangles` is empty on return.
   Returns NULL if the mesh encloses nothing, is open, memory is short, or `stop` (may be NULL) is wanted;
   `error` says "what is wrong; what would be right". Millions of long triangles that cut each other take
   hours. */
MeshShape *mesh_shape_make(Triangles *triangles, int threads, const Stop *stop, MeshState *state,
                           Error *error);
void mesh_shape_free(MeshShape *shape); /* NULL is allowed */

#endif
