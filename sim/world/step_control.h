/* How large a step may be, and what to do when it was too large. Pure: numbers in, numbers out. */
#ifndef SLOSH_STEP_CONTROL_H
#define SLOSH_STEP_CONTROL_H

#include "sim/matter/world_def.h"
#include "sim/world/step_parts.h"

#include <stdbool.h>

/* X(ENUM, name, help): what bounds a step */
#define STEP_LIMITS(X)                                                                                       \
    X(DT, "dt", "the scene's fixed step")                                                                    \
    X(COURANT, "courant", "number h / (c + greatest speed)")                                                 \
    X(FORCE, "force", "number sqrt(h / greatest acceleration); without sound sqrt(number h / it)")           \
    X(VISCOUS, "viscous", "2 number, at most 0.7, of the longest step that friction stands")                 \
    X(MAX_DT, "max_dt", "the scene's greatest step")                                                         \
    X(GROWTH, "growth", "a tenth more than the step before")                                                 \
    X(PRESSURE, "pressure", "without sound: 0.25 h / sqrt(gravity times depth)")                             \
    X(TENSION, "tension", "half of sqrt(density spacing^3 / (2 pi surface tension))")

typedef enum StepLimit {
#define X(NAME, name, help) STEP_LIMIT_##NAME,
    STEP_LIMITS(X)
#undef X
        STEP_LIMIT_COUNT
} StepLimit;

const char *step_limit_name(StepLimit limit);

/* How a world steps. Doubles only: part of its saved state. */
typedef struct StepState {
    double dt;               /* of the step in hand or the last one, s */
    double wanted;           /* dt before refine divides it and the end of a frame fits it, s */
    double limit;            /* a StepLimit: what bounds it */
    double max_speed;        /* m/s, after the last step */
    double max_acceleration; /* m/s2, in the last step */
    double frame_left;       /* steps until the frame ends; -1: it is to be begun again */
    double refine;           /* 1, 2, 4, ...: the step is divided by that after trouble */
    double tries;            /* halvings that have not been taken back */
    double calm;             /* steps since the last trouble or relief */
} StepState;

/* What a solver that iterates did in a step. */
typedef struct StepSolve {
    double iterations; /* 0: it did not run */
    double mean,
        most; /* what is left of the residual, as the solver measures it: over all particles, at worst */
    double tolerance; /* of the mean */
    bool failed;      /* ended far from what it was asked for */
} StepSolve;

/* A solver is in trouble where its iterations end with so many times the residual that it may leave. */
#define STEP_SOLVE_STANDS 10

/* What a substep found, over all particles. */
typedef struct StepWatch {
    bool bounded;            /* no particle moves further than the support radius in the step, none is NaN */
    bool memory;             /* was short: some neighbours were not seen */
    float max_speed;         /* m/s */
    float max_acceleration;  /* m/s2, gravity included */
    float max_density_ratio; /* of number density over that at rest */
    size_t lost,
        lost_limit; /* particles without a place in the grid, at most in one step, and how many may be */
} StepWatch;

/* X(ENUM, words): trouble that the sentinel finds */
#define STEP_TROUBLES(X)                                                                                     \
    X(NONE, "")                                                                                              \
    X(SPEED, "a particle moves further than the support radius in one step")                                 \
    X(SOLID, "a solid that floats moves further than the support radius in one step")                        \
    X(DENSITY, "fluid is pressed to more than five times its density")                                       \
    X(ENERGY, "energy grows by a tenth without work done")                                                   \
    X(SOLVE, "a solver does not converge")                                                                   \
    X(MEMORY, "there is no memory for the lists of neighbours")                                              \
    X(LOST, "particles found no place in the grid of backend fragment")

typedef enum StepTrouble {
#define X(NAME, words) STEP_TROUBLE_##NAME,
    STEP_TROUBLES(X)
#undef X
        STEP_TROUBLE_COUNT
} StepTrouble;

