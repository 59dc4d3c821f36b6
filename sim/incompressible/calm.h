/* How little of its residual a step of an incompressible method may leave. */
#ifndef SLOSH_INCOMPRESSIBLE_CALM_H
#define SLOSH_INCOMPRESSIBLE_CALM_H

#include "sim/world/substep.h"

/* What a solver leaves of its residual turns up as noise of pressure, rho (h / dt)^2 times it; pressure
   itself goes from particle to particle by rho h times what accelerates fluid, g or v^2 / h. So steps of calm
   fluid leave less than what is `allowed`: `part` of the one, no less than what single precision has. What
   leaves less boils less. Of a step of `dt` s. */
double incompressible_calm(const Substep *step, double dt, double part, double allowed);

#endif
