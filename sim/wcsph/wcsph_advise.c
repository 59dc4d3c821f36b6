/* What of a scene does not go together under wcsph: a kernel and its support, a viscosity in place of the
   artificial one. */
#include "sim/wcsph/wcsph.h"
#include "sim/world/step_control.h"

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

/* Whether the scene chose an alpha, though each of its fluids has a viscosity, which takes the place of
 * alpha. */
static bool alpha_in_vain(const MethodAdvice *advice)
{
    const WorldDef *def = advice->def;
    const WcsphDef *usual = method_wcsph.def;
    bool in_vain = wcsph_def(def)->artificial_viscosity != usual->artificial_viscosity &&
                   advice->chosen(advice->to, "solver.artificial_viscosity");
    for (int f = 0; f < def->fluid_count; f++)
        in_vain = in_vain && fluid_viscosity_most(&def->fluids[f]) > 0;
    return in_vain;
}

/* Says where a viscosity gives less than half the friction of alpha, or alpha was chosen in vain. */
static void advise_artificial(const MethodAdvice *advice)
{
    const WorldDef *def = advice->def;
    const double alpha = wcsph_def(def)->artificial_viscosity;
    if (alpha == 0)
        return;
    const bool in_vain = alpha_in_vain(advice);
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        const double most = fluid_viscosity_most(fluid),
                     same = artificial_kinematic(def, alpha) * fluid->density;
        char path[64];
        snprintf(path, sizeof path, "fluids[%d].viscosity", f);
        if (most > 0 && (most < 0.5 * same || in_vain))
            method_say(
                advice, path,
                "%g Pa s takes the place of solver.artificial_viscosity %g, which is some %.3g Pa s at this "
                "spacing; leave %s out, or make the latter 0",
                most, alpha, same, in_vain ? "one of them" : "the viscosity");
    }
}

void wcsph_advise(const MethodAdvice *advice)
{
    advise_kernel(advice);
    advise_artificial(advice);
}
