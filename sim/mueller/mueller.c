/* after: M. Müller, D. Charypar, M. Gross, "Particle-based fluid simulation for interactive applications",
 * 2003 */
#include "sim/mueller/mueller.h"

#include "sim/base/key_rows.h"
#include "sim/matter/viscosity.h"
#include "sim/mueller/passes.h"
#include "sim/world/substep.h"

#include <math.h>
#include <string.h>

static const MuellerDef usual = {
    .density_kernel = "spiky", /* the paper's poly6 heats the fluid: see docs/methods.md */
};

static const Key keys[] = {
    CHOICE_OF("solver.density_kernel", 0, density_kernels, offsetof(MuellerDef, density_kernel),
              "the kernel that density is summed by"),
    NUMBER("solver.numerical_viscosity", 0, "", 0, 1, offsetof(MuellerDef, numerical_viscosity),
           "alpha; fluid rubs as if it had alpha c h / (4 (d + 2)) m2/s at least; 0: none", .off = "0"),
    KEYS_END,
};

static MethodKernels mueller_kernels(const WorldDef *def)
{
    return (MethodKernels){density_kernel_find(mueller_def(def)->density_kernel),
                           density_kernel_find("spiky")};
}

static void mueller_set(Constants *constants, const WorldDef *def)
{
    const MuellerConstants own = {
        .poly6 = mueller_kernels(def).density->value == kernel_poly6,
        .lift = wall_lift_of(&constants->lattice, def->spacing, def->support * def->spacing)};
    memcpy(constants->of_method, &own, sizeof own);
}

static bool sums_poly6(const Constants *constants)
{
    return mueller_constants(constants)->poly6;
}

static const ShaderTerm terms[] = {{"POLY6", sums_poly6}, {0}};

static StepFriction mueller_friction(const WorldDef *def, const Lattice *lattice)
{
    return (StepFriction){.laminar = friction_rate(lattice, def->spacing, FRICTION_LAPLACIAN,
                                                   def->support * def->spacing, mueller_kernels(def).density),
                          .numerical = mueller_def(def)->numerical_viscosity};
}

static float mueller_pressure(const Constants *constants, int fluid, float x)
{
    return mueller_state(constants, fluid, x / constants->stiffness_scale);
}

/* For p = c^2 (rho - rho0); accurate for small x. */
static double mueller_energy(double x)
{
    return log1p(x) - x / (1 + x);
}

/* Symplectic Euler with the drift in two halves around the kick (position Verlet): same single evaluation
   of forces and same stability, but second order, and exact for free flight under gravity. */
static void mueller_substep(const Substep *step)
{
    const Backend *b = step->backend;
    void *state = step->state;

    STAGE (step->clock, STAGE_INTEGRATE)
        b->drift(state, &step->first_half);
    STAGE (step->clock, STAGE_GRID)
        b->grid(state);
    STAGE (step->clock, STAGE_DENSITY)
        substep_run(step, &mueller_densities, step->dt);
    STAGE (step->clock, STAGE_FORCE)
        substep_run(step, &mueller_forces, step->dt);
    substep_terms(step);
    STAGE (step->clock, STAGE_INTEGRATE) {
        substep_kick(step);
        b->drift(state, &step->second_half);
    }
}

static const Pass *const passes[] = {&mueller_densities, &mueller_forces, NULL};

const Method method_mueller = {
    .name = "mueller",
    .help =
        "Müller 2003: density by summation, p = c^2 (rho - rho0); symplectic Euler; for looks: its pressure is "
        "noise",
    .keys = keys,
    .def = &usual,
    .def_size = sizeof usual,
    .kernels = mueller_kernels,
    .friction = mueller_friction,
    .pressure = mueller_pressure,
    .energy = mueller_energy,
    .energy_shader = "mueller/energy",
    .constants = mueller_set,
    .advise = mueller_advise,
    .columns = mueller_columns,
    .passes = passes,
    .terms = terms,
    .settle = &mueller_densities,
    .substep = mueller_substep,
};
