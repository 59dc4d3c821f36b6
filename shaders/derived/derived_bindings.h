/* Binding numbers used only by the shaders of derived scalars and vectors; more in
   shaders/shared/bindings.h. */
#ifndef SLOSH_DERIVED_BINDINGS_H
#define SLOSH_DERIVED_BINDINGS_H

/* Storage buffers */
#define VELOCITIES_STORAGE 3
#define DERIVED_STORAGE    9
#define THREES_STORAGE     4 /* three buffers; for passes without neighbours */
#define IDS_STORAGE        4 /* for the pass with births */
#define BIRTHS_STORAGE     5
#define OLD_FOAM_STORAGE   10
/* for ranges */
#define RANKS_FOUND_STORAGE 4
#define RANK_BINS_STORAGE   5

/* Values of an invocation that counts the highest digit */
#define RANKS_A_LANE 16u

/* Texture units */
#define OTHERS_UNIT 2

/* Locations of uniforms */
#define VELOCITY_STRIDE_AT 16
#define KERNEL_REACH_AT    17
#define MOMENT_SCALE_AT    18
#define TWO_DIMENSIONS_AT  19
#define PERIOD_AT          20
#define FRAME_VELOCITY_AT  21
#define FRAME_TURN_AT      22
#define DIGIT_AT           23
#define NOW_AT             24
#define BIRTHS_COUNT_AT    25
#define SLOWEST_AT         26
#define AIR_BOUNDS_AT      27
#define FOAM_KNOWN_AT      28
#define WALLED_LOW_AT      29
#define WALLED_HIGH_AT     30

#endif
