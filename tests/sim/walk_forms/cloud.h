/* Particles for the forms of the neighbour walk: a jittered lattice, sorted by cells in one of several ways.
 */
#ifndef SLOSH_WALK_FORMS_CLOUD_H
#define SLOSH_WALK_FORMS_CLOUD_H

#include "sim/cpu/pairs.h"

/* How the particles are sorted, and how far lists see. */
typedef struct Shape {
    float edge;  /* of a cell, in h */
    float reach; /* of lists, in h: more than 1 with a skin */
    bool curve;  /* cells along a Morton curve; else row behind row, x fastest */
} Shape;

typedef struct Cloud {
    Shape shape;
    Constants constants, wide; /* `wide`: h times the reach of lists */
    PairArgs args, making;     /* of passes; of lists: the same with `wide` */
    CellFold fold;
    int across;        /* cells that a particle sees on each side of its own */
    uint32_t *axis[3]; /* cell (i, j, k) has the number axis[0][i] + axis[1][j] + axis[2][k] */

    int32_t *numbers;         /* 0, 1, 2... */
    uint32_t *first, *length; /* of each particle: its list */
    uint32_t *index;          /* entries of these lists: whole LANES each, filled up with `args.count` */
    size_t used;
    float (*sum)[4]; /* forces, where pairs are visited once */
    NeighbourLists side_by_side;

    void *piece[40]; /* what it has of memory */
    int pieces;
} Cloud;

/* side^3 particles, the same ones in each shape. */
Cloud *cloud_create(size_t side, const Shape *shape);
void cloud_destroy(Cloud *cloud);

/* Particles [begin, end) that stand in one piece. */
typedef struct Run {
    uint32_t begin, end;
} Run;

enum { RUNS = 27 };

/* The runs in the cells around particle i; returns how many. */
int cloud_runs(const Cloud *cloud, size_t i, Run runs[RUNS]);

#endif
