/* Who is near whom, from positions alone, so that it serves every backend: a uniform grid over the box,
   filled on the GPU by a counting sort whose order is that of the particles within a cell. Sums over
   neighbours are then the same bits each time.

   The grid of `compute`, which has sorted the same particles, does not serve. It is of the middle of a step,
   and particles have drifted since: two that are near now may stand two cells apart there, and a picture
   would tell whether a run has come to its state or has loaded it. Making this one is 5 % of a picture of
   `splat` (100,000 particles at 1280 x 720 on a software driver, 7.6 of 157 ms).

   Particles beside the box stand in the cells at its sides. Those farther than eight cells from it, or no
   numbers, stand in none: they have no neighbours. */
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
    unsigned cell, rank, order; /* buffers: uint a particle */
    unsigned sorted;            /* uvec4 a particle, by cell: bits of x y z; its number */
    unsigned texels;            /* texture: `sorted` */
    unsigned order_texels;      /* texture: `order`, four at once */
    unsigned start;             /* uint a cell and two more: where it begins in `sorted`; what is in
                                   no cell comes last */
    size_t capacity, cells_capacity;
    unsigned size[3]; /* cells along each axis */
    unsigned count;   /* particles */
    float corner[3];  /* the least of the grid, m */
    float scale;      /* cells a metre */
} Neighbourhood;

/* False when a shader does not compile; neighbourhood_destroy is needed in either case. */
bool neighbourhood_create(Neighbourhood *neighbourhood, Error *error);
void neighbourhood_destroy(Neighbourhood *neighbourhood);

/* The grid of that state, in cells of at least its support radius. */
void neighbourhood_build(Neighbourhood *neighbourhood, const ParticleBuffers *particles);

/* Runs a program of shaders/common/neighbourhood.glsl, one invocation a particle in the order of `sorted`,
   and lets shaders read what it wrote. */
void neighbourhood_run(const Neighbourhood *neighbourhood, unsigned program);

/* The same with so many invocations, which are something else than particles. */
void neighbourhood_run_for(const Neighbourhood *neighbourhood, unsigned program, size_t invocations);

#endif
