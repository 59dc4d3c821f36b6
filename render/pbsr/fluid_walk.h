/* Surfaces of the fluid by the walk on the particles' own field, or between the values of the grid
   (sim/surface/near_walk.h), near the triangles that the grid has. Points are made for some sets at a time,
   as they are drawn, of what a look sees; so many of them are made as a picture's time allows, and none is
   kept. On the CPU, in three dimensions. */
#ifndef SLOSH_FLUID_WALK_H
#define SLOSH_FLUID_WALK_H

#include "render/pbsr/fluid_layers.h"
#include "render/pbsr/still_layers.h"
#include "sim/surface/sph_field.h"

enum { FLUID_WALK_SETS = 8 }; /* at a time, at most: for their memory */

/* Zero-initialise it. */
typedef struct FluidWalk {
    bool walks;       /* points of these are drawn, and not of the layer's triangles */
    bool made;        /* of the present state: */
    SphField *sph;    /* particles with the layer's scalar; NULL: the walk is by the */
    VolumeData grid;  /* values of the fluid's layers */
    StillLayer still; /* the points of the last sets */
    Polygons near;    /* triangles of the last look */
    const char *why;  /* static: why it is triangles though a walk was asked for; NULL: it is as asked */
} FluidWalk;

/* Whether a walk is asked for. */
bool fluid_walk_said(const PbsrLayer *said);

/* Whether it is one between the values of the fluid's grid, and not on the particles' sum. */
bool fluid_walk_by_grid(const PbsrLayer *said);

/* Readies the layer that has been made anew. `flat` as fluid_layers_make. */
void fluid_walk_begin(FluidWalk *walk, const PbsrLayer *said, FluidLayers *layers,
                      const ParticleBuffers *particles, double flat, bool by_gpu);

/* What a look sees, which layer_share has filled in. */
void fluid_walk_see(FluidWalk *walk, const PbsrLayer *said, const Layer *layer, const SetSight *sight);

/* Points of the sets from `first` on. Where that fails the layer is of triangles, and `why` says so. */
void fluid_walk_sets(FluidWalk *walk, const PbsrLayer *said, const FluidLayers *layers, unsigned number,
                     int seed, int first, int count);

void fluid_walk_free(FluidWalk *walk); /* a zeroed one is allowed */

#endif
