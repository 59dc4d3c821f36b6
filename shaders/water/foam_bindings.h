/* Binding numbers used only by the shaders of foam; more in shaders/shared/bindings.h. */
#ifndef SLOSH_FOAM_BINDINGS_H
#define SLOSH_FOAM_BINDINGS_H

#define FOAM_BUBBLES 16u  /* most bubbles of a particle */
#define FOAM_LEAST   0.02 /* foam below this fraction counts as none */
#define FOAM_DEEP    2.5  /* spacings below the surface where a bubble hides less than a hundredth */

/* Storage buffers */
#define FOAM_VELOCITIES_STORAGE 3
#define FOAM_LIST_STORAGE       5
#define FOAM_TABLE_STORAGE      5 /* amounts by id */
#define FOAM_AMOUNTS_STORAGE    6
#define FOAM_COMMAND_STORAGE    7 /* drawing command for points, and bubbles per particle */

/* Texture units */
#define FOAM_SURFACE_UNIT 6
#define FOAM_SOLID_UNIT   7

/* Locations of uniforms */
#define FOAM_SPEEDS_AT          17
#define FOAM_VELOCITY_STRIDE_AT 18
#define FOAM_MOST_AT            19
#define FOAM_LEFT_AT            20
#define FOAM_SLOTS_AT           21
#define FOAM_PARTICLES_AT       22

#endif
