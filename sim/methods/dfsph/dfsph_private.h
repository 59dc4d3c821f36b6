/* What the files of dfsph share: its constants, columns and passes. */
#ifndef SIM_METHODS_DFSPH_DFSPH_PRIVATE_H
#define SIM_METHODS_DFSPH_DFSPH_PRIVATE_H

#include "sim/methods/dfsph/dfsph.h"

#include "shaders/sim/dfsph/dfsph_block.h"
#include "sim/cpu/cpu.h"
#include "sim/methods/shared/incompressible.h"
#include "sim/step/method.h"

/* The passes of dfsph, with columns and constants.

   All particles of all fluids have the volume V0 = 1 / n0 at rest, so the solvers hold the number density n,
   including images in the walls and boundary particles. With grad W_ij = -F x_ij, x_ij = x_i - x_j:
     force_i = sum (k_i + k_j) F x_ij                 k: a multiplier per particle, p V0^2
     dn_i / dt = -sum F v_ij . x_ij                   the adjoint: pressure does no work where n stays
     D_i = |sum F x_ij|^2 / m_i + sum F^2 r^2 / m_j   effect of k_i on the rate of n_i
   Masses are in D alone: ratios of density do not matter in the sums.
   For particle i a boundary particle has k_i (sim/methods/shared/incompressible.h), and the velocity of the
   solid, mirrored: 2 v_b - v_i. So boundary particles count twice in force, rate and D, and once in n. Both
   solvers hold n / n0 + BOUNDARY_PART (incompressible_boundary_fades).
   At a free surface half of the neighbours are missing. Held to n <= n0 alone, the outermost particles would
   crowd into one dense row, a skin that the flow below can not stretch: a dead load that slows waves. So with
   solver.surface_lack the solvers hold n / n0 + LACK: LACK follows from |sum F x_ij|, which is great where
   one side is empty. */

#define DFSPH_KERNEL INCOMPRESSIBLE_KERNEL

/* Indices of dfsph's columns among a particle's own; k of the running solver is `pressure_term`. */
enum {
    KEPT,              /* k after the last step's solver of divergence, Pa: start of the next */
    FACTOR,            /* 1 / D, kg/m; 0 without neighbours */
    SQUARES,           /* sum F^2 r^2 / m_j, m/kg */
    LACK,              /* what a surface lacks of n, over n0 */
    INVERSE_MASS,      /* m3/kg; 0 for particles of solids */
    RESIDUAL,          /* n / n0 - 1 at the end of the step, as predicted */
    MISS,              /* error of RESIDUAL: on either side where k holds; else only above 0 */
    CHANGE,            /* of k in the iteration before, Pa */
    OTHER,             /* accelerations except the running solver's, m/s2: 3 */
    SOLID = OTHER + 3, /* SolidColumns of sim/methods/shared/incompressible.h */
    SOLID_FLOW = SOLID + SOLID_COLUMNS, /* sum F v_b . x_ib over boundary particles, 1/s */
    BASE, /* velocities in the middle of the next step without the running solver, m/s: 3 */
    BOUNDARY_PART = BASE + 3, /* the second part of boundary particles in the rate, over n0 */
};

extern const ColumnDef dfsph_columns[];
extern const ColumnDef *const dfsph_miss;

/* Constants of a def for dfsph alone: of the pair sums, shared with shaders, and of the solvers. */
typedef struct DfsphConstants {
    DfsphBlock sums;
    int most; /* iterations */
    bool coarse;
    double tolerance, divergence_tolerance;
    IncompressibleFactors factors;
} DfsphConstants;

static inline const DfsphConstants *dfsph_solvers(const Constants *constants)
{
    return (const DfsphConstants *)(const void *)constants->of_method;
}

static inline const DfsphBlock *dfsph_constants(const Constants *constants)
{
    return &dfsph_solvers(constants)->sums;
}

/* From positions alone: n, volume, D, and values per particle for pair sums. */
extern const Pass dfsph_state;

/* Accelerations except pressure. */
extern const Pass dfsph_others;

/* Around terms at the end of a step (sim/step/method.h). dfsph_pressed adds all other accelerations to those
   by the last step's pressure. After the terms dfsph_unpressed subtracts that pressure: the rest is all but
   pressure. */
extern const Pass dfsph_pressed, dfsph_unpressed;

/* First k and residual of a solver; at the end, the values to keep. */
extern const Pass dfsph_divergence_begin, dfsph_density_begin, dfsph_divergence_end, dfsph_density_end;

/* Adds to k what a coarse level finds for the residual. On the CPU, overwrites the accelerations. */
extern const Pass dfsph_coarse;
bool dfsph_has_coarse(const Constants *constants);

/* An iteration: k by the residual before, accelerations by k; then the residual by accelerations. */
extern const Pass dfsph_divergence_push, dfsph_divergence_rate, dfsph_density_push, dfsph_density_rate;

#endif
