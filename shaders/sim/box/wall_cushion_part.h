/* Constants of the walls' cushion, shared by C and shaders: sim/box/box.h. */
#ifndef SLOSH_WALL_CUSHION_PART_H
#define SLOSH_WALL_CUSHION_PART_H

/* Reach, in spacings: the lattice's first layer, and nearly all particles of a tank's first layer, are
   beyond. */
#define CUSHION_REACH 0.3f

/* Acceleration at the wall over gravity into the wall: a lone layer rests at 0.24 spacings. */
#define CUSHION_PUSH 5.0f

/* No push for particles that leave the wall faster than this factor times sqrt(|g_n| spacing). */
#define CUSHION_LEAVES 0.1f

/* Share of a layer's pressure over which the cushion fades in. */
#define CUSHION_FADE 0.25f

/* Upper bound of (omega dt)^2 of the spring: no step is too long. */
#define CUSHION_TURN 0.5f

#endif
