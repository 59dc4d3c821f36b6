/* The layers of a fluid, from its field: surfaces by marching cubes, planes, and cells with fluid. */
#ifndef SLOSH_FLUID_LAYERS_H
#define SLOSH_FLUID_LAYERS_H

#include "render/pbsr/fluid_field.h"
#include "render/pbsr/layer.h"
#include "render/pbsr/pbsr_def.h"

/* Zero-initialise. */
typedef struct FluidLayers {
    FluidField fluid;
    const float *color; /* the mean in `fluid` that gives colours; NULL: not needed */
    int count;
    Layer layers[PBSR_LAYERS_MAX];
} FluidLayers;

/* `color`: the scalar of the colours, SCALAR_FLUID: the fluid's number. `flat`: depth of the box in a
   two-dimensional scene, m; else 0. With `flat`, a layer is the region at or above the level, as deep as
   the box. Returns false if memory is short: then there are no layers. */
bool fluid_layers_make(FluidLayers *layers, const PbsrDef *def, const ParticleBuffers *particles,
                       Scalar color, double flat, Error *error);

/* Interpolates the field or a mean at a position in the box, m. */
float fluid_layers_value(const FluidLayers *layers, const float *values, const double place[3]);

/* The colour's value at a position; NaN if no particle has a number. Returns false if there is no fluid,
   or no layer needs the value. */
bool fluid_layers_color(const FluidLayers *layers, const double place[3], float *value);

void fluid_layers_free(FluidLayers *layers); /* a zeroed struct is allowed */

#endif
