/* The loop of a solver that iterates: passes until what is left of its residual is little enough. */
#ifndef SLOSH_ITERATE_H
#define SLOSH_ITERATE_H

#include "sim/world/substep.h"

/* Data alone, no calls of the method between the passes: a backend for which a read-back in each iteration
   is dear takes the same decisions where its particles are (Backend.iterate). */
enum { ITERATION_ASKED = 2 };
typedef struct Iteration {
    const Pass *passes[4];     /* of an iteration, ended by NULL; the last one measures */
    const ColumnDef *residual; /* what is above 0 of it counts */
    double tolerance;          /* of its mean */
    double worst;              /* where a particle has more than that, */
    int few;                   /* there are so many iterations at least */
    int most;                  /* iterations */
    bool begun;                /* the residual is there before the first of them: none may be needed */
    /* What else the caller wants to know behind the last of them: of which columns the excess, ended by NULL,
       and where it goes. A question by itself would make a GPU's step wait once more. */
    struct {
        const ColumnDef *column;
        Excess *to;
    } asked[ITERATION_ASKED];
    const ColumnDef *scale; /* whose mean before the first of them the residual counts in; NULL: 1 */
    /* Of conjugate gradients, whose passes read PassInput.go and .turn: what each particle adds to the
       product of residual and direction, and to that of the direction and what it is multiplied to. NULL:
       none. */
    const ColumnDef *power, *curvature;
} Iteration;

/* Runs the passes over `dt` (s), once at least where the residual is not there yet, and says in
   step->solves[which] what came of it. */
void substep_iterate(const Substep *step, const Iteration *iteration, int which, double dt);

/* What the solvers of many steps did, in bounded memory. Zero-initialise it. */
enum { SOLVE_EXACT = 64, SOLVE_OCTAVE = 8, SOLVE_CLASSES = SOLVE_EXACT + 9 * SOLVE_OCTAVE };
typedef struct SolveTally {
    uint64_t steps, iterations;      /* iterations: of the method's solvers together */
    uint64_t most_iterations;        /* of a step */
    double mean, most;               /* residual of density: sum of the means; greatest */
    double rubbed, left;             /* of the solver of viscosity: its iterations, the sum of residuals */
    uint64_t classes[SOLVE_CLASSES]; /* steps by their iterations: one number each, then eight an octave */
} SolveTally;

/* Of a method that has solvers. */
void solve_tally_add(SolveTally *tally, const StepSolve solves[SOLVES_MAX]);

SolveFigures solve_tally_figures(const SolveTally *tally);

#endif
