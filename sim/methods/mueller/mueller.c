/* Density, pressure and forces: pair sums, then additions by walls. */
#include "sim/base/key_rows.h"
#include "sim/def/fluids.h"
#include "sim/methods/mueller/mueller_private.h"
#include "sim/step/constants.h"
#include "sim/step/substep.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

PAIR_LOOPS(mueller_density);
PAIR_LOOPS(mueller_force);

/* The boundary part of n / n0, for `added` by boundary particles; 0 at the first boundary particle. */
static float boundary_part(const Cpu *cpu, size_t i, float added, float dt)
{
    const MuellerBlock *own = &mueller_constants(cpu->constants)->sums;
    float *mean = &cpu->now.own[BOUNDARY_MEAN][i];
    const float now = added / cpu->constants->rest_number_density, more = *mean == 0 ? 0 : now - *mean,
                part = fminf(fmaxf(more, -own->boundary_most), own->boundary_most);
    if (dt > 0)
        *mean = now == 0 ? 0 : now - part / (1 + dt * own->boundary_fades);
    return now == 0 ? 0 : part;
}

/* `volume` holds the pair sum on entry, and `ax` the part of boundary particles. */
static void finish_density(Cpu *cpu, size_t i, float dt)
{
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const float n = p->volume[i], part = p->own[BOUNDARY_MEAN] ? boundary_part(cpu, i, p->ax[i], dt) : 0,
                pressure = mueller_state(s, p->fluid[i], n / s->rest_number_density - 1 + part);

    p->volume[i] = 1 / n;
    p->pressure[i] = s->negative_pressure || pressure > 0 ? pressure : 0;
    p->pressure_term[i] = p->pressure[i] * p->volume[i] * p->volume[i];
    cpu_fill_terms(cpu, i);
}

/* {x, 1 for boundary particles}. */
static void pack_density(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        const float beside = p->fluid[i] < FLUIDS_MAX ? 0 : 1;
        memcpy(range->cpu->place[i], (float[]){p->x[i], p->y[i], p->z[i], beside}, 16);
    }
}

static void density_body(const CpuRange *range)
{
    cpu_pairs(range, &mueller_density);
    for (size_t i = range->begin; i < range->end; i++)
        finish_density(range->cpu, i, range->input->dt);
}

static void force_body(const CpuRange *range)
{
    cpu_pairs(range, &mueller_force);
    cpu_force_end(range);
    cpu_cushion(range);
    cpu_wall_lift(range, 0);
}

/* Per neighbour: {x, p V^2}. */
static PairCost density_pair(const Constants *constants)
{
    (void)constants;
    return (PairCost){.gather = 16, .flops = 14};
}

/* With viscosity also {v, V}, and with several fluids the neighbour's viscosity. */
static PairCost force_pair(const Constants *constants)
{
    const bool viscous = constants->rubs, many = viscous && constants->fluid_count > 1;
    return (PairCost){.gather = 16 + 16 * viscous + 4 * many, .flops = 22 + 11 * viscous + 2 * many};
}

static const CpuPass density = {.loops = {{density_body, .walks = true, .pack = pack_density}},
                                .pair = density_pair};
/* Force of a pair as in force_range of sim/methods/mueller/pairs_mueller.c. */
static void solid_force(const SolidPair *pair, float out[3])
{
    const Constants *s = pair->cpu->constants;
    const CpuParticles *p = &pair->cpu->now;
    const size_t i = pair->i, b = pair->b;
    const float t = 1 - pair->r / s->support_radius, terms = p->pressure_term[i] + p->pressure_term[b];
    const float push = mueller_constants(s)->kernel == DENSITY_QUINTIC
                           ? cpu_slope(s->lattice.pressure_kernel, pair, s->lattice.gradient_scale) * terms
                           : s->pressure_scale * t * t * terms / pair->r;
    const float drag =
        s->rubs ? 0.5F * s->viscosity_scale * t * p->volume[i] * pair->volume * cpu_pair_viscosity(pair) : 0;
    const float u[3] = {p->vx[b] - p->vx[i], p->vy[b] - p->vy[i], p->vz[b] - p->vz[i]};
    for (int k = 0; k < 3; k++)
        out[k] = push * pair->d[k] + drag * u[k];
}

static const CpuPass force = {
    .loops = {{force_body, .walks = true}}, .pair = force_pair, .solid = solid_force};

const Pass mueller_densities = {
    .name = "density",
    .stage = STAGE_DENSITY,
    .cpu = &density,
    .shader = "mueller/density",
    .reads = "position fluid boundary_mean",
    .writes = "volume pressure pressure_term viscosity tension kind acceleration boundary_mean",
};

