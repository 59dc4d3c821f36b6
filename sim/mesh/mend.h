/* A closed surface of triangles that came from somewhere else: what is wrong with it, and what of that can be
   mended. */
#ifndef SLOSH_MEND_H
#define SLOSH_MEND_H

#include "sim/mesh/triangles.h"

/* What triangles_mend found. */
typedef struct TrianglesState {
    size_t open;     /* edges that a triangle lacks at */
    size_t crowded;  /* edges with a triangle too many, as three */
    size_t opposed;  /* edges whose triangles turn opposite ways */
    size_t flat;     /* triangles without area; those whose corners coincide were taken out */
    size_t doubled;  /* copies of triangles, and walls between parts: taken out */
    size_t turned;   /* parts inside out beside the whole, and turned */
    bool inside_out; /* it enclosed less than nothing, and was turned */
    double gap;      /* of an open surface: the width, of the length, at which joined vertices close the
                        surface; 0: no width up to a thousandth does */
} TrianglesState;

/* Vertices that share a place, to a millionth of the whole, become one; those of no triangle go; the whole is
   turned so that it encloses a volume above 0, and then each closed part, but for cavities; copies of
   triangles and walls between parts go; the middle of the block around the whole moves to 0: `middle` says
   from where. False when there is nothing left, a number is not finite, or memory is short; open, crowded and
   opposed edges are for the caller to refuse. */
bool triangles_mend(Triangles *triangles, double middle[3], TrianglesState *state, Error *error);

#endif
