/* Constants of dfsph, shared by C and shaders; filled by dfsph_set of sim/methods/dfsph/dfsph.c. */
#ifndef SLOSH_DFSPH_BLOCK_H
#define SLOSH_DFSPH_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"
#include "shaders/sim/shared/boundary_most.h"

/* Storage buffers, beside those of shaders/sim/bindings.h */
#define MOVES_BUFFER  3
#define PUSHES_BUFFER 7

/* Part of the last iteration's change that goes on. Steps leave long waves to the solver of density, hardly
   seen by Jacobi's method without momentum (0.9 shakes up short waves where a step finds them too). Steps
   leave short waves as well to the solver of divergence. */
#define DENSITY_MOMENTUM    0.8F
#define DIVERGENCE_MOMENTUM 0.6F

/* Factor of the first iteration's change, which turns short waves round: with the whole change the second
   iteration would make them as long again. Used for any k without a change before, so that no pass needs the
   iteration's number. */
#define DIVERGENCE_BEGINS 0.5F

/* Longest way of a particle by the solver of density in a step, spacings. */
#define MOVE_MOST 0.2F

/* Part of surface_slope below which a particle is no part of a surface: fluid out of order has some slope
   everywhere. */
#define SURFACE_FROM 0.35F

/* What a surface lacks is at most so many times 1 - n / n0: none where n is whole. */
#define LACK_OVER_GAP 2.0F

/* Layers of pressure below which walls hold no weight: a row that lies alone on a wall has half a layer. */
#define LIFT_FROM 0.5F

UNIFORM_BLOCK(DfsphBlock, METHOD_BLOCK)
{
    float gradient;          /* F = -W'(r) / r over f(r / h), of the density kernel, 1/m2 */
    float friction_gradient; /* the same calibrated for gradients (sim/kernel/kernel.h) */
    float relaxation;        /* of Jacobi */
    float pressure_of_term;  /* p over k */
    float least_squares;     /* lower bound of D times m, 1/m2 */
    float surface_lack;      /* the outermost row of a half-filled lattice: 1 - n / n0, */
    float surface_slope;     /* and |sum F x_ij|, 1/m */
    float boundary_fades;    /* of the boundary part, 1/s */
    float lightest;          /* least mass of a particle over U, kg/m3 */
    float coarse_slope;      /* C / h: sim/methods/dfsph/dfsph_passes.c */
}
BLOCK_END(DfsphBlock);

#endif
