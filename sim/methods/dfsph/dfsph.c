/* after: J. Bender, D. Koschier, "Divergence-free SPH for incompressible and viscous fluids", 2017 */
#include "sim/base/key_rows.h"
#include "sim/methods/dfsph/dfsph_private.h"
#include "sim/methods/shared/incompressible.h"
#include "sim/step/substep.h"

#include <math.h>
#include <string.h>

static const DfsphDef usual = {
    .tolerance = 0.0005, .divergence_tolerance = 0.0001, .iterations = 100, .coarse = true};

/* clang-format off */
static const Key keys[] = {
    NUMBER("solver.tolerance", 0, "", 0, 1, offsetof(DfsphDef, tolerance), "mean compression that the solver of density leaves"),
    NUMBER("solver.divergence_tolerance", 0, "", 0, 1, offsetof(DfsphDef, divergence_tolerance), "mean compression that a step's velocities may make"),
    INTEGER("solver.iterations", 0, 1, 10000, offsetof(DfsphDef, iterations), "of each solver, at most"),
    BOOLEAN("solver.coarse", 0, offsetof(DfsphDef, coarse),
            "a coarse grid corrects the pressure where iterations are slow, as in deep water; not beside solids"),
    NUMBER("solver.surface_lack", 0, "", 0, 1, offsetof(DfsphDef, surface_lack),
           "part of the neighbours missing at a free surface that the solvers add: 1, else a dense skin slows waves; 0: none", .off = "0"),
    NUMBER("solver.rest_viscosity", 0, "", 0, 1, offsetof(DfsphDef, rest_viscosity),
           "alpha; fluid rubs as if it had alpha h sqrt(g h) / (4 (d + 2)) m2/s at least; 0: none", .off = "0"),
    KEYS_END,
};
/* clang-format on */

/* Factor on Jacobi's step of the lattice: with momentum 0.6 stable for eigenvalues up to three fifths above
   the lattice's. */
static const float REACH = 1.1F;

static float lightest(const Constants *constants)
{
    float mass = constants->mass[0];
    for (int f = 1; f < constants->fluid_count; f++)
        mass = fminf(mass, constants->mass[f]);
    return mass;
}

static void dfsph_set(Constants *constants, const WorldDef *def)
{
    const IncompressibleFactors factors =
        incompressible_factors(def, constants, &dfsph_solvers(constants)->factors);
    const DfsphDef *said = dfsph_def(def);
    const DfsphConstants own = {
        .sums = {.gradient = factors.gradient,
                 .friction_gradient = factors.friction_gradient,
                 .relaxation = REACH * factors.relaxation,
                 .pressure_of_term = factors.pressure_of_term,
                 .least_squares = factors.least_squares,
                 .surface_lack = (float)said->surface_lack * factors.surface_lack,
                 .surface_slope = factors.surface_slope,
                 .boundary_fades = (float)incompressible_boundary_fades(def),
                 .lightest = lightest(constants),
                 .coarse_slope =
                     factors.pressure_of_term / (constants->rest_number_density * constants->support_radius)},
        .most = said->iterations,
        .coarse = said->coarse,
        .tolerance = said->tolerance,
        .divergence_tolerance = said->divergence_tolerance,
        .factors = factors,
    };
    _Static_assert(sizeof own <= METHOD_CONSTANTS_SIZE, "constants hold it");
    memcpy(constants->of_method, &own, sizeof own);
}

enum { SOLVE_DENSITY, SOLVE_DIVERGENCE };

/* A particle worse than WORST and WORTH needs at least FEW iterations. The mean hides a few bad particles:
   the row on a floor, or fluid pressed by an impact, stays 4 % too near for many steps. Two iterations remove
   most of the error; more would serve only single particles in corners. */
enum { FEW = 2 };
static const double WORST = 10;                                                     /* in tolerances, */
static const double WORTH[] = {[SOLVE_DENSITY] = 0.01, [SOLVE_DIVERGENCE] = 0.005}; /* and at least */

/* Factor of the residual for calm fluid (sim/methods/shared/incompressible.h): so fluid at rest needs
   fewer iterations. */
static const double CALM = 0.2;

/* The most that is left where fluid rests. Each step leaves velocities of residual * h / dt, and friction
   takes hundreds of steps to remove such: with 1e-4 in steps of 10 ms a tank never rests. With 1e-5 a tank
   rests, in fewer iterations: fluid at rest needs no iteration. */
static const double STILL = 1e-5;

/* Solve to `tolerance`; a mean above STEP_SOLVE_STANDS times `allowed` is trouble. */
static void solve(const Substep *step, int which, const Pass *const passes[4], double tolerance,
                  double allowed)
{
    const DfsphConstants *own = dfsph_solvers(step->constants);
    const Iteration iteration = {
        .passes = {passes[1], passes[2]},
        .coarse = which == SOLVE_DIVERGENCE && dfsph_has_coarse(step->constants) ? &dfsph_coarse : NULL,
        .residual = dfsph_miss,
        .tolerance = tolerance,
        .worst = fmax(WORST * tolerance, WORTH[which]),
        .few = FEW,
        .most = own->most,
        .begun = true,
        .allowed = allowed};
    substep_run(step, passes[0], step->dt);
    if (which == SOLVE_DIVERGENCE) /* the solver begins with multipliers */
        substep_run(step, passes[1], step->dt);
    substep_run(step, passes[2], step->dt);
    substep_iterate(step, &iteration, which, step->dt);
    substep_run(step, passes[3], step->dt);
}

