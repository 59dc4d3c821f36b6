#include "sim/matter/vortices.h"

#include <math.h>

double vortices_add(const WorldDef *def, const FluidDef *fluid, const float x[3], float v[3])
{
    const double u = fluid->taylor_green, kx = 2 * M_PI / def->box_size[0], ky = 2 * M_PI / def->box_size[1];
    const double a = kx * (double)x[0], b = ky * (double)x[1], ratio = kx / ky;
    v[0] += (float)(-u * cos(a) * sin(b));
    v[1] += (float)(u * ratio * sin(a) * cos(b));
    return -0.25 * fluid->density * u * u * (cos(2 * a) + ratio * ratio * cos(2 * b));
}

bool vortices_any(const WorldDef *def)
{
    bool any = false;
    for (int f = 0; f < def->fluid_count; f++)
        any |= def->fluids[f].taylor_green != 0;
    return any;
}
