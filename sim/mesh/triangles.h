/* A surface of triangles as plain arrays, with volume, area and bounds. */
#ifndef SIM_MESH_TRIANGLES_H
#define SIM_MESH_TRIANGLES_H

#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { TRIANGLES_MAX = 2000000 }; /* can be processed within some seconds and some hundred MB */

/* Triangles turn counter-clockwise seen from outside. The creator owns the arrays. */
typedef struct Triangles {
    size_t vertex_count, triangle_count;
    float (*vertex)[3];
    uint32_t (*triangle)[3];
    double largest; /* largest float in the file, before the move to 0; 0: irrelevant */
} Triangles;

void triangles_free(Triangles *triangles); /* zeroed triangles are allowed */

/* Enclosed volume and area, in the cube and the square of the mesh's unit. */
double triangles_volume(const Triangles *triangles);
double triangles_area(const Triangles *triangles);

/* Corners of the bounding box. */
void triangles_bounds(const Triangles *triangles, double low[3], double high[3]);

/* Normal of a triangle, twice the area long; and six times the signed volume of the tetrahedron with the
   origin. */
void triangle_normal(const Triangles *triangles, size_t t, double normal[3]);
double triangle_volume6(const Triangles *triangles, size_t t);

/* Reverses the triangle's direction: the back becomes the front. */
void triangle_turn(Triangles *triangles, size_t t);

/* Intersections of lines along x with triangles. A line enters a closed surface as often as it leaves. */

/* Intersects triangle t with the line along x through p. Returns 1 where the line leaves the solid (*x: the
   position), -1 where the line enters, 0 without an intersection (*x unchanged). A line through an edge
   counts as moved slightly aside, so that each crossing counts once. */
int triangle_crossing(const Triangles *of, size_t t, const double p[3], double *x);

/* The range along y of triangle t between z - `margin` and z + `margin`, and `margin` more. Lines along x
   elsewhere at this z do not cross the triangle. Empty (low above high) if the triangle is not there. */
void triangle_slice(const Triangles *of, size_t t, double z, double margin, double *low, double *high);

#endif
