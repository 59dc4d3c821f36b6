/* The term of friction at the end of a step, for all methods: sim/viscosity/passes.h. */
#include "sim/matter/viscosity.h"
#include "sim/viscosity/passes.h"
#include "sim/world/iterate.h"

static bool needed(const Constants *constants)
{
    return constants->implicit.on;
}

static bool named(const WorldDef *def)
{
    return def->viscosity_solver == VISCOSITY_IMPLICIT;
}

static bool by_wendland(const Constants *constants)
{
    return needed(constants) && constants->implicit.kernel == KERNEL_WENDLAND_C2;
}

static bool by_quintic(const Constants *constants)
{
    return needed(constants) && constants->implicit.kernel == KERNEL_QUINTIC;
}

static const ShaderTerm shader_terms[] = {
    {"FRICTION_WENDLAND_C2", by_wendland}, {"FRICTION_QUINTIC", by_quintic}, {0}};

/* Elements are vec4: z, mu. */
static const ShaderBuffer trials = {"Trials", 16, needed};

static const ColumnDef *column_at(int k)
{
    const ColumnDef *column = viscosity_columns;
    while (column->at != COLUMN_TERM(k))
        column++;
    return column;
}

static void solve(const Substep *step)
{
    const ImplicitViscosity *own = &step->constants->implicit;
    const Iteration iteration = {.passes = {&viscosity_step, &viscosity_product},
                                 .residual = column_at(MISS),
                                 .scale = column_at(SCALE),
                                 .power = column_at(POWER),
                                 .curvature = column_at(CURVATURE),
                                 .tolerance = own->tolerance,
                                 .few = 1, /* at least one iteration if any residual is above 0 */
                                 .most = own->most,
                                 .begun = true};
    substep_run(step, &viscosity_begin, step->dt);
    substep_run(step, &viscosity_product, step->dt);
    substep_iterate(step, &iteration, SOLVE_VISCOSITY, step->dt);
    substep_run(step, &viscosity_end, step->dt);
}

static const Pass *const passes[] = {&viscosity_begin, &viscosity_step, &viscosity_product, &viscosity_end,
                                     NULL};

const Term term_viscosity = {
    .name = "viscosity",
    .words = "implicit viscosity",
    .named = named,
    .needed = needed,
    .columns = viscosity_columns,
    .passes = passes,
    .terms = shader_terms,
    .buffer = &trials,
    .solve = SOLVE_VISCOSITY,
    .solver = {"viscosity", "solver.viscosity_tolerance", "solver.viscosity_iterations"},
    .substep = solve,
};
