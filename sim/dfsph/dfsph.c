/* after: J. Bender, D. Koschier, "Divergence-free SPH for incompressible and viscous fluids", 2017 */
#include "sim/dfsph/dfsph.h"

#include "sim/base/key_rows.h"
#include "sim/dfsph/passes.h"
#include "sim/incompressible/calm.h"
#include "sim/incompressible/constants.h"
#include "sim/world/iterate.h"

#include <math.h>
#include <string.h>

static const DfsphDef usual = {.tolerance = 0.0005, .divergence_tolerance = 0.0001, .iterations = 100};

/* clang-format off */
static const Key keys[] = {
    NUMBER("solver.tolerance", 0, "", 0, 1, offsetof(DfsphDef, tolerance), "mean compression that the solver of density leaves"),
    NUMBER("solver.divergence_tolerance", 0, "", 0, 1, offsetof(DfsphDef, divergence_tolerance), "mean compression that a step's velocities may make"),
    INTEGER("solver.iterations", 0, 1, 10000, offsetof(DfsphDef, iterations), "of each solver, at most"),
    KEYS_END,
};
/* clang-format on */

/* Of Jacobi's step as the lattice has it: with momentum 0.6 that holds for eigenvalues greater than the
   lattice's by three fifths. */
static const float REACH = 1.1F;

static void dfsph_set(Constants *constants, const WorldDef *def)
{
    const IncompressibleFactors factors = incompressible_factors(def, constants);
    const DfsphDef *said = dfsph_def(def);
    const DfsphConstants own = {
        .sums = {.gradient = factors.gradient,
                 .friction_gradient = factors.friction_gradient,
                 .relaxation = REACH * factors.relaxation,
                 .pressure_of_term = factors.pressure_of_term,
                 .least_squares = factors.least_squares},
        .most = said->iterations,
        .tolerance = said->tolerance,
        .divergence_tolerance = said->divergence_tolerance,
    };
    _Static_assert(sizeof own <= METHOD_CONSTANTS_SIZE, "constants hold it");
    memcpy(constants->of_method, &own, sizeof own);
}

enum { SOLVE_DENSITY, SOLVE_DIVERGENCE };

/* The mean hides what few have: the row on a floor, or what an impact pressed, stays 4 % too near for many
   steps. Two iterations take most of that away; more would be for single particles in corners. */
enum { FEW = 2 };
static const double WORST = 10;                                                     /* tolerances, */
static const double WORTH[] = {[SOLVE_DENSITY] = 0.01, [SOLVE_DIVERGENCE] = 0.005}; /* and no less */

/* Of what calm fluid may leave (sim/incompressible/calm.h): fluid at rest needs fewer iterations by it. */
static const double CALM = 0.2;

/* To `tolerance`; more than what is `allowed` is trouble. */
static void solve(const Substep *step, int which, const Pass *const passes[4], double tolerance,
                  double allowed)
{
    const Iteration iteration = {.passes = {passes[1], passes[2]},
                                 .residual = dfsph_miss,
                                 .tolerance = tolerance,
                                 .worst = fmax(WORST * tolerance, WORTH[which]),
                                 .few = FEW,
                                 .most = dfsph_solvers(step->constants)->most,
                                 .begun = true};
    substep_run(step, passes[0], step->dt);
    if (which == SOLVE_DIVERGENCE) /* it begins with multipliers */
        substep_run(step, passes[1], step->dt);
    substep_run(step, passes[2], step->dt);
    substep_iterate(step, &iteration, which, step->dt);
    step->solves[which].tolerance = allowed;
    step->solves[which].failed = !(step->solves[which].mean <= STEP_SOLVE_STANDS * allowed);
    substep_run(step, passes[3], step->dt);
}

/* Thick fluid rests on its pressure, so friction at the end of a step has to know one: that of the step
   before, which the solver of divergence then corrects. Without it fluid would flow as if nothing held it, a
   step long, each step anew. */
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

/* Pressure: velocities that, after gravity and all other accelerations, press nothing that is at rest
 * density. */
static void end_divergence(const Substep *step)
{
    static const Pass *const passes[] = {&dfsph_divergence_begin, &dfsph_divergence_push,
                                         &dfsph_divergence_rate, &dfsph_divergence_end};
    const double allowed = dfsph_solvers(step->constants)->divergence_tolerance;
    solve(step, SOLVE_DIVERGENCE, passes, incompressible_calm(step, step->dt, CALM, allowed), allowed);
}

/* Moves places to rest density. Velocities have no part in it: given to them, as the papers do, each step's
   correction flies on into the next one, and fluid at rest boils. */
static void hold_density(const Substep *step)
{
    static const Pass *const passes[] = {&dfsph_density_begin, &dfsph_density_push, &dfsph_density_rate,
                                         &dfsph_density_end};
    const double allowed = dfsph_solvers(step->constants)->tolerance;
    solve(step, SOLVE_DENSITY, passes, allowed, allowed);
}

/* Both solvers work between the halves of the drift, with one grid and one set of lists; from there to the
   middle of the next step particles fly by the velocities that they leave. */
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

static const Pass *const passes[] = {&dfsph_state,
                                     &dfsph_divergence_begin,
                                     &dfsph_divergence_push,
                                     &dfsph_divergence_rate,
                                     &dfsph_divergence_end,
                                     &dfsph_others,
                                     &dfsph_pressed,
                                     &dfsph_unpressed,
                                     &dfsph_density_begin,
                                     &dfsph_density_push,
                                     &dfsph_density_rate,
                                     &dfsph_density_end,
                                     NULL};

static double pressure_of_multiplier(const Constants *constants)
{
    return (double)dfsph_constants(constants)->pressure_of_term;
}

static bool always(const Constants *constants)
{
    (void)constants;
    return true;
}

/* Of vec4: push.glsl. */
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
    .friction = incompressible_friction,
    .multiplier = &dfsph_columns[KEPT],
    .pressure_of_multiplier = pressure_of_multiplier,
    .constants = dfsph_set,
    .columns = dfsph_columns,
    .passes = passes,
    .buffers = buffers,
    .settle = &dfsph_state,
    .substep = dfsph_substep,
};
