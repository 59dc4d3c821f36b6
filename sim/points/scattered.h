/* A surface through scattered points with normals, as values on a grid. */
#ifndef SIM_POINTS_SCATTERED_H
#define SIM_POINTS_SCATTERED_H

#include "sim/points/points.h"

/* The points of a closed surface; normals of any length point outwards. */
typedef struct ScatteredPoints {
    size_t count;
    const float (*place)[3]; /* m */
    const float (*normal)[3];
} ScatteredPoints;

/* Makes values for level_volume: 0.5 on the surface, 1 inside and 0 outside, as the field of a fluid. Holes
   that are wider than three distances between points are closed somewhere in between. The caller frees
   *values. Returns false if there are fewer than three points, a point is not finite or memory is short. */
bool scattered_volume(const ScatteredPoints *points, VolumeData *volume, float **values, Error *error);

#endif
