/* How long a step may be by theory. */
#ifndef SLOSH_STABLE_LIMITS_H
#define SLOSH_STABLE_LIMITS_H

#include "sim/matter/world_def.h"

/* s; INFINITY: it bounds nothing. */
typedef struct StableLimits {
    double sound;    /* 2 / omega of the stiffest wave on the lattice: sim/kernel/sound_wave.h */
    double friction; /* step_viscous */
    /* Both: a Verlet step whose friction is by the velocity at its begin stands omega^2 dt^2 + 2 gamma dt <
       4. The greatest omega and the greatest gamma = 2 / friction are of different waves, so that this is
       shorter than what holds, by 0.62 at worst, where both are alike. */
    double lattice;
    /* The textbook's, with the smoothing length l = h / 2 and the greatest kinematic viscosity nu; after
       J. J. Monaghan 1992 and J. P. Morris 1997. */
    double courant; /* 0.4 l / c */
    double force;   /* 0.25 sqrt(l / g) */
    double viscous; /* 0.125 l^2 / nu */
} StableLimits;

/* Of the def's method and present settings. Takes some milliseconds. */
void stable_limits(const WorldDef *def, StableLimits *limits);

/* Where a search may begin: the lattice's; without sound what pressure stands (sim/world/step_control.h). */
double stable_guess(const WorldDef *def, const StableLimits *limits);

#endif
