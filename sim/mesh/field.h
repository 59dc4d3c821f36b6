/* The fluid's field on a grid, summed on the CPU: F(r) = sum_j V_j W_poly6(|r - r_j|, h), after Müller,
   Charypar, Gross 2003, eq. 20. F is about 1 inside a fluid, 0.5 at its surface, and 0 farther than h from
   any particle. */
#ifndef SLOSH_FIELD_H
#define SLOSH_FIELD_H

#include "sim/base/bins.h"
#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Cubic cells. The value i, j, k belongs to corner + cell (i + 1/2, j + 1/2, k + 1/2), at index i + size[0]
   (j + size[1] k). */
typedef struct VolumeGrid {
    int size[3];      /* cells, each at least 1 */
    double corner[3]; /* m: of the first cell */
    double cell;      /* m */
} VolumeGrid;

size_t volume_grid_cells(const VolumeGrid *grid);

/* The particles to sum. A particle whose position, volume or scalar is not finite is left out. */
typedef struct FieldParticles {
    size_t count;
    const float *position; /* 4 a particle: x y z (m), volume (m3) */
    const float *scalar;   /* 1 a particle, or NULL */
    double support;        /* h, m */
} FieldParticles;

/* Least and greatest coordinates of the particles not left out, m. Returns false if no particle remains. */
bool field_bounds(const FieldParticles *particles, double low[3], double high[3]);

/* Lists of the particles within reach of each slab of the grid; kept between sums to reuse the memory.
   Zero-initialise. */
typedef struct FieldSlabs {
    Bins bins;
} FieldSlabs;

void field_slabs_free(FieldSlabs *slabs); /* zeroed slabs are allowed */

/* Sets each grid value: `field` to sum V W, `weighted` to sum V W scalar; either array may be NULL. Slabs of
   the grid are summed in parallel, each value in particle order: the same bits for any number of threads.
   Weights are rounded to float before the sum. Returns false if memory is short: the values are then not
   set. */
bool field_sum(const FieldParticles *particles, const VolumeGrid *grid, int threads, FieldSlabs *slabs,
               float *field, float *weighted, Error *error);

/* The field at point r (m), summed in double over all particles: a reference to check other sums. `weighted`
   may be NULL. */
double field_at(const FieldParticles *particles, const double r[3], double *weighted);

#endif
