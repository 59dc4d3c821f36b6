/* Values on a grid as a field: volume data, or the fluid's field of sim/mesh/field.h. */
#ifndef SLOSH_SURFACE_VOLUME_FIELD_H
#define SLOSH_SURFACE_VOLUME_FIELD_H

#include "sim/base/error.h"
#include "sim/mesh/field.h"
#include "sim/surface/level_field.h"

/* Owned by the caller, with its values; must outlive all fields made of it. */
typedef struct VolumeData {
    int size[3];        /* values, each at least 2 */
    double corner[3];   /* m, the box's frame: position of the first value */
    double spacing[3];  /* m: between values */
    const float *value; /* at i + size[0] (j + size[1] k) */
} VolumeData;

/* Volume data of values at cell centres of a grid. */
VolumeData volume_of_grid(const VolumeGrid *grid, const float *value);

typedef enum VolumeInterpolation {
    VOLUME_TRILINEAR,   /* continuous, with edges between cells */
    VOLUME_CATMULL_ROM, /* once differentiable, through the values. After: E. Catmull, R. Rom, "A class of
                           local interpolating splines", 1974; the outermost values count twice at the border
                         */
    VOLUME_INTERPOLATIONS
} VolumeInterpolation;

/* "trilinear", "catmull_rom"; NULL past the last. */
const char *volume_interpolation_name(VolumeInterpolation interpolation);

/* Makes a field from the first value to the last. Returns false if values are not finite, with their count
   and first position, or if the grid is invalid. */
bool level_volume(const VolumeData *volume, VolumeInterpolation interpolation, LevelField *field,
                  Error *error);

#endif
