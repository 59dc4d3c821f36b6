/* Points on the fluid's surfaces by a random walk on the particles' own field, or on the interpolated grid
   (sim/surface/near_walk.h), near the grid's triangles. Points are made for some sets at a time while
   drawing, for the visible triangles only; as many as a picture's time allows, and none are kept. On the
   CPU, in three dimensions. */
#ifndef SLOSH_FLUID_WALK_H
#define SLOSH_FLUID_WALK_H

#include "render/pbsr/fluid_layers.h"
#include "render/pbsr/still_layers.h"
#include "sim/surface/sph_field.h"

enum { FLUID_WALK_SETS = 8 }; /* most sets at a time, to limit memory */

/* Zero-initialise. */
typedef struct FluidWalk {
    bool walks;       /* true: the walk's points are drawn instead of the layer's triangles */
    bool made;        /* the inputs below are of the present state */
    SphField *sph;    /* particles with the layer's scalar; NULL: the walk uses `grid` */
    VolumeData grid;  /* values of the fluid's layers */
    StillLayer still; /* points of the last sets */
    Polygons near;    /* triangles visible in the last look */
    const char *why;  /* static: reason for triangles although a walk was asked for; NULL: none */
} FluidWalk;

/* True if the layer asks for a walk. */
bool fluid_walk_said(const PbsrLayer *said);

/* True if the walk uses the fluid's grid, not the sum over particles. */
bool fluid_walk_by_grid(const PbsrLayer *said);

/* Prepares the walk after the layer was made again. `flat`: as in fluid_layers_make. */
void fluid_walk_begin(FluidWalk *walk, const PbsrLayer *said, FluidLayers *layers,
                      const ParticleBuffers *particles, double flat, bool by_gpu);

/* Takes the visible triangles, from the shares that layer_share has filled in. */
void fluid_walk_see(FluidWalk *walk, const PbsrLayer *said, const Layer *layer, const SetSight *sight);

/* Makes the points of `count` sets from `first` on. On failure the layer uses triangles, and `why` gives
   the reason. */
void fluid_walk_sets(FluidWalk *walk, const PbsrLayer *said, const FluidLayers *layers, unsigned number,
                     int seed, int first, int count);

void fluid_walk_free(FluidWalk *walk); /* a zeroed struct is allowed */

#endif
