/* Buffers of the coarse level on the GPU: sim/gpu/compute/coarse.c. */
#ifndef SLOSH_COARSE_BLOCK_H
#define SLOSH_COARSE_BLOCK_H

#include "shaders/sim/bindings.h"
#include "shaders/sim/step/coarse_rule.h"

/* Floats of a cell: the matrix of the corners, residuals of the corners, sums over particles */
#define COARSE_CELL_RESIDUALS 64
#define COARSE_CELL_WEIGHT    72
#define COARSE_CELL_HOLD      73
#define COARSE_CELL_FLOATS    74

/* Arrays of floats over nodes; the last: rows of the matrix, by the 27 nodes around. */
#define COARSE_NODE_VALUE     0
#define COARSE_NODE_RESIDUAL  1
#define COARSE_NODE_DIRECTION 2
#define COARSE_NODE_BENT      3
#define COARSE_NODE_INVERSE   4
#define COARSE_NODE_STENCIL   5
#define COARSE_NODE_FLOATS    32

#define COARSE_SOLVE_LANES 1024

/* Storage buffers, beside those of shaders/sim/bindings.h */
#define COARSE_TERMS_BUFFER 4
#define COARSE_CELLS_BUFFER 5
#define COARSE_NODES_BUFFER 7

#endif
