/* Values on a grid as a field: volume data, the fluid's field of sim/mesh/field.h. */
#ifndef SLOSH_SURFACE_VOLUME_FIELD_H
#define SLOSH_SURFACE_VOLUME_FIELD_H

#include "sim/base/error.h"
#include "sim/mesh/field.h"
#include "sim/surface/level_field.h"

/* Belongs to the caller, with its values, and must outlive the fields that are made of it. */
typedef struct VolumeData {
    int size[3];        /* values, each at least 2 */
    double corner[3];   /* m, the box's frame: of the first value */
    double spacing[3];  /* m: between values */
    const float *value; /* at i + size[0] (j + size[1] k) */
} VolumeData;

/* Of values at the middles of a grid's cells. */
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

/* The field reaches from the first value to the last. False where values are no numbers, with their count and
   the first place, or the grid makes no sense. */
bool level_volume(const VolumeData *volume, VolumeInterpolation interpolation, LevelField *field,
                  Error *error);

#endif
