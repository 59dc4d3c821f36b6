/* The columns that wcsph alone has: where they stand among a particle's own. */
#ifndef SLOSH_WCSPH_COLUMNS_H
#define SLOSH_WCSPH_COLUMNS_H

#include "sim/world/column.h"

enum {
    ARTIFICIAL, /* viscosity of the particle's fluid, Pa s */
    RELATIVE,   /* copy of the compression, for diffusion: the pass of continuity changes the column of
                   neighbours meanwhile */
    SLOPE,      /* its gradient, 1/m */
    UNEVEN = SLOPE + 3,         /* what shifting goes by: sum of F x_ij, 1/m; with corrected gradients that of
                                   (S_i + S_j) / 2 F x_ij more, sim/wcsph/pairs_corrected.c */
    FULL = UNEVEN + 3,          /* of F r^2; then 0 to 1, how far from a surface */
    DENSE,                      /* of W; then n / n0 - 1 */
    OUTWARD,                    /* the normal of a surface, times the weight of a particle in it */
    RATE = OUTWARD + 3,         /* of the compression, 1/s, at the end of the last step */
    CORRECTION,                 /* C of sim/wcsph/corrected.c: xx, yy, zz, and xy, yz, zx */
    CARRIED = CORRECTION + 6,   /* (uneven . grad) v of sim/wcsph/carry.c, 1/(m s) */
    REST_DENSITY = CARRIED + 3, /* of the particle's fluid, kg/m3 */
};

extern const ColumnDef wcsph_columns[];

#endif
