/* Constants of pbf, shared by C and shaders; filled by pbf_set of sim/methods/pbf/pbf.c. */
#ifndef SLOSH_PBF_BLOCK_H
#define SLOSH_PBF_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"
#include "shaders/sim/shared/boundary_most.h"

/* A storage buffer, beside those of shaders/sim/bindings.h */
#define MOTIONS_BUFFER 7

/* Part of the last iteration's change that goes on: halves the number of iterations. */
#define PBF_MOMENTUM 0.6F

/* Part of the multipliers forgotten by a step, at most, and in the time to settle. With all multipliers kept,
   remains of a blow or of a tolerance push again before they are taken back, and a column at rest jumps. With
   none kept, half as many iterations more are needed. A short step has one iteration as a rule, and a column
   hums at 0.1 m/s where less is forgotten. */
#define FORGOTTEN      0.5F
#define FORGOTTEN_RATE 3.0F

/* Longest way in an iteration, in spacings: fluid folded by a long step comes apart in several iterations,
   and is not thrown. The rest of a shortened way is lost to momentum. */
#define WAY_LONGEST 0.2F

/* Least distance from a wall after an iteration, in spacings: right at a wall a particle's image does not
   push. */
#define WALL_LEAST 0.1F

/* Part of the first compression removed by a step, from dt over the time to settle: all in that time, less in
   a shorter step. Moved positions become velocity, the way over dt, so that removing more in a short step
   would throw the fluid. (J. Baumgarte, "Stabilization of constraints and integrals of motion in dynamical
   systems", 1972) */
#define PBF_SHARE(times) ((times) < 1.0F ? (times) : 1.0F)

/* Part of the support by walls, from pressure over a layer's; at most 1, at least 0. */
#define PBF_WALL_FADE(layers) (0.5F * (layers)-1.0F)

/* The same by solids. */
#define PBF_SOLID_FADE(layers) ((layers)-0.5F)

/* Greatest change of n / n0 by mirrored ways: a way of spacings, next to a fast solid, is no slope times a
 * way. */
#define PBF_MIRRORED 0.1F

UNIFORM_BLOCK(PbfBlock, METHOD_BLOCK)
{
    float gradient;          /* F = -W'(r) / r over f(r / h), of the density kernel, 1/m2 */
    float friction_gradient; /* the same calibrated for gradients (sim/kernel/kernel.h) */
    float relaxation;        /* of Jacobi */
    float least_squares;     /* a part of sum F^2 r^2 on the lattice, 1/m2: over m added to D, as a lower
                                bound */
    float pressure_of_term;  /* p over k / dt^2 */
    float viscous_dt;        /* longest stable step with friction, s */
    float settle_rate;       /* 1 over the time to settle, 1/s */
    float boundary_fades;    /* of the boundary part, 1/s */
}
BLOCK_END(PbfBlock);

#endif