const char *step_trouble_words(StepTrouble trouble);
/* Without a `sentinel` only what no step can go on from. */
StepTrouble step_trouble_of(const StepWatch *watch, bool sentinel);

/* Of a def's method. Takes some milliseconds: once a world. */
StepFriction step_friction(const WorldDef *def);

/* The greatest density of a def's fluids over the least. */
double density_ratio(const WorldDef *def);

/* The speed of sound that bounds a step, m/s; 0 without sound. */
double step_sound(const WorldDef *def);

/* The viscosity that an artificial one stands for, alpha c h / 4, m2/s. */
double artificial_kinematic(const WorldDef *def, double alpha);

/* The same as a laminar one, whose work in a shear it does: alpha c h / (4 (d + 2)), m2/s (Monaghan 2005). */
double numerical_kinematic(const WorldDef *def, double alpha);

/* What of alpha remains for fluid f: all without a viscosity, none from the viscosity on that alpha stands
   for. */
double step_alpha(const WorldDef *def, double alpha, int f);

/* What pairs of fluid f rub by, Pa s: its viscosity now, or the method's numerical one where that is more. */
double step_viscosity(const WorldDef *def, const StepFriction *friction, int f);

/* The longest step that friction stands on the lattice at rest, s: what is longer makes differences of
   velocity grow. With the def's present viscosities; of a pair of fluids half of pair_viscosity counts, over
   the lighter one's density. INFINITY without friction. */
double step_viscous(const WorldDef *def, const StepFriction *friction);

/* The longest step that sound stands, in h / c: 2 / omega of its stiffest wave on the lattice, 2.0 to 2.6 c /
   h by kernel and support. Of summed density, which damps nothing, longer ones than STEP_SOUND_CALM heat
   fluid that has no friction: docs/failures.md. */
#define STEP_SOUND_STANDS 0.9
#define STEP_SOUND_CALM   0.5

/* The longest step that the pressure of fluid at rest stands, s, of a method without sound that does not
   leap: multipliers are those of the step's middle, and with p / rho = g times depth behind them places boil
   from 0.3 h / sqrt(g depth) in 3D on (0.43 in 2D), at any tolerance; later where implicit friction damps it.
   Depth is the greatest fall. INFINITY of other methods. */
double step_pressure(const WorldDef *def);
#define STEP_PRESSURE_STANDS 0.25

/* The longest step that follows surface tension, s: J. U. Brackbill, D. B. Kothe, C. Zemach, "A continuum
   method for modeling surface tension", 1992, eq. 61, of the fluid that binds it most; a wave of two spacings
   stands 1.8 times as much, and a drop with cohesion without sound 1.3 to 2.7. INFINITY without tension. */
double step_tension(const WorldDef *def);
#define STEP_TENSION_STANDS 0.5

/* So much of it stands a fluid that is out of order; measured: 0.8 to 1.1, with density carried in 3D at
   supports below 3, stirred hard, 0.6 (docs/failures.md). */
#define STEP_VISCOUS_STANDS 0.7

/* What binds a step of `dt` s in which a world blew up, at the greatest speed before (m/s), and what to
   change: words for an error. */
void step_advice(const WorldDef *def, const StepFriction *friction, StepTrouble trouble, double dt,
                 double max_speed, char words[200]);

/* The adaptive step (mode cfl; Monaghan, "Smoothed particle hydrodynamics", 1992, eq. 10.1 f.): the least of
   its limits at the speed and acceleration of the step before, never much longer than that one (`before`, s;
   0: there was none), so that what a blow frees has time to show. */
double step_cfl(const WorldDef *def, const StepFriction *friction, double max_speed, double max_acceleration,
                double before, StepLimit *binding);

/* The step of at most `dt` that reaches what is `left` (s) in whole steps, once it is four or fewer: all of
   one length, so that the last one is no sliver after which steps would have to grow again. `dt` where it is
   further or behind. */
double step_towards(double dt, double left);

#endif
