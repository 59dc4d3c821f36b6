/* Mismatched settings under wcsph: a kernel and its support, an artificial viscosity below the fluid's
   viscosity. */
#include "sim/wcsph/wcsph.h"
#include "sim/world/step_control.h"

#include <math.h>
#include <stdio.h>

/* Measured with sound at 20 m/s, alpha 0.05: docs/methods.md. */
static void advise_kernel(const MethodAdvice *advice)
{
    static const double pairs_from = 2.6, wants = 2.5;
    const WorldDef *def = advice->def;
    const Kernel *kernel = shape_kernel_find(wcsph_def(def)->kernel);
    const bool cubic = kernel == &shape_kernels[KERNEL_CUBIC];
    Lattice lattice;
    lattice_calibrate(def->dimensions, def->spacing, def->support * def->spacing, kernel, kernel, &lattice);
    if (cubic && def->support >= pairs_from)
        method_say(
            advice, "solver.kernel",
            "cubic lets particles pair at a support of %g: nearer than 0.3 spacings stood 2 %% after a dam "
            "break at 2.6, half of a tank at rest at 3; use wendland_c2 with a support of 3 or more",
            def->support);
    else if (!cubic && def->support < wants)
        method_say(
            advice, "particles.support",
            "%g is little for %s, which sums over %d neighbours then and wants a support of 3 or more; with "
            "less use kernel cubic",
            def->support, kernel->name, lattice.neighbours);
}

/* Warns if the scene set an alpha, and each fluid has more friction than the equivalent of alpha. */
static void advise_artificial(const MethodAdvice *advice)
{
    const WorldDef *def = advice->def;
    const WcsphDef *usual = method_wcsph.def;
    const double alpha = wcsph_def(def)->artificial_viscosity;
    double thinnest = INFINITY, left = 0;
    for (int f = 0; f < def->fluid_count; f++) {
        thinnest = fmin(thinnest, def->fluids[f].density);
        left = fmax(left, step_alpha(def, alpha, f));
    }
    if (alpha == 0 || left > 0 || alpha == usual->artificial_viscosity ||
        !advice->chosen(advice->to, "solver.artificial_viscosity"))
        return;
    method_say(
        advice, "solver.artificial_viscosity",
        "solver.artificial_viscosity %g adds nothing: it stands for %.3g Pa s, and each fluid has more; leave "
        "it out, or lower fluids[0].viscosity",
        alpha, numerical_kinematic(def, alpha) * thinnest);
}

void wcsph_advise(const MethodAdvice *advice)
{
    advise_kernel(advice);
    advise_artificial(advice);
}
