/* Where the solver's shaders find what more than one pass reads; what a pass alone reads has numbers below
   these. */
#ifndef SLOSH_SIM_BINDINGS_H
#define SLOSH_SIM_BINDINGS_H

/* Uniform blocks */
#define CONSTANT_BLOCK     1
#define STEP_BLOCK         2
#define TERM_BLOCK         3
#define WATCH_BLOCK        4
#define SOLID_STEPS_BLOCK  6
#define FLOW_BLOCK         7
#define EXACT_SHAPES_BLOCK 8

/* Storage buffers */
#define WATCH_BUFFER        2 /* of those that write it */
#define BOUNDARY_POSITIONS  12
#define BOUNDARY_VELOCITIES 13
#define BOUNDARY_STATES     14
#define BOUNDARY_STARTS     15
#define WALL_TABLES         7
#define DRAG_TABLES         5
#define CELL_STARTS         2

/* How many there may be: the scene's limits, which C has as FLUIDS_MAX ... */
#define FLUIDS_MOST 8
#define SOLIDS_MOST 16
#define DRAINS_MOST 8
#define GUIDES_MOST 32

#endif
