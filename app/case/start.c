#include "app/case/start.h"

#include <math.h>

static double surface_of(const WorldDef *def, const CaseStart *start)
{
    double top = 0;
    for (size_t i = 0; i < start->count; i++)
        top = fmax(top, start->position[3 * i + 1]);
    return top + 0.5 * def->spacing;
}

/* phi = -(height g / omega) cosh(k y) / cosh(k H) cos(k (x + L / 2)), k = pi / L; Lamb, Hydrodynamics, 228.
 */
void start_wave(const WorldDef *def, CaseStart *start, double height)
{
    const Fill *fill = &def->fluids[0].fills[0];
    const double g = -def->gravity[1], length = fill->max[0] - fill->min[0], k = M_PI / length;
    const double surface = surface_of(def, start), omega = sqrt(g * k * tanh(k * surface));
    const double scale = height * g / omega * k / cosh(k * surface);
    for (size_t i = 0; i < start->count; i++) {
        const double x = k * (start->position[3 * i] + 0.5 * length), y = k * start->position[3 * i + 1];
        start->velocity[3 * i] = (float)(scale * cosh(y) * sin(x));
        start->velocity[3 * i + 1] = (float)(-scale * sinh(y) * cos(x));
    }
}
