/* Numbers of sim/methods/wcsph/drops.c, shared by C and shaders. */
#ifndef SLOSH_DROPS_BLOCK_H
#define SLOSH_DROPS_BLOCK_H

#define DROPS_BUFFER 8 /* besides those of shaders/sim/bindings.h */

/* Sums of forces are in steps of 2^-28 of the force of the greatest curvature. A force has at most 2^30 of
   them, so 2^33 particles fit into 64 bits. */
#define DROP_STEPS 268435456.0f
#define DROP_MOST  1073741824.0f

/* A tally of a body is 8 for each particle, plus a bit for each axis with a wall. */
#define DROP_ONE 8u

#endif
