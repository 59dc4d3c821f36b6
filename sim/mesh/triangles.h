/* A surface of triangles: plain arrays, and what they measure. */
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
