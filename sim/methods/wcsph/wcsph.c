#include "sim/base/key_rows.h"
#include "sim/def/fluids.h"
#include "sim/methods/wcsph/wcsph_private.h"
#include "sim/step/constants.h"
#include "sim/step/substep.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Mismatched settings under wcsph: a kernel and its support, an artificial viscosity below the fluid's
   viscosity. */

/* Measured with sound at 20 m/s, alpha 0.05: docs/labbook/methods.md. */
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

/* Warns about mismatched settings under wcsph. */
static void wcsph_advise(const MethodAdvice *advice)
{
    advise_kernel(advice);
    advise_artificial(advice);
}

/* after: J. J. Monaghan, "Simulating free surface flows with SPH", 1994 */

#define AT(field) offsetof(WcsphDef, field)

static const WcsphDef usual = {
    .kernel = "cubic",
    .artificial_viscosity = 0.05, /* damps noise from the walls' lattice; half the value that breaks waves */
};

/* clang-format off */
static const Key keys[] = {
    CHOICE_OF("solver.kernel", 0, shape_kernels, AT(kernel), "its kernel"),
    NUMBER("solver.artificial_viscosity", 0, "", 0, 1, AT(artificial_viscosity),
           "alpha, of which a fluid has what its viscosity leaves of alpha c h / (4 (d + 2)) m2/s; 0: none", .off = "0"),
    CHOICE_OF("solver.viscosity_form", KEY_INDEX, viscosity_kinds, AT(viscosity_form),
           "what friction by a fluid's viscosity acts along; radial: right at free surfaces, for half the step"),
    NUMBER("solver.delta_sph", 0, "", 0, 0.5, AT(delta_sph), "diffusion of density, 0.1 as a rule; 0: none", .off = "0"),
    NUMBER("solver.shifting", 0, "", 0, 1, AT(shifting),
           "keeps particles evenly spread, for flows that would line them up, 0.2 as a rule; 0: none", .off = "0"),
    BOOLEAN("solver.corrected_gradient", 0, AT(corrected_gradient),
            "gradients exact for linear fields, at surfaces too: for flows that their noise would brake", .off = "false"),
    KEYS_END,
};
/* clang-format on */

static bool wcsph_check(const WorldDef *def, Error *error)
{
    const WcsphDef *own = wcsph_def(def);
    if (own->viscosity_form != VISCOSITY_MORRIS && own->viscosity_form != VISCOSITY_RADIAL)
        return error_set(error, "the form of viscosity is morris or radial");
    return (own->shifting >= 0 && own->shifting <= 1) || error_set(error, "shifting is 0 to 1");
}

static MethodKernels wcsph_kernels_of(const WorldDef *def)
{
    const Kernel *kernel = shape_kernel_find(wcsph_def(def)->kernel);
    return (MethodKernels){kernel, kernel};
}

static StepFriction wcsph_friction(const WorldDef *def, const Lattice *lattice)
{
    const WcsphDef *own = wcsph_def(def);
    const double h = def->support * def->spacing;
    const Friction form = own->viscosity_form == VISCOSITY_RADIAL ? FRICTION_RADIAL : FRICTION_MORRIS;
    StepFriction friction = {.laminar = friction_rate(lattice, def->spacing, form, h, NULL),
                             .alpha = own->artificial_viscosity,
                             .walls = form == FRICTION_RADIAL ? DRAG_RADIAL : DRAG_MORRIS};
    if (own->artificial_viscosity > 0)
        friction.artificial = friction_rate(lattice, def->spacing, FRICTION_ARTIFICIAL, h, NULL);
    return friction;
}

/* gradient_scale: -W'(r) / r divided by f(q) = -w'(q) / q, at a radius with known f. */
static void kernel_set(WcsphBlock *own, const Constants *constants, const WorldDef *def)
{
    static const double f_half[] = {[KERNEL_CUBIC] = 3,
                                    [KERNEL_WENDLAND_C2] = 2.5,
                                    [KERNEL_QUINTIC] = (1.5 * 1.5 * 1.5 * 1.5 - 6 * 0.0625) / 0.5};
    const Kernel *kernel = wcsph_kernels_of(def).density;
    const Lattice *lattice = &constants->lattice;
    const double h = def->support * def->spacing, r = 0.5 * h,
                 scale = lattice->gradient_scale * constants->unit_volume;
    own->kernel_shape = (int)(kernel - shape_kernels);
    if (wcsph_def(def)->viscosity_form == VISCOSITY_RADIAL)
        own->radial_friction = (float)lattice->radial_scale;
    own->gradient_scale = (float)(-kernel->derivative(r, h) / r * scale / f_half[own->kernel_shape]);
}

static void wcsph_set(Constants *constants, const WorldDef *def)
{
    const WcsphDef *said = wcsph_def(def);
    const float times = said->shifting == 0        ? DIFFUSION_RETURN
                        : said->corrected_gradient ? SHIFT_RETURN_CORRECTED
                                                   : SHIFT_RETURN;
    const float crossings = constants->sound_speed / constants->support_radius;
    WcsphBlock own = {.density_return = crossings / times,
                      .inverse_sound2 = 1 / (constants->sound_speed * constants->sound_speed),
                      .boundary_fades = crossings / BOUNDARY_FADES};
    const double reach = 0.5 * def->support * def->spacing, c = def->sound_speed;
    kernel_set(&own, constants, def);
    own.diffusion = (float)(2 * said->delta_sph * c * reach);
    own.corrected_gradient = said->corrected_gradient;
    own.shift_speed = (float)(said->shifting * c * reach);
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        const double alpha = step_alpha(def, said->artificial_viscosity, f);
        own.wcsph_fluids[f] = (WcsphFluid){(float)(fluid->density * c * c / 7),
                                           (float)(0.5 * alpha * c * reach * fluid->density)};
        own.any_artificial |= alpha > 0;
    }
    _Static_assert(sizeof own <= METHOD_CONSTANTS_SIZE, "constants hold it");
    memcpy(constants->of_method, &own, sizeof own);
}

