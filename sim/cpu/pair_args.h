/* What the sums over neighbours read and write: the loops where the time goes. */
#ifndef SLOSH_PAIR_ARGS_H
#define SLOSH_PAIR_ARGS_H

#include "sim/box/box_step.h"
#include "sim/world/cell_rows.h"
#include "sim/world/column.h"

enum { LANES = 8 }; /* see sim/cpu/simd.h */

/* Arrays of particles sorted by cell; readable for LANES - 1 entries past the last. */
typedef struct PairArgs {
    const Constants *constants;
    const uint32_t *cell_start; /* first particle of each cell; cells + 1 */
    const uint32_t *cell;       /* of each particle */
    const uint32_t *id;
    const uint8_t *fluid;
    const float *x, *y, *z, *vx, *vy, *vz; /* m, m/s */
    const float *volume;                   /* m3: set before forces */
    const float *pressure_term;            /* p V^2, J m3: set before forces */
    const float *viscosity;                /* Pa s, of each particle; NULL with one fluid */
    const float *kind;                     /* the fluid of each as a number; NULL where none asks */
    const float *tension;           /* sigma of each, N/m (cohesion: scaled); NULL: none; with `kind` */
    const ApparentGravity *gravity; /* of passes that have it */
    float *fx, *fy, *fz;            /* out of forces, N; `fx` also of rates */
    float *number_density;          /* out of densities, 1/m3: in the place of `volume` */
    float *own[COLUMNS_OWN];        /* of the method */
} PairArgs;

/* The particles [begin, end) that stand in the three cells of one row next to `cell`; row 0..8. Not in a box
   with periodic sides. */
static inline void pair_row(const PairArgs *args, uint32_t cell, int row, uint32_t *begin, uint32_t *end)
{
    const int *size = args->constants->cells.size;
    const long middle = (long)cell + ((long)(row / 3 - 1) * size[1] + (row % 3 - 1)) * size[0];
    *begin = args->cell_start[middle - 1];
    *end = args->cell_start[middle + 2];
}

#endif
