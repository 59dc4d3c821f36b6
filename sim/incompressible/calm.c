#include "sim/incompressible/calm.h"

#include <math.h>

double incompressible_calm(const Substep *step, double dt, double part, double allowed)
{
    static const double LEAST = 1e-6;
    const double h = (double)step->constants->support_radius, courant = step->speed * dt / h;
    const float *g = step->gravity;
    const double falls = dt * dt / h * sqrt((double)(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]));
    if (falls == 0)
        return allowed;
    return fmin(allowed, fmax(part * fmax(falls, courant * courant), LEAST));
}
