/* Binding numbers used only by the shaders of streamlines; more in shaders/shared/bindings.h. */
#ifndef SLOSH_STREAMLINES_BINDINGS_H
#define SLOSH_STREAMLINES_BINDINGS_H

/* Storage buffers, in addition to those of particles and neighbourhood */
#define STREAM_FASTEST_STORAGE 4
#define STREAM_POINTS_STORAGE  5

/* Locations of uniforms */
#define STREAM_STEP_AT     16 /* m */
#define STREAM_STEPS_AT    17 /* each way */
#define STREAM_SLOWEST_AT  18 /* of the fastest */
#define STREAM_NORMAL_AT   19
#define STREAM_LEAST_AT    20 /* corner of the box */
#define STREAM_GREATEST_AT 21
#define STREAM_IS_FLUID_AT 22
#define STREAM_COLOR_AT    23
#define STREAM_LIFT_AT     24
#define STREAM_BEGUN_AT    25

#define STREAM_STEPS_A_RUN 8u

#endif
