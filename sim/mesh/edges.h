/* The edges of a surface of triangles, and the triangles at each. */
#ifndef SLOSH_MESH_EDGES_H
#define SLOSH_MESH_EDGES_H

#include "sim/mesh/triangles.h"

typedef struct Edges {
    size_t count;
    uint32_t *first; /* count + 1: of each edge's sides in `side` */
    uint32_t *side;  /* 3 t + c: from corner c of triangle t to the next corner; ascending at each edge */
} Edges;

/* Vertices are the same where numbers are. False when memory is short. */
bool edges_make(Edges *edges, const Triangles *triangles);
void edges_free(Edges *edges); /* a zeroed one is allowed */

/* Whether a side runs from the vertex of the lesser number to the vertex of the greater. */
bool side_forward(const Triangles *triangles, uint32_t side);

#endif
