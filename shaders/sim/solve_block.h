/* State of an iterating solver on the GPU; sim/gpu/compute/iterate.c initializes and reads the block. The
   first members are numbers of work groups, read by the driver. Of an iteration: 0 after the end of a round.
   Of new lists: 0 unless the last renew.comp began a round. Of a coarse correction: 0 unless due. */
#ifndef SLOSH_SOLVE_BLOCK_H
#define SLOSH_SOLVE_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"
#include "shaders/sim/step/coarse_rule.h"

#define SOLVE_ROUNDS 4 /* at most: iterations between new lists */

/* As the driver reads them. */
BLOCK_STRUCT(WorkGroups)
{
    uint along;
    uint rows;
    uint deep;
    uint unused;
}
BLOCK_END(WorkGroups);

STORAGE_BLOCK(SolveBlock, SOLVE_BUFFER)
{
    WorkGroups pass_groups; /* of an iteration */
    WorkGroups sum_groups;  /* of an iteration's residual */
    WorkGroups decision_groups;
    WorkGroups renewal_groups; /* of new lists */
    WorkGroups renewal_sum_groups;
    WorkGroups renewal_decision_groups;
    WorkGroups coarse_groups; /* of a due coarse correction: over particles, */
    WorkGroups coarse_cell_groups;
    WorkGroups coarse_solve_groups;
    uint pass_groups_along; /* within a round */
    uint sum_groups_along;
    uint renewal_groups_along;
    uint coarse_cell_groups_along;
    uint coarse;     /* 1: with a coarse level; 0 once the fluid was found too thin */
    uint iterations; /* done in the round */
    float left_mean; /* residual, as last measured */
    float left_most;
    float left_before;    /* left_mean of the iteration before, */
    float left_second;    /* and of two before */
    float tolerance;      /* for the mean */
    float worst;          /* if a particle exceeds `worst`, */
    uint iterations_few;  /* at least so many iterations run */
    uint iterations_most; /* limit of iterations */
    uint ended;           /* 1: the round has ended */
    uint particles;
    uint scaled;    /* 1: the residual is in units of a column's mean */
    float go;       /* conjugate gradients: length along the direction */
    float turn;     /* share of the last direction in the new direction */
    float power;    /* product of residual and direction */
    float way_most; /* of the mean of a column; above, lists are useless */
    uint rounds_most;
    uint rounds;                         /* before the present round */
    uint round_iterations[SOLVE_ROUNDS]; /* of these */
}
BLOCK_END(SolveBlock);

#endif