/* Thick fluid rests on pressure, so friction at the end of a step needs a pressure: that of the step before,
   corrected afterwards by the solver of divergence. Without pressure fluid would flow as if unsupported for
   the length of a step, in each step. */
static void end_terms(const Substep *step)
{
    if (!step->constants->implicit.on)
        return;
    STAGE (step->clock, STAGE_SOLVE) {
        substep_run(step, &dfsph_divergence_begin, step->dt);
        substep_run(step, &dfsph_divergence_push, step->dt);
        substep_run(step, &dfsph_pressed, step->dt);
    }
    substep_terms(step);
    STAGE (step->clock, STAGE_SOLVE)
        substep_run(step, &dfsph_unpressed, step->dt);
}

/* Pressure: after gravity and all other accelerations, velocities must not compress particles at rest
   density. */
static void end_divergence(const Substep *step)
{
    static const Pass *const passes[] = {&dfsph_divergence_begin, &dfsph_divergence_push,
                                         &dfsph_divergence_rate, &dfsph_divergence_end};
    const double allowed = dfsph_solvers(step->constants)->divergence_tolerance;
    solve(step, SOLVE_DIVERGENCE, passes, incompressible_rest_residual(step, step->dt, CALM, STILL, allowed),
          allowed);
}

/* Moves positions to rest density, without a change of velocities. If velocities changed too, as in the
   papers, each step's correction would go on in the next step, and fluid at rest would boil. */
static void hold_density(const Substep *step)
{
    static const Pass *const passes[] = {&dfsph_density_begin, &dfsph_density_push, &dfsph_density_rate,
                                         &dfsph_density_end};
    const double allowed = dfsph_solvers(step->constants)->tolerance;
    solve(step, SOLVE_DENSITY, passes, allowed, allowed);
}

/* Both solvers work between the halves of the drift, with one grid and one set of lists. From there to the
   middle of the next step particles move with the solvers' velocities. */
static void dfsph_substep(const Substep *step)
{
    const Backend *b = step->backend;
    void *state = step->state;

    STAGE (step->clock, STAGE_INTEGRATE)
        b->drift(state, &step->first_half);
    STAGE (step->clock, STAGE_GRID)
        b->grid(state);
    STAGE (step->clock, STAGE_DENSITY)
        substep_run(step, &dfsph_state, step->dt);
    STAGE (step->clock, STAGE_FORCE)
        substep_run(step, &dfsph_others, step->dt);
    end_terms(step);
    STAGE (step->clock, STAGE_SOLVE)
        end_divergence(step);
    STAGE (step->clock, STAGE_INTEGRATE)
        substep_kick(step);
    STAGE (step->clock, STAGE_SOLVE)
        hold_density(step);
    STAGE (step->clock, STAGE_INTEGRATE)
        b->drift(state, &step->second_half);
}

/* What rests is stirred by the noise of pressure, at some part of sqrt(g h). */
static StepFriction dfsph_step_friction(const WorldDef *def, const Lattice *lattice)
{
    const double h = def->support * def->spacing;
    StepFriction friction = incompressible_friction(def, lattice);
    friction.numerical =
        0.25 * dfsph_def(def)->rest_viscosity * h * incompressible_fall(def) / (def->dimensions + 2);
    friction.numerical_key = "solver.rest_viscosity";
    return friction;
}

static const Pass *const passes[] = {&dfsph_state,           &dfsph_divergence_begin,
                                     &dfsph_divergence_push, &dfsph_divergence_rate,
                                     &dfsph_coarse,          &dfsph_divergence_end,
                                     &dfsph_others,          &dfsph_pressed,
                                     &dfsph_unpressed,       &dfsph_density_begin,
                                     &dfsph_density_push,    &dfsph_density_rate,
                                     &dfsph_density_end,     NULL};

static double pressure_of_multiplier(const Constants *constants)
{
    return (double)dfsph_constants(constants)->pressure_of_term;
}

static bool always(const Constants *constants)
{
    (void)constants;
    return true;
}

/* Elements are vec4: push.glsl. */
static const ShaderBuffer buffers[] = {{"Pushes", 16, always}, {"Moves", 16, always}, {0}};

const Method method_dfsph = {
    .name = "dfsph",
    .help = "Bender and Koschier 2017: density and divergence held by two solvers that iterate",
    .keys = keys,
    .def = &usual,
    .def_size = sizeof usual,
    .keeps_images = true,
    .incompressible = true,
    .solvers = {[SOLVE_DENSITY] = {"density", "solver.tolerance", "solver.iterations"},
                [SOLVE_DIVERGENCE] = {"divergence", "solver.divergence_tolerance", "solver.iterations"}},
    .kernels = incompressible_kernels,
    .friction = dfsph_step_friction,
    .multiplier = &dfsph_columns[KEPT],
    .pressure_of_multiplier = pressure_of_multiplier,
    .constants = dfsph_set,
    .columns = dfsph_columns,
    .passes = passes,
    .buffers = buffers,
    .settle = &dfsph_state,
    .substep = dfsph_substep,
};
