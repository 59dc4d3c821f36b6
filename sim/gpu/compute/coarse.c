/* The coarse level of a solver (sim/step/backend.h): as sim/cpu/coarse.c, in float, by three passes after the
   method's own. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/coarse_block.h"

bool compute_coarse_fit(Compute *c)
{
    const CoarseShape shape = compute_coarse_shape(c->constants);
    if (c->coarse_nodes || !compute_corrects(c->constants))
        return true;
    c->coarse_cells = compute_buffer(c, "cells of the coarse level", 4 * COARSE_CELL_FLOATS * shape.cells);
    c->coarse_nodes = compute_buffer(c, "nodes of the coarse level", 4 * COARSE_NODE_FLOATS * shape.nodes);
    return c->coarse_cells && c->coarse_nodes;
}

void compute_correct(Compute *c, const Pass *pass, const PassInput *input)
{
    const size_t cells = compute_coarse_shape(c->constants).cells;
    c->decided = DECIDED_CORRECTION;
    compute_pass(c, pass, input);
    compute_sweep(c, COMPUTE_COARSE_SUM, COMPUTE_GROUP * cells);
    compute_sweep(c, COMPUTE_COARSE_SOLVE, COMPUTE_GROUP);
    compute_sweep(c, COMPUTE_COARSE_ADD, c->count);
    c->decided = DECIDED_NONE;
}
