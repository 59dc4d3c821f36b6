/* Columns of wcsph alone: indices in ParticleColumns.own. */
#ifndef SLOSH_WCSPH_COLUMNS_H
#define SLOSH_WCSPH_COLUMNS_H

#include "sim/world/column.h"

enum {
    ARTIFICIAL, /* viscosity of the particle's fluid, Pa s */
    RELATIVE,   /* copy of the compression for diffusion: the pass of continuity changes the neighbours'
                   column meanwhile */
    SLOPE,      /* gradient of RELATIVE, 1/m */
    UNEVEN = SLOPE + 3,         /* direction of shifting: sum of F x_ij, 1/m; with corrected gradients plus
                                   the sum of (S_i + S_j) / 2 F x_ij, sim/wcsph/pairs_corrected.c */
    FULL = UNEVEN + 3,          /* sum of F r^2; then 0 to 1, rising with the distance from a surface */
    DENSE,                      /* sum of W; then n / n0 - 1 */
    OUTWARD,                    /* normal of a surface, times the particle's weight in the surface */
    RATE = OUTWARD + 3,         /* rate of the compression, 1/s, at the end of the last step */
    CORRECTION,                 /* C of sim/wcsph/corrected.c: xx, yy, zz, and xy, yz, zx */
    CARRIED = CORRECTION + 6,   /* (uneven . grad) v of sim/wcsph/carry.c, 1/(m s) */
    REST_DENSITY = CARRIED + 3, /* of the particle's fluid, kg/m3 */
    PULL = REST_DENSITY + 1,    /* force of surface tension by curvature, as ParticleColumns.ax */
    DROP = PULL + 3,            /* sim/wcsph/drops.h, in integers: way to the root of the particle's body; */
    DROP_SUM = DROP + 1,        /* of roots: sum of PULL over the body; */
    DROP_TALLY = DROP_SUM + 3,  /* of roots: number of particles, and axes with a wall */
};

extern const ColumnDef wcsph_columns[];

#endif
