/* The geometry of a slice: a plane in the box's frame, and the rectangle where the box cuts the plane. */
#ifndef SLOSH_PLANE_H
#define SLOSH_PLANE_H

#include <stdbool.h>

typedef struct Plane {
    double corner[3];                  /* corner of the rectangle, m: lower left, seen against the normal */
    double along[3], up[3], normal[3]; /* orthogonal unit vectors: along x up = normal */
    double size[2];                    /* m, along and up */
} Plane;

/* The plane through `point` (m) perpendicular to `normal`, of any nonzero length, and the smallest
   rectangle around the part inside the box. `up` is as near as possible to the box's y; on a level plane
   to -z. Returns false if the plane misses the box; then the rectangle is empty. */
bool plane_make(const double box_size[3], const double point[3], const double normal[3], Plane *plane);

/* The centre of a sample in a raster of `samples` over the rectangle, rows from the bottom up; m. */
void plane_sample(const Plane *plane, const int samples[2], int column, int row, double at[3]);

#endif
