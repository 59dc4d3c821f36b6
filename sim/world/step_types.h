/* Bounds, state and troubles of a step, and its solvers: what callers of a world read of steps. */
#ifndef SLOSH_STEP_TYPES_H
#define SLOSH_STEP_TYPES_H

#include <stdbool.h>
#include <stddef.h>

/* Number of columns that a method may own (sim/world/column.h). */
enum { COLUMNS_OWN = 44 };

/* X(ENUM, name, help): bounds of a step */
#define STEP_LIMITS(X)                                                                                       \
    X(DT, "dt", "the scene's fixed step")                                                                    \
    X(COURANT, "courant", "number h / (c + greatest speed)")                                                 \
    X(FORCE, "force", "number sqrt(h / greatest acceleration); without sound sqrt(number h / it)")           \
    X(VISCOUS, "viscous", "2 number, at most 0.7, of the longest step that friction stands")                 \
    X(MAX_DT, "max_dt", "the scene's greatest step")                                                         \
    X(GROWTH, "growth", "a tenth more than the step before")                                                 \
    X(PRESSURE, "pressure",                                                                                  \
      "without sound: 0.25 h / sqrt(gravity times depth); in leaps sqrt(0.4 spacing / gravity)")             \
    X(TENSION, "tension", "half of sqrt(density spacing^3 / (2 pi surface tension))")

typedef enum StepLimit {
#define X(NAME, name, help) STEP_LIMIT_##NAME,
    STEP_LIMITS(X)
#undef X
        STEP_LIMIT_COUNT
} StepLimit;

const char *step_limit_name(StepLimit limit);

/* Solvers of a step by number: the method's solvers, then implicit viscosity. */
enum { SOLVES_OF_METHOD = 2, SOLVE_VISCOSITY = SOLVES_OF_METHOD, SOLVES_MAX };

/* An iterating solver of a method (sim/world/iterate.h). */
typedef struct MethodSolver {
    const char *name;                   /* for messages: "density"; NULL: no solver with this number */
    const char *tolerance, *iterations; /* paths of the solver's keys */
} MethodSolver;

/* Step state of a world. Doubles only: part of the saved state. */
typedef struct StepState {
    double dt;               /* of the current or last step, s */
    double wanted;           /* dt before division by `refine` and before fitting to a frame's end, s */
    double limit;            /* a StepLimit: the bound of the step */
    double max_speed;        /* m/s, after the last step */
    double max_acceleration; /* m/s2, in the last step */
    double frame_left;       /* steps to the end of the frame; -1: the frame begins again */
    double refine;           /* 1, 2, 4, ...: divisor of the step after trouble */
    double tries;            /* halvings not yet taken back */
    double calm;             /* steps since the last trouble or relief */
} StepState;

/* Result of an iterating solver in a step. */
typedef struct StepSolve {
    double iterations; /* 0: did not run */
    double mean, most; /* residual left, as measured by the solver: mean over all particles, maximum */
    double tolerance;  /* for the mean */
    bool failed;       /* ended far above the tolerance */
} StepSolve;

/* X(ENUM, words): trouble found by the sentinel */
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

#endif