const Pass mueller_forces = {
    .name = "force",
    .stage = STAGE_FORCE,
    .cpu = &force,
    .shader = "mueller/force",
    .reads = "position velocity id fluid volume pressure pressure_term viscosity tension kind",
    .writes = "acceleration",
    .acts_on_solids = true,
    .mirrors = true,
};

static bool many_viscous(const Constants *constants)
{
    return constants->viscous && constants->fluid_count > 1;
}

static bool meets_solids(const Constants *constants)
{
    return constants->solid_count > 0;
}

const ColumnDef mueller_columns[] = {
    {"boundary_mean", "", .at = COLUMN_OWN(BOUNDARY_MEAN), 1, COLUMN_FLOAT,
     .flags = COLUMN_SAVED | COLUMN_SORTED, .needed = meets_solids},
    {"viscosity", "Pa s", .at = offsetof(ParticleColumns, viscosity), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS,
     .needed = many_viscous},
    {0},
};

/* Settings that fail under mueller: steps that heat fluid, high density ratios. */

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
    const double crossing = def->support * def->spacing / step_sound(def), calm = step_sound_calm(def),
                 step = fixed ? def->dt / def->substeps : fmin(def->cfl_number * crossing, def->max_dt);
    if (step <= calm * crossing * (1 + 1e-9) || (fixed && step > STEP_SOUND_STANDS * crossing) ||
        step > 0.001 * step_viscous(def, advice->friction))
        return;
    const char *path = fixed ? "solver.step.dt" : "solver.step.number";
    char better[64];
    if (fixed)
        snprintf(better, sizeof better, "%g substeps or more", substeps_for(def, calm * crossing));
    else
        snprintf(better, sizeof better, "at most %g", calm);
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

/* Warns about settings that fail under mueller. */
static void mueller_advise(const MethodAdvice *advice)
{
    advise_heat(advice);
    advise_ratio(advice);
}

/* after: M. Müller, D. Charypar, M. Gross, "Particle-based fluid simulation for interactive applications",
 * 2003 */

static const MuellerDef usual = {
    .density_kernel = "spiky", /* the paper's poly6 heats the fluid: see docs/labbook/methods.md */
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
    const Kernel *kernel = density_kernel_find(mueller_def(def)->density_kernel);
    const bool poly6 = kernel == &density_kernels[DENSITY_POLY6];
    return (MethodKernels){kernel, poly6 ? &density_kernels[DENSITY_SPIKY] : kernel};
}

static void mueller_set(Constants *constants, const WorldDef *def)
{
    const MethodKernels kernels = mueller_kernels(def);
    const double *g = def->gravity, c = (double)constants->sound_speed;
    const double layer = def->spacing * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) / (c * c);
    const MuellerConstants own = {
        .sums = {.boundary_fades = constants->sound_speed / (BOUNDARY_FADES * constants->support_radius),
                 .boundary_most = (float)(BOUNDARY_MOST * layer)},
        .kernel = (DensityKernel)(kernels.density - density_kernels)};
    const double h = def->support * def->spacing, r = 0.5 * h, half = (5.0625 - 6 * 0.0625) / 0.5;
    /* -W'(r) / r over shape(r / h), or -W'(r) over (1 - r / h)^2, which is -W'(0) */
    const double slope = own.kernel == DENSITY_QUINTIC ? -kernels.slope->derivative(r, h) / r / half
                                                       : -kernel_spiky_derivative(0, h);
    constants->pressure_scale = (float)(slope * constants->lattice.gradient_scale * constants->unit_volume);
    _Static_assert(sizeof own <= METHOD_CONSTANTS_SIZE, "constants hold it");
    memcpy(constants->of_method, &own, sizeof own);
}

static bool sums_poly6(const Constants *constants)
{
    return mueller_constants(constants)->kernel == DENSITY_POLY6;
}

static bool sums_quintic(const Constants *constants)
{
    return mueller_constants(constants)->kernel == DENSITY_QUINTIC;
}

static const ShaderTerm terms[] = {{"POLY6", sums_poly6}, {"KERNEL_QUINTIC", sums_quintic}, {0}};

static StepFriction mueller_friction(const WorldDef *def, const Lattice *lattice)
{
    return (StepFriction){.laminar = friction_rate(lattice, def->spacing, FRICTION_LAPLACIAN,
                                                   def->support * def->spacing, mueller_kernels(def).density),
                          .numerical = numerical_kinematic(def, mueller_def(def)->numerical_viscosity),
                          .numerical_key = "solver.numerical_viscosity"};
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

/* Symplectic Euler with the drift in two halves around the kick (position Verlet). Same single evaluation
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
