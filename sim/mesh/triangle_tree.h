/* Bounding volume tree of triangles: a binary tree of axis-aligned blocks, with discs around few
   triangles. The block of a long triangle askew is mostly empty, so such triangles are there in pieces, each
   with a block: M. Ernst, G. Greiner, "Early split clipping for bounding volume hierarchies", 2007. */
#ifndef SLOSH_TRIANGLE_TREE_H
#define SLOSH_TRIANGLE_TREE_H

#include "sim/mesh/disc.h"

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

#endif
