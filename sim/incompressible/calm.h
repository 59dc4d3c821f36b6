/* Tolerance of a step of an incompressible method in calm fluid. */
#ifndef SLOSH_INCOMPRESSIBLE_CALM_H
#define SLOSH_INCOMPRESSIBLE_CALM_H

#include "sim/world/substep.h"

/* A solver's residual e causes noise of pressure, rho (h / dt)^2 e. Pressure itself changes from particle to
   particle by rho h times the acceleration of fluid, g or v^2 / h. So steps of calm fluid leave less than
   `allowed`: the residual with noise equal to `part` of that change, but at least 1e-6, for single precision.
   A smaller residual means less boiling. `dt`: the step, s. Without gravity the result is `allowed`. */
double incompressible_calm(const Substep *step, double dt, double part, double allowed);

#endif
