/* The passes of pbf, its columns and constants.

   All particles of all fluids have the volume V0 = 1 / n0 at rest, so what is held is the number density n,
   that of images in the walls and of boundary particles counted. With grad W_ij = -F x_ij, x_ij = x_i - x_j,
   an iteration moves
     x_i by sum (dk_i + dk_j) F x_ij / m_i            dk: what a multiplier k grows by, p V0^2 dt^2
     k_i by (n_i - n0) / D_i, and never below 0       so that nothing pulls; less what later steps take away
     D_i = |sum F x_ij|^2 / m_i + sum F^2 r^2 / m_j   what dk_i makes of its own n
   The whole way of a particle, over dt, is what the velocity takes of it. */
#ifndef SLOSH_PBF_PASSES_H
#define SLOSH_PBF_PASSES_H

#include "shaders/sim/pbf/pbf_block.h"
#include "sim/cpu/pass.h"
#include "sim/incompressible/constants.h"

/* Where its columns stand among a particle's own. */
enum {
    TERM,         /* k / dt^2, Pa: what is left of it is where the next step begins */
    BEFORE,       /* n / n0 when the step begins; 0: not known yet */
    FACTOR,       /* 1 / D, kg/m */
    SQUARES,      /* sum F^2 r^2 / m_j, m/kg */
    INVERSE_MASS, /* m3/kg; 0 of the particles of solids */
    COMPRESSED,   /* n / n0 - 1 */
    RESIDUAL,     /* what of that the step is to take away */
    MISS,         /* the same: of what k holds, on either side; else what is above 0 */
    CHANGE,       /* of TERM in the iteration before, Pa */
    APPLIED,      /* what of TERM the places have followed, Pa */
    WAY,          /* length of the way since the lists were made, in spacings */
    MOVED,        /* the way since the step's free flight, m: 3 */
};

extern const ColumnDef pbf_columns[];
extern const ColumnDef *const pbf_miss, *const pbf_compressed, *const pbf_way;

/* What a def means in numbers for pbf alone: of the passes, which shaders have too, and of the solver. */
typedef struct PbfConstants {
    PbfBlock sums;
    int most; /* iterations */
    double tolerance;
} PbfConstants;

static inline const PbfConstants *pbf_solver(const Constants *constants)
{
    return (const PbfConstants *)(const void *)constants->of_method;
}

static inline const PbfBlock *pbf_constants(const Constants *constants)
{
    return &pbf_solver(constants)->sums;
}

/* What gravity does to a free flight. */
extern const Pass pbf_predict;

/* Behind it: multipliers to begin with. */
extern const Pass pbf_begin;

/* Behind another grid in the same step: all goes on. */
extern const Pass pbf_again;

/* An iteration: places by what multipliers grow; the number density there. */
extern const Pass pbf_move, pbf_density;

/* Accelerations of the whole step. */
extern const Pass pbf_force;

/* Number density and pressure of a state that was read. */
extern const Pass pbf_settle;

#endif
