/* The fluid's field on a grid, summed on the CPU: F(r) = sum_j V_j W_poly6(|r - r_j|, h), after Müller,
   Charypar, Gross 2003, eq. 20. F is about 1 inside a fluid, 0.5 at its surface, and 0 farther than h from
   any particle. */
#ifndef SLOSH_FIELD_H
#define SLOSH_FIELD_H

#include "sim/base/bins.h"
#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Cubic cells; the value i, j, k belongs to corner + cell (i + 1/2, j + 1/2, k + 1/2) and stands at
   i + size[0] (j + size[1] k). */
typedef struct VolumeGrid {
    int size[3];      /* cells, each at least 1 */
    double corner[3]; /* m: of the first cell */
    double cell;      /* m */
} VolumeGrid;

size_t volume_grid_cells(const VolumeGrid *grid);

/* What is summed. A particle whose position, volume or scalar is not finite is left out. */
typedef struct FieldParticles {
    size_t count;
    const float *position; /* 4 a particle: x y z (m), volume (m3) */
    const float *scalar;   /* 1 a particle, or NULL */
    double support;        /* h, m */
} FieldParticles;

/* The least and the greatest coordinates of the particles that are not left out; false when there is none. */
bool field_bounds(const FieldParticles *particles, double low[3], double high[3]);

/* Which particles reach into which slab of the grid, kept from sum to sum so that each needs no new memory.
   Zero-initialise it. */
typedef struct FieldSlabs {
    Bins bins;
} FieldSlabs;

void field_slabs_free(FieldSlabs *slabs); /* a zeroed one is allowed */

/* Sets each of the grid's values: field to sum V W, `weighted` to sum V W scalar; either may be NULL.
   Slabs of the grid are summed in parallel, each value in the particles' order: the same bits for any number
   of threads. A weight is rounded to float before it is added. False when memory is short: then the values
   are not set. */
bool field_sum(const FieldParticles *particles, const VolumeGrid *grid, int threads, FieldSlabs *slabs,
               float *field, float *weighted, Error *error);

/* The same at one point, r (m), in double over all particles: what to measure others against. `weighted` may
   be NULL. */
double field_at(const FieldParticles *particles, const double r[3], double *weighted);

#endif
