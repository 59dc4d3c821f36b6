/* State of an iterating solver on the GPU; sim/gpu/compute/stages.c initializes and reads the block. The
   first members are the work groups of the solver's passes, of the sums of its residual and of its decision,
   read by the driver: 0 after the end. */
#ifndef SLOSH_SOLVE_BLOCK_H
#define SLOSH_SOLVE_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

STORAGE_BLOCK(SolveBlock, SOLVE_BUFFER)
{
    uint groups_along;
    uint groups_rows;
    uint groups_deep;
    uint sums_along;
    uint sums_rows;
    uint sums_deep;
    uint decisions_along;
    uint decisions_rows;
    uint decisions_deep;
    uint iterations; /* done */
    float left_mean; /* residual, as last measured */
    float left_most;
    float tolerance;      /* for the mean */
    float worst;          /* if a particle exceeds `worst`, */
    uint iterations_few;  /* at least so many iterations run */
    uint iterations_most; /* limit of iterations */
    uint ended;           /* 1: ended */
    uint particles;
    uint scaled; /* 1: the residual is in units of a column's mean */
    float go;    /* conjugate gradients: length along the direction */
    float turn;  /* share of the last direction in the new direction */
    float power; /* product of residual and direction */
}
BLOCK_END(SolveBlock);

#endif
