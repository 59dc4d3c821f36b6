/* Bounds of the step size, and causes of trouble after too large a step. Pure functions. */
#ifndef SIM_STEP_STEP_CONTROL_H
#define SIM_STEP_STEP_CONTROL_H

#include "sim/def/fluids.h"
#include "slosh/def.h"
#include "slosh/world.h"

#include <stdbool.h>

/* A solver is in trouble if its final residual exceeds the tolerance by this factor. */
#define STEP_SOLVE_STANDS 10

/* Findings of a substep, over all particles. */
typedef struct StepWatch {
    bool bounded;            /* no particle moves further than the support radius in the step, and none is
                                NaN */
    bool memory;             /* memory was short: some neighbours are missing */
    float max_speed;         /* m/s */
    float max_acceleration;  /* m/s2, with gravity */
    float max_density_ratio; /* number density over rest number density */
    size_t lost, lost_limit; /* particles without a place in the grid, most in a step; limit for trouble */
} StepWatch;

/* Without a `sentinel`, only trouble that prevents further steps. */
StepTrouble step_trouble_of(const StepWatch *watch, bool sentinel);

/* Friction of a def's method. Takes some milliseconds: call once per world. */
StepFriction step_friction(const WorldDef *def);

/* Greatest over least density of a def's fluids. */
double density_ratio(const WorldDef *def);

/* The sound speed that bounds a step, m/s; 0 without sound. */
double step_sound(const WorldDef *def);

/* Kinematic viscosity equivalent to an artificial viscosity, alpha c h / 4, m2/s. */
double artificial_kinematic(const WorldDef *def, double alpha);

/* The laminar viscosity with the same work in a shear: alpha c h / (4 (d + 2)), m2/s (Monaghan 2005). */
double numerical_kinematic(const WorldDef *def, double alpha);

/* The remaining alpha for fluid f: all of alpha without a viscosity, 0 from the equivalent viscosity of
   alpha on. */
double step_alpha(const WorldDef *def, double alpha, int f);

/* Viscosity between pairs of fluid f, Pa s: the present viscosity, or the method's numerical viscosity if
   greater. */
double step_viscosity(const WorldDef *def, const StepFriction *friction, int f);

/* The longest stable step for friction on the lattice at rest, s: longer steps amplify velocity
   differences. Uses the def's present viscosities; a pair of fluids counts with half of pair_viscosity,
   over the lighter fluid's density. INFINITY without friction. */
double step_viscous(const WorldDef *def, const StepFriction *friction);

/* The longest stable step for sound, in h / c: 2 / omega of the stiffest wave on the lattice; omega is 2.0
   to 2.6 c / h by kernel and support. With summed density, which has no damping, steps above
   STEP_SOUND_CALM heat fluid without friction: docs/failures.md. */
#define STEP_SOUND_STANDS 0.9
#define STEP_SOUND_CALM   0.5

/* The longest stable step for the pressure of fluid at rest, s, for a method without sound; INFINITY for
   methods with sound. A method that leaps parts anew in each step what fell by g dt^2: above half a spacing
   a column reads 1.3 to 1.8 times its weight and boils (2D, 20 and 36 layers). Of other methods: Multipliers
   belong to the middle of a step. At p / rho = g times depth, positions boil from 0.3 h / sqrt(g depth) on in
   3D (0.43 in 2D), at any tolerance; later with implicit friction as damping. Depth is the greatest fall. */
double step_pressure(const WorldDef *def);
#define STEP_PRESSURE_STANDS 0.25
#define STEP_FALL_STANDS     0.4 /* spacings */

/* The longest step to resolve surface tension, s: J. U. Brackbill, D. B. Kothe, C. Zemach, "A continuum
   method for modeling surface tension", 1992, eq. 61, for the fluid with the tightest bound. A wave of two
   spacings is stable up to 1.8 times this step, and a drop with cohesion and without sound up to 1.3 to 2.7
   times; a third of this step holds with methods that move particles by tension before parting them
   (docs/failures.md). INFINITY without tension. */
double step_tension(const WorldDef *def);
#define STEP_TENSION_STANDS 0.5
#define STEP_TENSION_LEAPS  (STEP_TENSION_STANDS / 3)

/* Share of step_viscous at which disordered fluid is stable. Measured: 0.8 to 1.1; with carried density in
   3D at supports below 3, stirred hard: 0.6 (docs/failures.md). */
#define STEP_VISCOUS_STANDS 0.7

/* Describes the bound of a step of `dt` s in which a world blew up, at the greatest speed before (m/s), and
   the change to make: words for an error. */
void step_advice(const WorldDef *def, const StepFriction *friction, StepTrouble trouble, double dt,
                 double max_speed, char words[200]);

/* The adaptive step (mode cfl; Monaghan, "Smoothed particle hydrodynamics", 1992, eq. 10.1 f.): the least
   limit at the speed and acceleration of the last step. Never much longer than the last step (`before`, s;
   0: none), so that the effects of a blow have time to show. */
double step_cfl(const WorldDef *def, const StepFriction *friction, double max_speed, double max_acceleration,
                double before, StepLimit *binding);

/* The step of at most `dt` that reaches `left` (s) in an integer number of equal steps, if four or fewer
   suffice: no tiny last step, after which steps would have to grow again. Otherwise `dt`. */
double step_towards(double dt, double left);

#endif
