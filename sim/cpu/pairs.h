/* The sums over neighbours: the loops where the time goes. pairs.c is compiled once for each instruction set;
   the table that fits the processor is chosen when a world is made. All of them give the same bits. */
#ifndef SLOSH_PAIRS_H
#define SLOSH_PAIRS_H

#include "sim/box/frame_step.h"
#include "sim/world/cell_rows.h"

enum { LANES = 8 }; /* see sim/cpu/simd.h */

/* Arrays of particles sorted by cell; readable for LANES - 1 entries past the last. */
typedef struct PairArgs {
    const Constants *constants;
    const uint32_t *cell_start; /* first particle of each cell; cells + 1 */
    const uint32_t *cell;       /* of each particle */
    const uint32_t *id;
    const uint8_t *fluid;
    const float *x, *y, *z, *vx, *vy, *vz; /* m, m/s */
    const float *volume;                   /* m3: set before `force` */
    const float *pressure_term;            /* p V^2, J m3: set before `force` */
    const float *viscosity;                /* Pa s, of each particle; NULL with one fluid */
    const float *artificial;        /* Pa s, of each particle; NULL: none; wcsph's, like the next three */
    const float *relative;          /* rho / rho0 - 1 of each; NULL: no diffusion */
    const float *kind;              /* the fluid of each as a number; with `relative` */
    const float *tension;           /* sigma of each, N/m (cohesion: scaled); NULL: none; with `kind` */
    const ApparentGravity *gravity; /* for `images_force` */
    float *slope[3];                /* out of `wcsph_slope`: gradient of `relative`, 1/m; NULL without it */
    float *rate;                    /* out of `wcsph_rate`: of the number density, 1/(m3 s), no walls */
    float *number_density;          /* out of `density`, 1/m3: all pairs, self included, no walls */
    float *fx, *fy, *fz;            /* out of `force`, N */
    float *uneven[3];    /* out of `wcsph_force` with shifting: sum of F x_ij, 1/m4; NULL without it */
    float *full, *dense; /* of F r^2 and of W, 1/m3 */
} PairArgs;

typedef struct PairOps {
    const char *name; /* of the instruction set */
    void (*density)(const PairArgs *args, size_t begin, size_t end);
    void (*force)(const PairArgs *args, size_t begin, size_t end);
    void (*tension)(const PairArgs *args, size_t begin, size_t end); /* adds to fx, fy, fz */
    void (*wcsph_slope)(const PairArgs *args, size_t begin, size_t end);
    void (*wcsph_rate)(const PairArgs *args, size_t begin, size_t end);
    void (*wcsph_force)(const PairArgs *args, size_t begin, size_t end);
    void (*images_rate)(const PairArgs *args, size_t begin,
                        size_t end); /* these two add to what those gave */
    void (*images_force)(const PairArgs *args, size_t begin, size_t end);
} PairOps;

/* The widest that this processor has, or the one that the environment variable SLOSH_SIMD names, if it can;
   those of a box with periodic sides have loops of their own. */
const PairOps *pair_ops_choose(bool periodic);

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
