/* The parts of a closed surface: what its edges join, whatever else it touches, cuts or covers. */
#ifndef SLOSH_PARTS_H
#define SLOSH_PARTS_H

#include "sim/mesh/edges.h"

typedef struct Parts {
    uint32_t count;
    uint32_t *of; /* each triangle's part */
} Parts;

/* Where more than two triangles meet at an edge, those that follow each other in the file and turn against
   each other belong together. False when memory is short. */
bool parts_make(Parts *parts, const Triangles *triangles, const Edges *edges);
void parts_free(Parts *parts); /* a zeroed one is allowed */

/* Of a surface whose every edge has as many triangles one way as the other: turns parts outwards that enclose
   less than nothing, but for those that lie inside others, whose cavities they are. *turned: how many. False
   when memory is short. */
bool parts_turn(Triangles *triangles, const Parts *parts, size_t *turned);

/* Takes out triangles that have the same corners as others: copies, where no edge lacks a triangle without
   them; with `walls` also pairs that turn against each other, which have the same on both sides. *count: how
   many. False when memory is short. */
bool parts_merge(Triangles *triangles, const Edges *edges, bool walls, size_t *count);

#endif
