/* Connected parts of a closed surface: triangles joined by edges. Parts may touch, cut or cover each
   other. */
#ifndef SLOSH_PARTS_H
#define SLOSH_PARTS_H

#include "sim/base/stop.h"
#include "sim/mesh/edges.h"

typedef struct Parts {
    uint32_t count;
    uint32_t *of; /* each triangle's part */
} Parts;

/* Finds the parts; free with parts_free. Where more than two triangles meet at an edge, neighbours in file
   order with opposite directions belong together. Returns false if memory is short. */
bool parts_make(Parts *parts, const Triangles *triangles, const Edges *edges);
void parts_free(Parts *parts); /* zeroed parts are allowed */

/* Turns parts of negative volume outwards, except cavities: parts of negative volume inside larger parts.
   Every edge must have as many triangles forwards as backwards. *turned: number of parts turned. Returns
   false if memory is short, or stopped. */
bool parts_turn(Triangles *triangles, const Parts *parts, const Stop *stop, size_t *turned);

/* Removes triangles with the same corners as earlier triangles: copies, unless edges would lack triangles
   without the copies. `walls`: also removes pairs of opposite directions, with the same part of space on both
   sides. *count: number of triangles removed. Returns false if memory is short. */
bool parts_merge(Triangles *triangles, const Edges *edges, bool walls, size_t *count);

#endif
