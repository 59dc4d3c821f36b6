/* The edges of a triangle surface, and the triangles at each edge. */
#ifndef SLOSH_MESH_EDGES_H
#define SLOSH_MESH_EDGES_H

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

#endif
