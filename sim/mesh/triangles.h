/* A closed surface of triangles that came from somewhere else: what is wrong with it, and what of that can be
   mended. */
#ifndef SLOSH_TRIANGLES_H
#define SLOSH_TRIANGLES_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { TRIANGLES_MAX = 2000000 }; /* what is ready within some seconds and some hundred MB */

/* Counter-clockwise seen from outside. Whoever made it owns the arrays. */
typedef struct Triangles {
    size_t vertex_count, triangle_count;
    float (*vertex)[3];
    uint32_t (*triangle)[3];
    double largest; /* of the floats in the file, before the move to 0; 0: of no matter */
} Triangles;

void triangles_free(Triangles *triangles); /* a zeroed one is allowed */

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

/* What it encloses, and the area, in the cube and the square of its unit. */
double triangles_volume(const Triangles *triangles);
double triangles_area(const Triangles *triangles);

/* The corners of the least block around it. */
void triangles_bounds(const Triangles *triangles, double low[3], double high[3]);

/* Normal of a triangle, twice the area long; and six times the volume of the cone from the origin. */
void triangle_normal(const Triangles *triangles, size_t t, double normal[3]);
double triangle_volume6(const Triangles *triangles, size_t t);

/* The back becomes the front. */
void triangle_turn(Triangles *triangles, size_t t);

#endif
