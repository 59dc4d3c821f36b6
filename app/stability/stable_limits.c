#include "app/stability/stable_limits.h"

#include "sim/kernel/sound_wave.h"
#include "sim/matter/fall.h"
#include "sim/world/method.h"
#include "sim/world/step_control.h"

#include <math.h>

static double stiffest(const WorldDef *def)
{
    const Method *method = method_find(def->method);
    const MethodKernels kernels = method_kernels(def);
    const double h = def->support * def->spacing;
    Lattice lattice;
    lattice_calibrate(def->dimensions, def->spacing, h, kernels.density, kernels.slope, &lattice);
    return sound_stiffest(&lattice, def->spacing, h, kernels.density, method->carries_density);
}

static double together(double sound, double friction)
{
    const double omega = 2 / sound, gamma = 2 / friction; /* 0 if the limit is infinite */
    if (omega == 0)
        return friction;
    return (sqrt(gamma * gamma + 4 * omega * omega) - gamma) / (omega * omega);
}

/* Greatest kinematic viscosity, m2/s; for fluids without viscosity the artificial viscosity. */
static double viscosity(const WorldDef *def, const StepFriction *friction)
{
    double most = 0;
    for (int f = 0; f < def->fluid_count; f++) {
        const double mu = fluid_viscosity_most(&def->fluids[f]);
        most = fmax(most, mu > 0                     ? mu / def->fluids[f].density
                          : friction->artificial > 0 ? artificial_kinematic(def, friction->alpha)
                                                     : 0);
    }
    return most;
}

void stable_limits(const WorldDef *def, StableLimits *limits)
{
    const StepFriction friction = step_friction(def);
    const double c = step_sound(def), *g = def->gravity, l = 0.5 * def->support * def->spacing,
                 pull = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    limits->sound = c > 0 ? 2 / (c * stiffest(def)) : (double)INFINITY;
    limits->friction = step_viscous(def, &friction);
    limits->lattice = together(limits->sound, limits->friction);
    limits->courant = c > 0 ? 0.4 * l / c : (double)INFINITY;
    limits->force = 0.25 * sqrt(l / pull); /* INFINITY without gravity */
    limits->viscous = 0.125 * l * l / viscosity(def, &friction);
}

double stable_guess(const WorldDef *def, const StableLimits *limits)
{
    const double h = def->support * def->spacing, *g = def->gravity;
    const double speed = sqrt(sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) * greatest_fall(def));
    if (isfinite(limits->sound))
        return limits->lattice;
    return fmin(STEP_PRESSURE_STANDS * h / (speed > 0 ? speed : 1), limits->lattice);
}
