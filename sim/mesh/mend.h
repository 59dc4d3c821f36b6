/* Vertices at the same place become a single vertex. */
#ifndef SIM_MESH_MEND_H
#define SIM_MESH_MEND_H

#include "sim/base/stop.h"
#include "sim/mesh/distance.h"
#include "sim/mesh/triangles.h"

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

#endif
