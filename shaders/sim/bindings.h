/* The numbers by which C hands to the solver's shaders what they read. */
#ifndef SLOSH_SIM_BINDINGS_H
#define SLOSH_SIM_BINDINGS_H

/* Uniform blocks */
#define CONSTANT_BLOCK     1
#define STEP_BLOCK         2
#define TERM_BLOCK         3
#define WATCH_BLOCK        4
#define METHOD_BLOCK       5 /* the method's own: its folder has it */
#define SOLID_STEPS_BLOCK  6
#define FLOW_BLOCK         7
#define EXACT_SHAPES_BLOCK 8
#define MESH_BLOCK         9

/* Texture units */
#define MESH_VALUES_TEXTURE 15

/* Storage buffers, of which a driver need not have more than eight; solids and a method's own columns need
   more. A pass has one of each number. */
#define POSITIONS_BUFFER  0
#define NAMES_BUFFER      1
#define STARTS_BUFFER     2 /* of the cells */
#define PRESSURES_BUFFER  3
#define VELOCITIES_BUFFER 4

#define WATCH_BUFFER         2 /* of those that write it */
#define ACCELERATIONS_BUFFER 5
#define DRAG_BUFFER          6
#define RESTS_BUFFER         7
#define NEAR_BUFFER          6 /* what the forces read of others: x y z, p V^2 */

/* Only for methods with columns of their own */
#define OWN_BUFFER     8
#define OLD_OWN_BUFFER 9
#define SCRATCH_BUFFER 10

#define LISTS_BUFFER 11 /* where a driver has as many bindings */

#define BOUNDARY_POSITIONS_BUFFER  12
#define BOUNDARY_VELOCITIES_BUFFER 13
#define BOUNDARY_STATES_BUFFER     14
#define BOUNDARY_STARTS_BUFFER     15

/* The grid, and particles on their way to another place */
#define ORDERS_BUFFER         3
#define CELLS_BUFFER          5
#define RANKS_BUFFER          6
#define SORTED_BUFFER         6
#define OLD_POSITIONS_BUFFER  2
#define OLD_VELOCITIES_BUFFER 5
#define OLD_NAMES_BUFFER      7

/* What box and solids feel */
#define FELT_BUFFER       3
#define FELT_RESTS_BUFFER 5 /* a pass of the method may have something at 7 */

/* Emitters, drains; what is shown, what is plotted */
#define LAYER_BUFFER  5
#define MARKS_BUFFER  6
#define VALUES_BUFFER 5
#define PARTS_BUFFER  5
#define SOLVE_BUFFER  6

/* Locations of uniforms: what a pass has of its own */
#define PASS_DT_AT         0 /* s */
#define FELT_DT_AT         1
#define SHOWN_SCALAR_AT    0
#define GRAVITY_C2_AT      0
#define FINGER_AT          0 /* xyz: the point, m; w: 1 / radius^2 */
#define FINGER_VELOCITY_AT 1 /* xyz: of the point, m/s; w: grip */
#define FINGER_KICK_AT     2
#define COLUMN_AT          0 /* the first number of a column of scratch, and the first of its parts */

/* How many there may be: the scene's limits, which C has as FLUIDS_MAX ... */
#define FLUIDS_MOST 8
#define SOLIDS_MOST 16
#define DRAINS_MOST 8
#define GUIDES_MOST 33

#endif
