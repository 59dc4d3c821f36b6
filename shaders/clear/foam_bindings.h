/* The numbers by which C hands to the shaders of foam what only they read; those of shaders/shared/bindings.h
   besides. */
#ifndef SLOSH_FOAM_BINDINGS_H
#define SLOSH_FOAM_BINDINGS_H

#define FOAM_BUBBLES 16u  /* of a particle, where all are drawn */
#define FOAM_LEAST   0.02 /* share of foam that is none yet */
#define FOAM_DEEP    2.5  /* spacings below the surface: a bubble hides less than a hundredth there */

/* Storage buffers */
#define FOAM_VELOCITIES_STORAGE 3
#define FOAM_LIST_STORAGE       5
#define FOAM_COMMAND_STORAGE    6 /* of points, and how many a particle has */

/* Texture units */
#define FOAM_SURFACE_UNIT 6
#define FOAM_SOLID_UNIT   7

/* Locations of uniforms */
#define FOAM_COUNT_AT           16
#define FOAM_SPEEDS_AT          17
#define FOAM_VELOCITY_STRIDE_AT 18
#define FOAM_MOST_AT            19

#endif
