/* A table of scenes for comparing a GPU backend's steps with `cpu`; the tests are tables of scenes. */
#ifndef SLOSH_PARITY_CASE_H
#define SLOSH_PARITY_CASE_H

#include "tests/gl/parity.h"

#include "sim/methods/pbf/pbf.h"
#include "sim/methods/wcsph/wcsph.h"

/* Of stirred_def's two fluids; what a row leaves out a scene does not name. */
typedef struct ParityCase {
    const char *label;
    int dimensions;
    double support, viscosity[2];
    TensionModel tension;
    bool negative, no_slip, solids;
    const char *sides; /* periodic sides */
    double lid, dt;    /* dt: s; 0: the table's */
    const char *kernel;
    double delta, artificial, shifting; /* of wcsph, as `kernel`, mueller's too */
    ViscosityForm form;
    bool corrected;
    double light;       /* density of the second fluid, kg/m3; 0: stirred_def's */
    double tolerance;   /* of pbf; 0: the usual one */
    const char *method; /* NULL: the table's */
    bool runs;          /* for as many steps again, too */
} ParityCase;

typedef struct ParityTable {
    const char *method;
    double dt;
    int steps; /* before the comparison */
    int count;
    const ParityCase *cases;
} ParityTable;

/* A no-slip solid, and a slip solid. */
static inline void parity_solids(WorldDef *def)
{
    static const Motion shake = {.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.03, .frequency = 3};
    def->solids[def->solid_count++] = (SolidDef){
        .kind = SOLID_BOX,
        .centre = {0.15, 0.25, 0},
        .size = {0.1, 0.4, 0.5},
        .slip = SLIP_NONE,
        .motion_count = 1,
        .motions = &shake,
    };
    def->solids[def->solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {-0.3, 0.2, 0}, .radius = 0.15};
}

static inline void parity_settings(const ParityCase *c, WorldDef *def)
{
    WcsphDef *wcsph = wcsph_def(def);
    if (c->kernel && c->method && strcmp(c->method, "mueller") == 0)
        snprintf(mueller_def(def)->density_kernel, NAME_SIZE, "%s", c->kernel);
    else if (c->kernel)
        snprintf(wcsph->kernel, sizeof wcsph->kernel, "%s", c->kernel);
    wcsph->delta_sph = c->delta;
    wcsph->artificial_viscosity = c->artificial;
    wcsph->shifting = c->shifting;
    wcsph->corrected_gradient = c->corrected;
    if (c->light > 0)
        def->fluids[1].density = c->light;
    wcsph->viscosity_form = (int)c->form;
    if (c->tolerance > 0)
        pbf_def(def)->tolerance = c->tolerance;
}

static inline WorldDef parity_def(const ParityTable *table, const ParityCase *c)
{
    WorldDef def = stirred_def(c->dimensions);
    snprintf(def.method, sizeof def.method, "%s", c->method ? c->method : table->method);
    parity_settings(c, &def);
    def.spacing = c->dimensions == 2 ? 0.025 : 0.09;
    def.support = c->support;
    def.dt = c->dt > 0 ? c->dt : table->dt;
    def.tension_model = (int)c->tension;
    def.negative_pressure = c->negative;
    def.lid[0] = c->lid;
    def.wall_slip = c->no_slip ? SLIP_NONE : SLIP_FREE;
    if (c->solids)
        parity_solids(&def);
    for (int k = 0; c->sides && k < 3; k++)
        def.periodic[k] = strchr(c->sides, "xyz"[k]) != NULL;
    if (c->sides)
        def.motion_count = 1; /* such a box does not turn */
    for (int f = 0; f < 2; f++) {
        def.fluids[f].viscosity = c->viscosity[f];
        def.fluids[f].surface_tension = c->tension ? (c->dimensions == 2 ? 2 : 20) : 0;
        def.fluids[f].contact_angle = f ? 60 : 120;
    }
    return def;
}

/* The same iterations of each solver, and what is left of the residuals. */
static inline void compare_solves(const World *cpu, const World *gpu)
{
    const MethodSolver *solvers = cpu->constants.method->solvers;
    double iterations = 0;
    for (int k = 0; k < SOLVES_OF_METHOD && solvers[k].name; k++) {
        const StepSolve *a = &cpu->solves[k], *b = &gpu->solves[k];
        printf("  solver of %s: %g and %g iterations, mean %.3g and %.3g, most %.3g and %.3g\n",
               solvers[k].name, a->iterations, b->iterations, a->mean, b->mean, a->most, b->most);
        assert_true(a->iterations == b->iterations);
        assert_true(fabs(a->mean - b->mean) < 1e-3 * a->mean + 1e-7);
        assert_true(fabs(a->most - b->most) < 1e-3 * a->most + 1e-6);
        iterations += a->iterations;
    }
    assert_true(!solvers[0].name || iterations > 0);
}

static inline void parity_check(const ParityTable *table)
{
    for (const ParityCase *c = table->cases; c < table->cases + table->count; c++) {
        const WorldDef def = parity_def(table, c);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        char label[128];
        snprintf(label, sizeof label, "%s, %s", def.method, c->label);
        fixture_step(cpu, table->steps);
        copy_state(cpu, gpu);
        compare_step(label, cpu, gpu);
        compare_solves(cpu, gpu);
        if (c->runs) {
            copy_state(cpu, gpu);
            compare_run(&def, "  and", cpu, gpu, table->steps);
        }
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

#endif
