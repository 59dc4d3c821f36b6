/* Triangles by where they are: a binary tree of blocks around them, and of discs around those of a few. */
#ifndef SLOSH_TRIANGLE_TREE_H
#define SLOSH_TRIANGLE_TREE_H

#include "sim/mesh/disc.h"

typedef struct TreeNode {
    float low[3], high[3];
    uint32_t first; /* leaf: into `order`; else the child on the far side: the near one comes next */
    uint32_t count; /* of a leaf's triangles; 0: no leaf */
    Disc disc;      /* of few triangles; else its radius is endless */
} TreeNode;

typedef struct TriangleTree {
    const Triangles *of;
    TreeNode *node;
    uint32_t *order;
    float (*corner)[9]; /* of the triangle at each place of `order` */
    double (*plane)[4]; /* its unit normal, and how far the plane is from 0; of a needle all 0 */
    size_t node_count;
} TriangleTree;

/* False when memory is short. `triangles` must outlive it. */
bool triangle_tree_make(TriangleTree *tree, const Triangles *triangles);
void triangle_tree_free(TriangleTree *tree);

/* The distance from x to the nearest triangle. *near, a place of `order`, is where to begin, and then the
   nearest: places that follow each other mostly have the same. */
double triangle_tree_nearest(const TriangleTree *tree, const double x[3], uint32_t *near);

/* The same, up to that part of it too much: where all triangles are nearly as near, the nearest is dear. */
double triangle_tree_near(const TriangleTree *tree, const double x[3], double part, uint32_t *near);

/* Pairs of triangles that share no vertex and cut each other: at most `most` of them, after at most `tests`
   pairs of triangles looked at; *whole says whether all were. */
size_t triangle_tree_cuts(const TriangleTree *tree, size_t most, size_t tests, bool *whole);

#endif
