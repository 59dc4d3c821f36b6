/* Where a slice lies: a plane in the box's frame, and the rectangle on it that the box cuts out. */
#ifndef SLOSH_PLANE_H
#define SLOSH_PLANE_H

#include <stdbool.h>

typedef struct Plane {
    double corner[3]; /* of the rectangle, m: lower left where one looks against the normal */
    double along[3], up[3], normal[3]; /* unit vectors, at right angles: along x up = normal */
    double size[2];                    /* m, along and up */
} Plane;

/* The plane through `point` (m) across `normal`, of any length but 0, and the least rectangle on it around
   what is in the box of that size. `up` is as near to the box's y as may be, on a level plane to -z. False
   where the plane misses the box; then the rectangle is empty. */
bool plane_make(const double box_size[3], const double point[3], const double normal[3], Plane *plane);

/* The centre of a sample of a raster of that many over the rectangle, rows from the bottom up; m. */
void plane_sample(const Plane *plane, const int samples[2], int column, int row, double at[3]);

#endif
