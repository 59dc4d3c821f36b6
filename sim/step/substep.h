/* A method's substep: its data, and the loop of an iterating solver. */
#ifndef SIM_STEP_SUBSTEP_H
#define SIM_STEP_SUBSTEP_H

#include "sim/solids/solid.h"
#include "sim/step/backend.h"
#include "sim/world.h"

/* Data of a method's substep. */

/* Data of a substep, with the poses of the box at begin, middle and end. */
typedef struct Substep {
    const Backend *backend;
    void *state;
    const Constants *constants;
    StageClock *clock; /* may be NULL */
    double dt;         /* s */
    double speed;      /* greatest in the last step, m/s; on a GPU in the last frame */
    StepSolve *solves; /* by number, SOLVES_MAX entries: results of the step's solvers */
    BoxStep first_half, second_half;
    double *driven;  /* J: sum of the emitters' work */
    int guide_count; /* of active emitters */
    Guide guides[GUIDES_MAX];
    FingerStep finger;               /* the finger in the fluid */
    SolidStep solids[2][SOLIDS_MAX]; /* for both halves; first_half and second_half point here */
    Bodies *bodies;                  /* floating solids; NULL: none */
    ApparentGravity apparent;        /* at the middle */
    float gravity[3];                /* in the box's axes at the middle, m/s2 */
} Substep;

/* Input of passes over `dt` (s). */
static inline PassInput substep_input(const Substep *step, double dt)
{
    PassInput input = {.dt = (float)dt, .apparent = &step->apparent};
    for (int k = 0; k < 3; k++)
        input.gravity[k] = step->gravity[k];
    return input;
}

/* Runs a pass of the method over `dt` (s). */
static inline void substep_run(const Substep *step, const Pass *pass, double dt)
{
    const PassInput input = substep_input(step, dt);
    step->backend->run(step->state, pass, &input);
}

/* Runs the scene's shared terms before the kick, from the present velocities and accelerations. */
static inline void substep_terms(const Substep *step)
{
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->substep && (*term)->needed(step->constants))
            STAGE (step->clock, STAGE_SOLVE)
                (*term)->substep(step);
}

/* A step of the method, with the terms' begin and end. */
static inline void substep_whole(const Substep *step, void (*method)(const Substep *step))
{
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->begin && (*term)->needed(step->constants))
            (*term)->begin(step);
    method(step);
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->end && (*term)->needed(step->constants))
            (*term)->end(step);
}

/* Ends the bodies' last step with late forces. */
static inline void bodies_end_owed(Bodies *bodies, const Backend *backend, void *state)
{
    if (!bodies_owe_end(bodies))
        return;
    backend->forces_take(state);
    bodies_end(bodies);
}

/* The kick of a step, then the effects of finger, emitters and floating bodies. A method that leaps moves
   bodies no more in the step, and forces on bodies come at the step's end. */
static inline void substep_kick(const Substep *step)
{
    step->backend->kick(step->state, step->gravity, (float)step->dt);
    if (step->finger.on)
        step->backend->touch(step->state, &step->finger);
    if (step->guide_count > 0)
        *step->driven += step->backend->guide(step->state, step->guides, step->guide_count);
    if (!step->bodies || step->constants->method->leaps)
        return;
    if (step->backend->forces_send) {
        step->backend->forces_send(step->state);
        bodies_end_owed(step->bodies, step->backend, step->state);
        step->backend->forces_take(step->state);
    }
    bodies_kick(step->bodies);
}

/* The loop of an iterating solver: passes until the residual is small enough. */

/* Plain data, without calls of the method between passes: a backend with costly read-backs takes the same
   decisions on the device (Backend.iterate), and may report after the step (Backend.finish). */
typedef struct Iteration {
    const Pass *passes[4];     /* of an iteration, ended by NULL; the last pass measures */
    const Pass *coarse;        /* a correction of long waves, before a slow iteration; NULL: none */
    const ColumnDef *residual; /* only positive values count */
    double tolerance;          /* for the mean residual */
    double worst;              /* if a particle exceeds `worst`, */
    int few;                   /* at least `few` iterations run */
    int most;                  /* iterations */
    bool begun;                /* the residual is known before the first iteration: possibly no iteration
                                  runs */
    /* If the mean of column `way` is above `way_most` after the last iteration, `renew` runs and the
       iterations go on, at most `renewals` times. NULL: never. */
    const ColumnDef *way;
    double way_most;
    void (*renew)(const Substep *step);
    int renewals;
    /* The report: the residual over `unit` (0: 1), in trouble above STEP_SOLVE_STANDS times `allowed` (below
       0: never); without trouble the excess of `left` instead, unless NULL. */
    double unit, allowed;
    const ColumnDef *left;
    const ColumnDef *scale; /* the residual is measured in units of this column's mean before the first
                               iteration; NULL: 1 */
    /* For conjugate gradients, whose passes read PassInput.go and .turn: each particle's part of (residual
       . direction), and of (direction . matrix times direction). NULL: none. */
    const ColumnDef *power, *curvature;
} Iteration;

/* Results of the iterations. */
typedef struct IterationFound {
    double iterations, mean, most; /* residual */
    Excess way, left;
} IterationFound;

/* Runs the passes over `dt` (s), at least once unless `begun`, and reports to step->solves[which], possibly
   after the step. */
void substep_iterate(const Substep *step, const Iteration *iteration, int which, double dt);

/* Writes the report of a solver that has ended. */
void iteration_report(const Iteration *iteration, const IterationFound *found, StepSolve *solve);

/* Statistics of solvers over many steps, in bounded memory. Zero-initialise. */
enum { SOLVE_EXACT = 64, SOLVE_OCTAVE = 8, SOLVE_CLASSES = SOLVE_EXACT + 9 * SOLVE_OCTAVE };
typedef struct SolveTally {
    uint64_t steps, iterations;      /* iterations: all solvers of the method together */
    uint64_t most_iterations;        /* in a step */
    double mean, most;               /* residual of density: sum of means; maximum */
    double rubbed, left;             /* viscosity solver: iterations; sum of residuals */
    uint64_t classes[SOLVE_CLASSES]; /* steps by number of iterations: a class per number, then eight per
                                        octave */
} SolveTally;

/* Adds a step of a method with solvers. */
void solve_tally_add(SolveTally *tally, const StepSolve solves[SOLVES_MAX]);

SolveFigures solve_tally_figures(const SolveTally *tally);

#endif
