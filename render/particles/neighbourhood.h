/* Neighbour search from positions alone, for every backend: a uniform grid over the box. The GPU fills the
   grid by a counting sort; particles of a cell keep the order of their numbers, so sums over neighbours
   are the same bits each time.

   The grid of the backend `compute` sorts the same particles but cannot be used here. The solver builds
   that grid in the middle of a step, and the particles have drifted since. Two near particles may be two
   cells apart there, and pictures of a computed and of a loaded state would differ. A new grid costs 5 %
   of a picture of `splat` (100,000 particles at 1280 x 720 on a software driver, 7.6 of 157 ms).

   Particles beside the box are in the cells at the sides. Particles farther than eight cells from the box,
   or with NaN positions, are in no cell and have no neighbours. */
#ifndef SLOSH_NEIGHBOURHOOD_H
#define SLOSH_NEIGHBOURHOOD_H

#include "render/particles/prefix_sums.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct Neighbourhood {
    unsigned bin, place, sort; /* programs */
    PrefixSums sums;
    unsigned cell, rank, order; /* buffers: one uint per particle */
    unsigned sorted;            /* uvec4 per particle, ordered by cell: bits of x y z; the particle's
                                   number */
    unsigned texels;            /* texture: `sorted` */
    unsigned order_texels;      /* texture: `order`, four per fetch */
    unsigned start;             /* uint per cell and two more: the first index of the cell in `sorted`;
                                   particles in no cell come last */
    size_t capacity, cells_capacity;
    unsigned size[3]; /* cells along each axis */
    unsigned count;   /* particles */
    float corner[3];  /* least corner of the grid, m */
    float scale;      /* cells per metre */
} Neighbourhood;

/* Returns false if a shader does not compile; call neighbourhood_destroy in either case. */
bool neighbourhood_create(Neighbourhood *neighbourhood, Error *error);
void neighbourhood_destroy(Neighbourhood *neighbourhood);

/* Builds the grid of a state. The edge of a cell is at least the support radius. */
void neighbourhood_build(Neighbourhood *neighbourhood, const ParticleBuffers *particles);

/* Runs a program of shaders/common/neighbourhood.glsl with one invocation per particle, in the order of
   `sorted`; then a memory barrier lets shaders read the results. */
void neighbourhood_run(const Neighbourhood *neighbourhood, unsigned program);

/* As neighbourhood_run, with `invocations` that are not one per particle. */
void neighbourhood_run_for(const Neighbourhood *neighbourhood, unsigned program, size_t invocations);

#endif
