/* Properties of a method's step for callers that read or bound steps: friction and solvers. */
#ifndef SLOSH_STEP_PARTS_H
#define SLOSH_STEP_PARTS_H

#include "sim/box/wall_drag.h"

/* Rate of friction (sim/matter/viscosity.h) for a def's method, kernel, support and dimensions, 1/m2. */
typedef struct StepFriction {
    double laminar, artificial; /* artificial: 0 if not in the def */
    double alpha;               /* of the artificial viscosity */
    double numerical;           /* alpha of the least viscosity between pairs of fluid */
    DragWeight walls;           /* weights of the friction at no-slip walls */
} StepFriction;

/* Solvers of a step by number: the method's solvers, then implicit viscosity. */
enum { SOLVES_OF_METHOD = 2, SOLVE_VISCOSITY = SOLVES_OF_METHOD, SOLVES_MAX };

/* An iterating solver of a method (sim/world/iterate.h). */
typedef struct MethodSolver {
    const char *name;                   /* for messages: "density"; NULL: no solver with this number */
    const char *tolerance, *iterations; /* paths of the solver's keys */
} MethodSolver;

#endif
