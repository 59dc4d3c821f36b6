/* Binding numbers shared by C and the solver's shaders. */
#ifndef SLOSH_SIM_BINDINGS_H
#define SLOSH_SIM_BINDINGS_H

/* Uniform blocks */
#define CONSTANT_BLOCK     1
#define STEP_BLOCK         2
#define TERM_BLOCK         3
#define WATCH_BLOCK        4
#define METHOD_BLOCK       5 /* the method's own: defined in its folder */
#define SOLID_STEPS_BLOCK  6
#define FLOW_BLOCK         7
#define EXACT_SHAPES_BLOCK 8
#define MESH_BLOCK         9

/* Texture units */
#define MESH_VALUES_TEXTURE 15

/* Storage buffers. A driver guarantees only eight; solids and a method's columns need more. A pass has at
   most a buffer per number. */
#define POSITIONS_BUFFER  0
#define NAMES_BUFFER      1
#define STARTS_BUFFER     2 /* of the cells */
#define PRESSURES_BUFFER  3
#define VELOCITIES_BUFFER 4

#define WATCH_BUFFER         2 /* for passes that write it */
#define ACCELERATIONS_BUFFER 5
#define DRAG_BUFFER          6
#define RESTS_BUFFER         7
#define NEAR_BUFFER          6 /* read of neighbours by forces: x y z, p V^2 */

/* Only for methods with own columns */
#define OWN_BUFFER     8
#define OLD_OWN_BUFFER 9
#define SCRATCH_BUFFER 10

#define LISTS_BUFFER      11 /* if the driver has enough bindings */
#define MORE_LISTS_BUFFER 16 /* and the next: where lists take several blocks */

#define BOUNDARY_POSITIONS_BUFFER  12
#define BOUNDARY_VELOCITIES_BUFFER 13
#define BOUNDARY_STATES_BUFFER     14
#define BOUNDARY_STARTS_BUFFER     15

/* The grid, and moving particles */
#define ORDERS_BUFFER         3
#define CELLS_BUFFER          5
#define RANKS_BUFFER          6
#define SORTED_BUFFER         6
#define OLD_POSITIONS_BUFFER  2
#define OLD_VELOCITIES_BUFFER 5
#define OLD_NAMES_BUFFER      7

/* Forces on box and solids */
#define FORCES_BUFFER       3
#define FORCES_RESTS_BUFFER 5 /* a pass of the method may use 7 */
#define FORCE_SUMS_BUFFER   6

/* Emitters, drains; shown values, plotted values */
#define FLOW_COUNTS_BUFFER 2
#define LAYER_BUFFER       5
#define MARKS_BUFFER       6
#define VALUES_BUFFER      5
#define PARTS_BUFFER       5
#define SOLVE_BUFFER       6

/* Clears and copies */
#define CLEARED_BUFFER 0
#define COPIED_BUFFER  1

/* Locations of uniforms of single passes */
#define PASS_DT_AT         0 /* s */
#define FORCES_DT_AT       1
#define SHOWN_SCALAR_AT    0
#define GRAVITY_C2_AT      0
#define FINGER_AT          0 /* xyz: the point, m; w: 1 / radius^2 */
#define FINGER_VELOCITY_AT 1 /* xyz: of the point, m/s; w: grip */
#define FINGER_KICK_AT     2
#define FLOW_AT            0 /* number of a layer or drain, index of the marks' total, 1: a drain */
#define WORDS_AT           0 /* of a clear or copy: number of words, first of the source, first of the copies */
#define COLUMN_AT          0 /* first number of a scratch column, and first of its parts */

/* Limits of the scene, in C FLUIDS_MAX ... */
#define FLUIDS_MOST 8
#define SOLIDS_MOST 16
#define DRAINS_MOST 8
#define GUIDES_MOST 33

#define FLOWS_MOST 256 /* layers and drains of a step */

#endif
