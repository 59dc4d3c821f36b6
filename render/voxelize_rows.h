/* The inner loop of voxelization on the CPU: balls, added row by row. */
#ifndef SLOSH_VOXELIZE_ROWS_H
#define SLOSH_VOXELIZE_ROWS_H

#include <stddef.h>

enum { ROW_LANES = 8 };

/* A particle; what it adds at its centre is scale^3. */
typedef struct Ball {
    float at[3]; /* cells */
    float scale;
    float scalar;
} Ball;

typedef struct VolumeRows {
    float *field, *scalar; /* the latter NULL where none is carried */
    int size[3];           /* cells */
    size_t stride;         /* of a row, floats; at least ROW_LANES - 1 more than size[0] */
    float radius;          /* of the balls, cells */
} VolumeRows;

/* Adds (scale (1 - r^2 / radius^2))^3 for each ball, in their order, to the slices low .. end - 1. The bits
   do not depend on the slices asked for, nor on the processor. */
void volume_rows_add(const VolumeRows *rows, const Ball *balls, size_t count, int low, int end);

#endif
