/* Theoretical limits of the step. */
#ifndef SLOSH_STABLE_LIMITS_H
#define SLOSH_STABLE_LIMITS_H

#include "sim/matter/world_def.h"

/* s; INFINITY: no limit */
typedef struct StableLimits {
    double sound;    /* 2 / omega of the stiffest wave on the lattice: sim/kernel/sound_wave.h */
    double friction; /* step_viscous */
    /* Limit for sound and friction together. A Verlet step with friction from the velocity at the start of
       the step is stable if omega^2 dt^2 + 2 gamma dt < 4. The greatest omega and the greatest gamma = 2 /
       friction belong to different waves: the limit is shorter than the largest stable step, at worst 0.62
       times, where both are equal. */
    double lattice;
    /* Textbook limits, with the smoothing length l = h / 2 and the greatest kinematic viscosity nu; after
       J. J. Monaghan 1992 and J. P. Morris 1997. */
    double courant; /* 0.4 l / c */
    double force;   /* 0.25 sqrt(l / g) */
    double viscous; /* 0.125 l^2 / nu */
} StableLimits;

/* Computes the limits for the def's method and settings. Takes some milliseconds. */
void stable_limits(const WorldDef *def, StableLimits *limits);

/* Returns a start for the search: the lattice limit; without sound the step for pressure
   (sim/world/step_control.h). */
double stable_guess(const WorldDef *def, const StableLimits *limits);

#endif
