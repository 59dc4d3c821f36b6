#include "sim/incompressible/solid_force.h"

#include "sim/incompressible/constants.h"

static float slope(const SolidPair *pair, double scale)
{
    return cpu_slope(&shape_kernels[INCOMPRESSIBLE_KERNEL], pair, scale);
}

void incompressible_push(const SolidPair *pair, float k, float force[3])
{
    const float push = k * slope(pair, pair->cpu->constants->lattice.density_scale);
    for (int axis = 0; axis < 3; axis++)
        force[axis] = push * pair->d[axis];
}

void incompressible_rub(const SolidPair *pair, const float u[3], float force[3])
{
    const Constants *s = pair->cpu->constants;
    const float *volume = pair->cpu->now.volume;
    const float drag = s->rubs ? slope(pair, s->lattice.gradient_scale) * volume[pair->i] * volume[pair->b] *
                                     cpu_pair_viscosity(pair)
                               : 0;
    for (int axis = 0; axis < 3; axis++)
        force[axis] = drag * u[axis];
}
