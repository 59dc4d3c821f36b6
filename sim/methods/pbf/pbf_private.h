/* What the files of pbf share: its constants, columns and passes. */
#ifndef SIM_METHODS_PBF_PBF_PRIVATE_H
#define SIM_METHODS_PBF_PBF_PRIVATE_H

#include "sim/methods/pbf/pbf.h"

#include "shaders/sim/pbf/pbf_block.h"
#include "sim/cpu/cpu.h"
#include "sim/methods/shared/incompressible.h"
#include "sim/step/method.h"

/* The passes of pbf, with columns and constants.

   All particles of all fluids have the volume V0 = 1 / n0 at rest, so the solver holds the number density n,
   including images in the walls and boundary particles. With grad W_ij = -F x_ij, x_ij = x_i - x_j, an
   iteration moves
     x_i by sum (dk_i + dk_j) F x_ij / m_i            dk: growth of a multiplier k, p V0^2 dt^2
     k_i by (n_i - n0) / D_i, and never below 0       without pull; less the part left to later steps
     D_i = |sum F x_ij|^2 / m_i + sum F^2 r^2 / m_j   effect of dk_i on n_i
   The whole way of a particle, over dt, changes the velocity.
   A boundary particle is an image of the particle that it meets: sim/methods/shared/incompressible.h. In n it
   counts once at the step's begin, and mirrors the way over the step: the solver holds n / n0 + MIRRORED,
   which begins with BOUNDARY_PART (incompressible_boundary_fades). */

/* Indices of pbf's columns among a particle's own. */
enum {
    TERM,              /* k / dt^2, Pa: the next step begins with a part of it */
    BEFORE,            /* n / n0 at the step's begin; 0: not known yet */
    FACTOR,            /* 1 / D, kg/m */
    SQUARES,           /* sum F^2 r^2 / m_j, m/kg */
    INVERSE_MASS,      /* m3/kg; 0 for particles of solids */
    COMPRESSED,        /* n / n0 - 1 */
    RESIDUAL,          /* part of COMPRESSED to be removed by the step */
    MISS,              /* error of RESIDUAL: on either side where k holds; else only above 0 */
    CHANGE,            /* of TERM in the iteration before, Pa */
    APPLIED,           /* part of TERM already applied to positions, Pa */
    WAY,               /* length of the way since the lists were made, in spacings */
    MOVED,             /* the way since the step's free flight, m: 3 */
    SOLID = MOVED + 3, /* SolidColumns of sim/methods/shared/incompressible.h */
    SOLID_FLOW = SOLID + SOLID_COLUMNS, /* sum F v_b . x_ib over boundary particles, 1/s */
    MIRRORED,                           /* change of n / n0 by mirrored ways, with BOUNDARY_PART */
    BOUNDARY_PART,                      /* what is left of MIRRORED after the last step */
};

extern const ColumnDef pbf_columns[];
extern const ColumnDef *const pbf_miss, *const pbf_compressed, *const pbf_way;

/* Constants of a def for pbf alone: of the passes, shared with shaders, and of the solver. */
typedef struct PbfConstants {
    PbfBlock sums;
    int most; /* iterations */
    double tolerance;
    IncompressibleFactors factors;
} PbfConstants;

static inline const PbfConstants *pbf_solver(const Constants *constants)
{
    return (const PbfConstants *)(const void *)constants->of_method;
}

static inline const PbfBlock *pbf_constants(const Constants *constants)
{
    return &pbf_solver(constants)->sums;
}

/* Effect of gravity on a free flight. */
extern const Pass pbf_predict;

/* After the flight and the grid: multipliers to begin with. */
extern const Pass pbf_begin;

/* After another grid in the same step: goes on with the same multipliers. */
extern const Pass pbf_again;

/* The first move, by the multipliers to begin with, as if the fluid had not fallen; with the support by
   walls. */
extern const Pass pbf_first;

/* An iteration: positions by the growth of multipliers; the number density there. */
extern const Pass pbf_move, pbf_density;

/* Accelerations of the whole step. */
extern const Pass pbf_force;

/* Number density and pressure of a loaded state. */
extern const Pass pbf_settle;

#endif