/* For p = rho0 c^2 / 7 ((rho / rho0)^7 - 1); accurate for small x. */
static double wcsph_energy(double x)
{
    return x * x * (5.0 / 2 + x * (10.0 / 3 + x * (5.0 / 2 + x * (1 + x / 6))) + 1 / (1 + x)) / 7;
}

/* The rate of density at the present positions and velocities, and half a step of density. */
static void continuity(const Substep *step)
{
    if (wcsph_diffuses(step->constants))
        substep_run(step, &wcsph_gradient, 0);
    substep_run(step, &wcsph_continuity, 0.5 * step->dt);
}

/* The pass of the shift also relaxes density; without a shift speed nothing moves. */
static void shift(const Substep *step)
{
    if (wcsph_carries(step->constants))
        substep_run(step, &wcsph_carry, 0);
    substep_run(step, &wcsph_shift, step->dt);
}

/* Normals of the surfaces, and bodies of connected fluid. */
static void surface(const Substep *step)
{
    substep_run(step, &wcsph_drops, step->dt);
    substep_run(step, &wcsph_surface, step->dt);
}

static void forces(const Substep *step)
{
    substep_run(step, &wcsph_forces, step->dt);
    if (wcsph_curves(step->constants))
        substep_run(step, &wcsph_balance, step->dt);
}

/* Leapfrog as the symmetric composition continuity, drift, kick, drift, continuity (half steps except for
   the kick). Each part is exact while the rest is frozen, so the step is of second order, is reversible
   except for viscosity, and needs a single grid. The rate at the end of a step is also the rate at the
   begin of the next step. It is summed once, over the neighbours of half a drift ago, since particles that
   came nearer than h meanwhile have almost no weight. */
static void wcsph_substep(const Substep *step)
{
    const Backend *b = step->backend;
    void *state = step->state;

    STAGE (step->clock, STAGE_INTEGRATE)
        b->drift(state, &step->first_half);
    STAGE (step->clock, STAGE_GRID)
        b->grid(state);
    STAGE (step->clock, STAGE_DENSITY)
        substep_run(step, &wcsph_state, 0.5 * step->dt);
    if (wcsph_curves(step->constants))
        STAGE (step->clock, STAGE_FORCE)
            surface(step);
    if (wcsph_corrects(step->constants))
        STAGE (step->clock, STAGE_DENSITY)
            substep_run(step, &wcsph_correct, 0);
    STAGE (step->clock, STAGE_FORCE)
        forces(step);
    substep_terms(step);
    STAGE (step->clock, STAGE_INTEGRATE)
        substep_kick(step);
    if (wcsph_returns(step->constants))
        STAGE (step->clock, STAGE_FORCE)
            shift(step);
    STAGE (step->clock, STAGE_INTEGRATE)
        b->drift(state, &step->second_half);
    STAGE (step->clock, STAGE_DENSITY)
        continuity(step);
}

static const Pass *const passes[] = {
    &wcsph_state, &wcsph_drops, &wcsph_surface,  &wcsph_correct,    &wcsph_forces, &wcsph_balance,
    &wcsph_carry, &wcsph_shift, &wcsph_gradient, &wcsph_continuity, NULL};
static const Pass *const start[] = {&wcsph_correct, &wcsph_gradient, &wcsph_continuity, NULL};

static bool is_radial(const Constants *constants)
{
    return wcsph_constants(constants)->radial_friction > 0;
}

static bool has_wendland_c2(const Constants *constants)
{
    return wcsph_constants(constants)->kernel_shape == KERNEL_WENDLAND_C2;
}

static bool has_quintic(const Constants *constants)
{
    return wcsph_constants(constants)->kernel_shape == KERNEL_QUINTIC;
}

static const ShaderTerm terms[] = {{"KERNEL_WENDLAND_C2", has_wendland_c2},
                                   {"KERNEL_QUINTIC", has_quintic},
                                   {"RADIAL", is_radial},
                                   {"ARTIFICIAL", wcsph_is_artificial},
                                   {"DIFFUSION", wcsph_diffuses},
                                   {"SHIFTING", wcsph_returns},
                                   {"CORRECTED", wcsph_corrects},
                                   {"CURVATURE", wcsph_curves},
                                   {"LAYERS", wcsph_layers},
                                   {0}};

/* See slope.comp, evenness.glsl, correction.glsl, surface.glsl and drops.glsl. */
static const ShaderBuffer buffers[] = {{"Slopes", 16, wcsph_diffuses},      {"Unevens", 32, wcsph_returns},
                                       {"Corrections", 32, wcsph_corrects}, {"Outwards", 16, wcsph_curves},
                                       {"Drops", 32, wcsph_curves},         {0}};

const Method method_wcsph = {
    .name = "wcsph",
    .help = "Monaghan 1994: density by continuity, Tait's equation of state; leapfrog",
    .keys = keys,
    .def = &usual,
    .def_size = sizeof usual,
    .carries_density = true,
    .curvature = true,
    .check = wcsph_check,
    .kernels = wcsph_kernels_of,
    .friction = wcsph_friction,
    .pressure = wcsph_state_of,
    .energy = wcsph_energy,
    .energy_shader = "wcsph/energy",
    .constants = wcsph_set,
    .advise = wcsph_advise,
    .columns = wcsph_columns,
    .passes = passes,
    .terms = terms,
    .buffers = buffers,
    .settle = &wcsph_state,
    .start = start,
    .substep = wcsph_substep,
};
