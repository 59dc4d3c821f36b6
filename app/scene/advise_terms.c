/* Settings that do not go together: a kernel and its support, walls that hold what has no friction, a
   viscosity in place of the artificial one. */
#include "app/scene/advise_parts.h"
#include "app/scene/preset.h"
#include "sim/kernel/lattice.h"
#include "sim/world/step_control.h"

#include <string.h>

static bool is_wcsph(const WorldDef *def)
{
    return strcmp(def->method, "wcsph") == 0;
}

/* Measured with sound at 20 m/s, alpha 0.05: sim/README.md. */
void advise_kernel(const Tree *tree, const Scene *scene, Notes *notes)
{
    static const double pairs_from = 2.6, wants = 2.5;
    const WorldDef *def = &scene->world;
    if (!is_wcsph(def))
        return;
    const Kernel *kernel = wcsph_kernel_find(def->kernel);
    const bool cubic = kernel == &wcsph_kernels[KERNEL_CUBIC];
    Lattice lattice;
    lattice_calibrate(def->dimensions, def->spacing, def->support * def->spacing, kernel, kernel, &lattice);
    if (cubic && def->support >= pairs_from)
        advise(
            tree, "solver.kernel", notes,
            "cubic lets particles pair at a support of %g: nearer than 0.3 spacings stood 2 %% after a dam "
            "break at 2.6, half of a tank at rest at 3; use wendland_c2 with a support of 3 or more",
            def->support);
    else if (!cubic && def->support < wants)
        advise(
            tree, "particles.support", notes,
            "%g is little for %s, which sums over %d neighbours then and wants a support of 3 or more; with "
            "less use kernel cubic",
            def->support, kernel->name, lattice.neighbours);
}

static bool any_viscosity(const WorldDef *def)
{
    for (int f = 0; f < def->fluid_count; f++)
        if (fluid_viscosity_most(&def->fluids[f]) > 0)
            return true;
    return false;
}

void advise_slip(const Tree *tree, const Scene *scene, Notes *notes)
{
    static const char what[] =
        "slip none has no effect: only fluid with a viscosity is held; give fluids[0].viscosity a value";
    const WorldDef *def = &scene->world;
    if (any_viscosity(def))
        return;
    if (def->wall_slip == SLIP_NONE)
        advise(tree, "box.slip", notes, "%s", what);
    for (int k = 0; k < def->solid_count; k++) {
        char path[64];
        snprintf(path, sizeof path, "solids[%d].slip", k);
        if (def->solids[k].slip == SLIP_NONE)
            advise(tree, path, notes, "%s", what);
    }
}

/* Whether the scene chose an alpha, and has no fluid that it is for. */
static bool alpha_in_vain(const Scene *scene)
{
    const WorldDef *def = &scene->world, usual = world_def_default();
    bool in_vain = def->artificial_viscosity != usual.artificial_viscosity &&
                   !preset_gave(scene, "solver.artificial_viscosity");
    for (int f = 0; f < def->fluid_count; f++)
        in_vain = in_vain && fluid_viscosity_most(&def->fluids[f]) > 0;
    return in_vain;
}

/* Where that is half of the friction before, or less, or the other one was chosen. */
void advise_artificial(const Tree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *def = &scene->world;
    const double alpha = def->artificial_viscosity;
    if (!is_wcsph(def) || alpha == 0)
        return;
    const bool in_vain = alpha_in_vain(scene);
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        const double most = fluid_viscosity_most(fluid), same = artificial_kinematic(def) * fluid->density;
        char path[64];
        snprintf(path, sizeof path, "fluids[%d].viscosity", f);
        if (most > 0 && (most < 0.5 * same || in_vain))
            advise(
                tree, path, notes,
                "%g Pa s takes the place of solver.artificial_viscosity %g, which is some %.3g Pa s at this "
                "spacing; leave %s out, or make the latter 0",
                most, alpha, same, in_vain ? "one of them" : "the viscosity");
    }
}

/* Measured, 0.6 m of fluid, 2D: single particles at 4 m/s at 1 : 10, 15 at 33, 31 at 100, 88 at 1000,
 * whatever the step. */
void advise_ratio(const Tree *tree, const Scene *scene, Notes *notes)
{
    static const double most = 30;
    const double ratio = density_ratio(&scene->world);
    if (strcmp(scene->world.method, "mueller") == 0 && ratio > most)
        advise(
            tree, "solver.method", notes,
            "mueller throws single light particles up where densities differ by more than 1 : %g, here 1 : %.3g; "
            "use wcsph, or densities that are nearer",
            most, ratio);
}
