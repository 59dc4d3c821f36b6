#include "app/case/start.h"

#include "sim/world/method.h"

#include <math.h>
#include <string.h>

static double surface_of(const WorldDef *def, const CaseStart *start)
{
    double top = 0;
    for (size_t i = 0; i < start->count; i++)
        top = fmax(top, start->position[3 * i + 1]);
    return top + 0.5 * def->spacing;
}

/* With p = rho0 g (H - y) over the height y that a layer had in the lattice, r = rho / rho0 and y' the
   integral of 1 / r from the floor on. wcsph: r = (1 + a (H - y))^(1/7), a = 7 g / c^2; mueller:
   r = 1 + b (H - y), b = g / c^2. */
void start_hydrostatic(const WorldDef *def, CaseStart *start)
{
    if (method_find(def->method)->incompressible)
        return;
    const double surface = surface_of(def, start), c2 = def->sound_speed * def->sound_speed;
    const double b = -def->gravity[1] / c2, a = 7 * b, rest = def->fluids[0].density;
    const bool tait = strcmp(def->method, "wcsph") == 0;
    for (size_t i = 0; i < start->count; i++) {
        const double depth = surface - start->position[3 * i + 1];
        if (tait) {
            const double all = pow(1 + a * surface, 6.0 / 7), above = pow(1 + a * depth, 6.0 / 7);
            start->position[3 * i + 1] = (float)((all - above) / (6 * b));
            start->density[i] = (float)(rest * pow(1 + a * depth, 1.0 / 7));
        } else {
            start->position[3 * i + 1] = (float)(log((1 + b * surface) / (1 + b * depth)) / b);
            start->density[i] = (float)(rest * (1 + b * depth));
        }
    }
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
