/* The layers of a fluid, in its field: surfaces by marching cubes, planes, the cells that have fluid. */
#ifndef SLOSH_FLUID_LAYERS_H
#define SLOSH_FLUID_LAYERS_H

#include "render/pbsr/fluid_field.h"
#include "render/pbsr/layer.h"
#include "render/pbsr/pbsr_def.h"

/* Zero-initialise it. */
typedef struct FluidLayers {
    FluidField fluid;
    const float *color; /* the mean in it that colours go by; NULL: no layer needs it */
    int count;
    Layer layers[PBSR_LAYERS_MAX];
} FluidLayers;

/* `color`: the scalar that colours go by, SCALAR_FLUID: the number of the fluid. `flat`: the depth of the box
   of a scene of two dimensions, m; else 0. There a layer is what is at least at the level, as deep as the
   box. False when memory is short: then there are no layers. */
bool fluid_layers_make(FluidLayers *layers, const PbsrDef *def, const ParticleBuffers *particles,
                       Scalar color, double flat, Error *error);

/* Between the values of the field or of a mean, at a place in the box, m. */
float fluid_layers_value(const FluidLayers *layers, const float *values, const double place[3]);

/* What colours go by there, no number where no particle has one; false where there is no fluid, or no layer
   needs it. */
bool fluid_layers_color(const FluidLayers *layers, const double place[3], float *value);

void fluid_layers_free(FluidLayers *layers); /* a zeroed one is allowed */

#endif
