/* What a method says of a step that whoever reads or bounds steps wants to know: its friction, its solvers.
 */
#ifndef SLOSH_STEP_PARTS_H
#define SLOSH_STEP_PARTS_H

#include "sim/box/wall_drag.h"

/* The rate of friction (sim/matter/viscosity.h) for a def's method, kernel, support and dimensions, 1/m2. */
typedef struct StepFriction {
    double laminar, artificial; /* the latter 0 where the def has none */
    double alpha;               /* of the artificial viscosity */
    double numerical;           /* alpha of the viscosity that pairs of fluid have at least */
    DragWeight walls;           /* how walls that hold fluid weigh theirs */
} StepFriction;

/* The solvers of a step, by number: those of the method, then implicit viscosity. */
enum { SOLVES_OF_METHOD = 2, SOLVE_VISCOSITY = SOLVES_OF_METHOD, SOLVES_MAX };

/* A solver of a method that iterates, if it has any (sim/world/iterate.h). */
typedef struct MethodSolver {
    const char *name;                   /* for words: "density"; NULL: there is none of this number */
    const char *tolerance, *iterations; /* the paths of its keys */
} MethodSolver;

#endif
