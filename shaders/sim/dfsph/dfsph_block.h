/* The constants of dfsph, of which C and shaders read the same; dfsph_set of sim/dfsph/dfsph.c fills it. */
#ifndef SLOSH_DFSPH_BLOCK_H
#define SLOSH_DFSPH_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

/* Storage buffers, beside those of shaders/sim/bindings.h */
#define MOVES_BUFFER  3
#define PUSHES_BUFFER 7

/* How much of the iteration before goes on. What a step leaves to the solver of density are long waves, which
   Jacobi without it hardly sees (0.9 shakes the short ones up where a step finds these too); what it leaves
   to that of divergence are short ones as well. */
#define DENSITY_MOMENTUM    0.8F
#define DIVERGENCE_MOMENTUM 0.6F

/* And of the first iteration, which turns short waves round: with all of it the second one would make them as
   long again. Of what begins to change alone, so that no pass has to know which iteration it is. */
#define DIVERGENCE_BEGINS 0.5F

/* How far the solver of density moves a particle in a step, spacings. */
#define MOVE_MOST 0.2F

/* Of a particle's neighbours along a solid, those of the solid, at most: what is between two solids. */
#define SHARE_MOST 0.5F

UNIFORM_BLOCK(DfsphBlock, METHOD_BLOCK)
{
    float gradient;          /* F = -W'(r) / r over f(r / h), of the kernel that sums density, 1/m2 */
    float friction_gradient; /* the same calibrated for gradients (sim/kernel/lattice.h) */
    float relaxation;        /* of Jacobi */
    float pressure_of_term;  /* p over k */
    float least_squares;     /* D times m is no less, 1/m2 */
}
BLOCK_END(DfsphBlock);

#endif
