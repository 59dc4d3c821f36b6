/* The passes of dfsph, its columns and constants.

   All particles of all fluids have the volume V0 = 1 / n0 at rest, so what is held is the number density n,
   that of images in the walls and of boundary particles counted. With grad W_ij = -F x_ij, x_ij = x_i - x_j:
     force_i = sum (k_i + k_j) F x_ij                 k: a multiplier each, p V0^2
     dn_i / dt = -sum F v_ij . x_ij                   its adjoint: pressure does no work where n stays
     D_i = |sum F x_ij|^2 / m_i + sum F^2 r^2 / m_j   what k_i makes of its own rate
   Masses are in D alone: ratios of density are no matter of the sums.
   A boundary particle has k_i for whom it pushes, and the velocity of its solid, mirrored: 2 v_b - v_i. So it
   counts twice in force, rate and D; what moves places goes by n as it is, where it counts once.
   With k_i on both sides no boundary particle pushes i along its solid, and i has only what fluid has of the
   gradient of pressure there; so that part of its acceleration is taken 1 / (1 - s) times, where s is
   SOLID_SHARE. */
#ifndef SLOSH_DFSPH_PASSES_H
#define SLOSH_DFSPH_PASSES_H

#include "shaders/sim/dfsph/dfsph_block.h"
#include "sim/cpu/pass.h"
#include "sim/incompressible/constants.h"

#define DFSPH_KERNEL INCOMPRESSIBLE_KERNEL

/* Where its columns stand among a particle's own; k of the solver at work is `pressure_term`. */
enum {
    KEPT,         /* k that the last step's divergence left, Pa: where the next begins */
    FACTOR,       /* 1 / D, kg/m; 0 where a particle sees none */
    SQUARES,      /* sum F^2 r^2 / m_j, m/kg */
    INVERSE_MASS, /* m3/kg; 0 of the particles of solids */
    RESIDUAL,     /* n / n0 - 1 that the step would end with */
    MISS,         /* how far that is from where it is to be: of what k holds, on either side; else above 0 */
    CHANGE,       /* of k in the iteration before, Pa */
    OTHER,        /* accelerations but those of the solver at work, m/s2: 3 */
    SOLID_SLOPE = OTHER + 3,      /* sum F x_ib over boundary particles b, 1/m: 3 */
    SOLID_FLOW = SOLID_SLOPE + 3, /* sum F v_b . x_ib over them, 1/s */
    SOLID_SHARE,                  /* their part of sum F y^2 along the solid, of a whole lattice's */
    BASE, /* velocities in the middle of the next step by all but the solver at work, m/s: 3 */
};

extern const ColumnDef dfsph_columns[];
extern const ColumnDef *const dfsph_miss;

/* What a def means in numbers for dfsph alone: of the pair sums, which shaders have too, and of the solvers.
 */
typedef struct DfsphConstants {
    DfsphBlock sums;
    int most; /* iterations */
    double tolerance, divergence_tolerance;
} DfsphConstants;

static inline const DfsphConstants *dfsph_solvers(const Constants *constants)
{
    return (const DfsphConstants *)(const void *)constants->of_method;
}

static inline const DfsphBlock *dfsph_constants(const Constants *constants)
{
    return &dfsph_solvers(constants)->sums;
}

/* What follows from places alone: n, volume, D; what pair sums need of each. */
extern const Pass dfsph_state;

/* Accelerations but those of pressure. */
extern const Pass dfsph_others;

/* Around terms that the step ends with (sim/world/method.h): to accelerations by the last step's pressure
   those but pressure are added; what the terms have made of all, less that pressure, is what is not pressure.
 */
extern const Pass dfsph_pressed, dfsph_unpressed;

/* k and residual that a solver begins with; what it keeps of them. */
extern const Pass dfsph_divergence_begin, dfsph_density_begin, dfsph_divergence_end, dfsph_density_end;

/* An iteration: k by the residual before, accelerations by k; the residual by accelerations. */
extern const Pass dfsph_divergence_push, dfsph_divergence_rate, dfsph_density_push, dfsph_density_rate;

#endif
