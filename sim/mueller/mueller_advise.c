/* Settings that fail under mueller: steps that heat fluid, high density ratios. */
#include "sim/mueller/mueller.h"
#include "sim/world/step_control.h"

#include <math.h>
#include <stdio.h>

static double substeps_for(const WorldDef *def, double step)
{
    return ceil(def->dt / step * (1 - 1e-9));
}

/* For fluid with almost no friction: a friction of a thousandth of the stable limit hides the heating, 5e-4
   per step at 0.65. */
static void advise_heat(const MethodAdvice *advice)
{
    const WorldDef *def = advice->def;
    const bool fixed = def->step_mode == STEP_FIXED;
    const double crossing = def->support * def->spacing / step_sound(def),
                 step = fixed ? def->dt / def->substeps : fmin(def->cfl_number * crossing, def->max_dt);
    if (step <= STEP_SOUND_CALM * crossing * (1 + 1e-9) || (fixed && step > STEP_SOUND_STANDS * crossing) ||
        step > 0.001 * step_viscous(def, advice->friction))
        return;
    const char *path = fixed ? "solver.step.dt" : "solver.step.number";
    char better[64];
    if (fixed)
        snprintf(better, sizeof better, "%g substeps or more", substeps_for(def, STEP_SOUND_CALM * crossing));
    else
        snprintf(better, sizeof better, "at most %g", STEP_SOUND_CALM);
    method_say(
        advice, path,
        "steps of %.2g h / sound_speed heat fluid that has no viscosity: 0.3 %% of a column's energy in 4,000 "
        "steps at 0.5, 2 %% at 0.6, 5 %% at 0.65; use %s, or a viscosity",
        step / crossing, better);
}

/* Measured with 0.6 m of fluid in 2D, for any step: single particles at 4 m/s at 1 : 10, 15 at 33, 31 at
   100, 88 at 1000. */
static void advise_ratio(const MethodAdvice *advice)
{
    static const double most = 30;
    const double ratio = density_ratio(advice->def);
    if (ratio > most)
        method_say(
            advice, "solver.method",
            "mueller throws single light particles up where densities differ by more than 1 : %g, here 1 : %.3g; "
            "use wcsph, or densities that are nearer",
            most, ratio);
}

void mueller_advise(const MethodAdvice *advice)
{
    advise_heat(advice);
    advise_ratio(advice);
}
