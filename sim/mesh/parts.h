/* The parts of a closed surface: triangles joined by edges, whatever a part touches, cuts or covers. */
#ifndef SLOSH_PARTS_H
#define SLOSH_PARTS_H

#include "sim/mesh/edges.h"

typedef struct Parts {
    uint32_t count;
    uint32_t *of; /* each triangle's part */
} Parts;

/* Where more than two triangles meet at an edge, neighbours in the file of opposite turns belong together.
 * False when memory is short. */
bool parts_make(Parts *parts, const Triangles *triangles, const Edges *edges);
void parts_free(Parts *parts); /* a zeroed one is allowed */

/* Of a surface whose every edge has as many triangles forwards as backwards: turns parts of a negative volume
   outwards, but for cavities, that is such parts inside larger parts. *turned: how many. False when memory is
   short.
 */
bool parts_turn(Triangles *triangles, const Parts *parts, size_t *turned);

/* Takes out triangles with the same corners as earlier triangles: copies, where no edge lacks a triangle
   without the copies; with `walls` also pairs of opposite turns, with the same part of space on both sides.
   *count: how many. False when memory is short. */
bool parts_merge(Triangles *triangles, const Edges *edges, bool walls, size_t *count);

#endif
