/* after: M. Macklin, M. Müller, "Position Based Fluids", 2013 */
#include "sim/base/key_rows.h"
#include "sim/methods/pbf/pbf_private.h"
#include "sim/methods/shared/incompressible.h"
#include "sim/step/substep.h"

#include <math.h>
#include <string.h>

static const PbfDef usual = {.tolerance = 0.01, .iterations = 100};

/* clang-format off */
static const Key keys[] = {
    NUMBER("solver.compression", 0, "", 0, 1, offsetof(PbfDef, tolerance), "mean compression at which the iterations of a step end early; 0: all of them run"),
    INTEGER("solver.corrections", 0, 1, 10000, offsetof(PbfDef, iterations), "iterations of a step, at most"),
    KEYS_END,
};
/* clang-format on */

/* Acceleration that drives the fluid, m/s2: gravity, or surface tension across the box's height if
   greater. */
static double pull_of(const WorldDef *def)
{
    const double *g = def->gravity, height = def->box_size[1];
    double pull = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    for (int f = 0; f < def->fluid_count; f++)
        pull = fmax(pull, def->fluids[f].surface_tension / (def->fluids[f].density * height * height));
    return pull;
}

/* 1 over the time to settle. The time to settle is proportional to the time of a fall through the box, and is
   1/60 s for a height of 1 m. Without a driving acceleration it is proportional to the time of sound across a
   spacing, 1/60 s for 10 cm and 20 m/s. Sound has no other part in pbf. */
static double settle_rate(const WorldDef *def)
{
    static const double FALLS = 60 * 60 / 9.81, SOUNDS = 60 * 0.1 / 20;
    const double pull = pull_of(def);
    return pull > 0 ? sqrt(FALLS * pull / def->box_size[1]) : SOUNDS * def->sound_speed / def->spacing;
}

static bool asks_sound(const WorldDef *def)
{
    return !(pull_of(def) > 0);
}

static void pbf_set(Constants *constants, const WorldDef *def)
{
    const IncompressibleFactors factors =
        incompressible_factors(def, constants, &pbf_solver(constants)->factors);
    const PbfConstants own = {
        .sums = {.gradient = factors.gradient,
                 .friction_gradient = factors.friction_gradient,
                 .relaxation = factors.relaxation,
                 .least_squares = factors.least_squares,
                 .pressure_of_term = factors.pressure_of_term,
                 .viscous_dt = (float)(STEP_VISCOUS_STANDS * step_viscous(def, &constants->friction)),
                 .settle_rate = (float)settle_rate(def),
                 .boundary_fades = (float)incompressible_boundary_fades(def)},
        .most = pbf_def(def)->iterations,
        .tolerance = pbf_def(def)->tolerance,
        .factors = factors,
    };
    _Static_assert(sizeof own <= METHOD_CONSTANTS_SIZE, "constants hold it");
    memcpy(constants->of_method, &own, sizeof own);
}

/* Mean way of particles since the lists were made, in spacings; with a longer way lists miss neighbours. */
static const double WAY_MOST = 0.2;

/* How often lists are made in a step, at most. */
enum { LISTS_MOST = 4 };

/* Move by the multipliers of the step before. */
static void begin(const Substep *step)
{
    substep_run(step, &pbf_begin, step->dt);
    substep_run(step, &pbf_first, step->dt);
    substep_run(step, &pbf_density, step->dt);
}

/* Make lists at the particles' present positions. */
static void renew_lists(const Substep *step)
{
    step->backend->grid(step->state);
    substep_run(step, &pbf_again, step->dt);
    substep_run(step, &pbf_density, step->dt);
}

/* Error of density left by a step of calm fluid. A residual e is a velocity of e h / dt.
   - CALM times the square of the Courant number, as in sim/methods/shared/incompressible.h, or of fall, dt
     sqrt(g / h), if that is greater.
   - At most STILL times fall, a velocity of STILL sqrt(g h): fluid at rest then has 0.002 of sqrt(g H). With
   the tolerance alone it has 0.011, since steps with more and with fewer iterations alternate. */
static const double STILL = 0.02, CALM = 0.15;

static double residual_of(const Substep *step, double allowed)
{
    const double h = (double)step->constants->support_radius, courant = step->speed * step->dt / h;
    const float *g = step->gravity;
    const double pull = sqrt((double)(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]));
    const double fall = step->dt * sqrt(pull / h);
    return pull > 0 ? fmin(allowed, fmax(fmin(STILL, CALM * fall) * fall, CALM * courant * courant))
                    : allowed;
}

/* Iterate, with new lists where the old lists became useless, whatever their residual. A step reports the
   compression at its end; a solver in trouble reports the compression after many such steps. A tolerance of 0
   asks for a number of iterations, without a residual. */
static void hold_density(const Substep *step)
{
    const double tolerance = pbf_solver(step->constants)->tolerance,
                 share = (double)PBF_SHARE(pbf_constants(step->constants)->settle_rate * (float)step->dt);
    const Iteration iteration = {.passes = {&pbf_move, &pbf_density},
                                 .residual = pbf_miss,
                                 .tolerance = residual_of(step, share * tolerance),
                                 .most = pbf_solver(step->constants)->most,
                                 .way = pbf_way,
                                 .way_most = WAY_MOST,
                                 .renew = renew_lists,
                                 .renewals = LISTS_MOST - 1,
                                 .unit = share,
                                 .allowed = tolerance > 0 ? tolerance : -1,
                                 .left = pbf_compressed};
    begin(step);
    substep_iterate(step, &iteration, 0, step->dt);
}

/* The whole flight comes first; grid and lists are made at the end of the flight. */
static void pbf_substep(const Substep *step)
{
    const Backend *b = step->backend;
    void *state = step->state;

    STAGE (step->clock, STAGE_INTEGRATE) {
        b->drift(state, &step->first_half);
        substep_run(step, &pbf_predict, step->dt);
        b->drift(state, &step->second_half);
    }
    STAGE (step->clock, STAGE_GRID)
        b->grid(state);
    STAGE (step->clock, STAGE_SOLVE)
        hold_density(step);
    STAGE (step->clock, STAGE_FORCE)
        substep_run(step, &pbf_force, step->dt);
    substep_terms(step);
    STAGE (step->clock, STAGE_INTEGRATE)
        substep_kick(step);
}

static const Pass *const passes[] = {&pbf_predict, &pbf_begin, &pbf_first,  &pbf_move, &pbf_density,
                                     &pbf_again,   &pbf_force, &pbf_settle, NULL};

static double pressure_of_multiplier(const Constants *constants)
{
    return (double)pbf_constants(constants)->pressure_of_term;
}

static bool always(const Constants *constants)
{
    (void)constants;
    return true;
}

/* Elements are vec4: density.comp. */
static const ShaderBuffer buffers[] = {{"Motions", 16, always}, {0}};

const Method method_pbf = {
    .name = "pbf",
    .help =
        "Macklin and Mueller 2013: places corrected until nothing is compressed; made for long steps, 1/60 s",
    .keys = keys,
    .def = &usual,
    .def_size = sizeof usual,
    .incompressible = true,
    .asks_sound = asks_sound,
    .solvers = {{"places", "solver.compression", "solver.corrections"}},
    .leaps = true,
    .kernels = incompressible_kernels,
    .friction = incompressible_friction,
    .multiplier = &pbf_columns[TERM],
    .pressure_of_multiplier = pressure_of_multiplier,
    .constants = pbf_set,
    .columns = pbf_columns,
    .passes = passes,
    .buffers = buffers,
    .settle = &pbf_settle,
    .substep = pbf_substep,
};
