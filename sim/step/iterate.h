/* The loop of an iterating solver: passes until the residual is small enough. */
#ifndef SIM_STEP_ITERATE_H
#define SIM_STEP_ITERATE_H

#include "sim/step/substep.h"

/* Plain data, without calls of the method between passes: a backend with costly read-backs takes the same
   decisions on the device (Backend.iterate). */
enum { ITERATION_ASKED = 2 };
typedef struct Iteration {
    const Pass *passes[4];     /* of an iteration, ended by NULL; the last pass measures */
    const ColumnDef *residual; /* only positive values count */
    double tolerance;          /* for the mean residual */
    double worst;              /* if a particle exceeds `worst`, */
    int few;                   /* at least `few` iterations run */
    int most;                  /* iterations */
    bool begun;                /* the residual is known before the first iteration: possibly no iteration
                                  runs */
    /* Further columns for the caller, ended by NULL: their excess after the last iteration goes to `to`. A
       separate query would make a GPU's step wait again. */
    struct {
        const ColumnDef *column;
        Excess *to;
    } asked[ITERATION_ASKED];
    const ColumnDef *scale; /* the residual is measured in units of this column's mean before the first
                               iteration; NULL: 1 */
    /* For conjugate gradients, whose passes read PassInput.go and .turn: each particle's part of (residual
       . direction), and of (direction . matrix times direction). NULL: none. */
    const ColumnDef *power, *curvature;
} Iteration;

/* Runs the passes over `dt` (s), at least once unless `begun`, and writes the result to
   step->solves[which]. */
void substep_iterate(const Substep *step, const Iteration *iteration, int which, double dt);

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
