/* Where a solver that iterates on the GPU stands; sim/gl/compute/iterate.c begins and reads it. The first
   three are the work groups of its passes, as the driver reads them: 0 once it has ended. */
#ifndef SLOSH_SOLVE_BLOCK_H
#define SLOSH_SOLVE_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

STORAGE_BLOCK(SolveBlock, SOLVE_BUFFER)
{
    uint groups_along;
    uint groups_rows;
    uint groups_deep;
    uint iterations; /* done */
    float left_mean; /* of the residual, as the last one has measured it */
    float left_most;
    float tolerance;      /* of the mean */
    float worst;          /* where a particle has more than that, */
    uint iterations_few;  /* there are so many at least */
    uint iterations_most; /* that it may do */
    uint ended;           /* 1: it has */
    uint scaled;          /* 1: the residual counts in the mean of a column */
    float go;             /* of conjugate gradients: how far along a direction, */
    float turn;           /* how much of the last one is in it, */
    float power;          /* the product of residual and direction */
}
BLOCK_END(SolveBlock);

#endif
