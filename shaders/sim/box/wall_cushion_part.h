/* How the walls' cushion is made, of which C and shaders read the same: sim/box/wall_cushion.h. */
#ifndef SLOSH_WALL_CUSHION_PART_H
#define SLOSH_WALL_CUSHION_PART_H

/* How far it reaches, spacings: the lattice's first layer, and nearly all of a tank's, stand beyond it. */
#define CUSHION_REACH 0.3f

/* At the wall itself, over the pull into it: what lies on a wall alone rests at 0.24 spacings. */
#define CUSHION_PUSH 5.0f

/* Where what leaves the wall has so much of sqrt(|g_n| spacing) for its speed it is pushed no more. */
#define CUSHION_LEAVES 0.1f

/* Over how much of a layer's pressure it fades in. */
#define CUSHION_FADE 0.25f

/* (omega dt)^2 of its spring, at most: no step is too long for it. */
#define CUSHION_TURN 0.5f

#endif
