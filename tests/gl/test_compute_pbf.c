/* The backend `compute` against `cpu`: pbf, its iterations among it. */
#include "tests/gl/parity.h"

#include "sim/pbf/pbf.h"

typedef struct Case {
    const char *label;
    int dimensions;
    double support, viscosity[2];
    TensionModel tension;
    bool negative, no_slip, solids;
    const char *sides; /* periodic ones */
    bool runs;         /* for 100 steps too */
    double dt;         /* s; 0: 4 ms */
    double tolerance;  /* 0: the usual one */
} Case;

static const Case cases[] = {
    {.label = "inviscid", .dimensions = 3, .support = 2.1, .runs = true},
    {.label = "many iterations", .dimensions = 3, .support = 2.1, .dt = 1.0 / 60, .tolerance = 0.001},
    {.label = "viscous, cohesion, no slip",
     .dimensions = 3,
     .support = 2.6,
     .viscosity = {2, 0},
     .tension = TENSION_COHESION,
     .no_slip = true},
    {.label = "solids, one that holds", .dimensions = 3, .support = 2.1, .viscosity = {1, 3}, .solids = true},
    {.label = "colour field, solids",
     .dimensions = 2,
     .support = 2.6,
     .viscosity = {1, 0},
     .tension = TENSION_COLOUR_FIELD,
     .solids = true},
    {.label = "pressure that pulls", .dimensions = 2, .support = 2.6, .negative = true},
    {.label = "periodic", .dimensions = 2, .support = 2.6, .viscosity = {1, 3}, .sides = "x"},
    {.label = "periodic, solids", .dimensions = 3, .support = 2.1, .solids = true, .sides = "xz"},
};
enum { CASES = sizeof cases / sizeof *cases };

static void add_solids(WorldDef *def)
{
    def->solids[def->solid_count++] = (SolidDef){
        .kind = SOLID_BOX,
        .centre = {0.15, 0.25, 0},
        .size = {0.1, 0.4, 0.5},
        .slip = SLIP_NONE,
        .motion_count = 1,
        .motions = {{.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.03, .frequency = 3}},
    };
    def->solids[def->solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {-0.3, 0.2, 0}, .radius = 0.15};
}

static WorldDef def_of(const Case *c)
{
    WorldDef def = stirred_def(c->dimensions);
    snprintf(def.method, sizeof def.method, "pbf");
    def.spacing = c->dimensions == 2 ? 0.025 : 0.09;
    def.support = c->support;
    def.dt = c->dt > 0 ? c->dt : 0.004;
    if (c->tolerance > 0)
        pbf_def(&def)->tolerance = c->tolerance;
    def.tension_model = (int)c->tension;
    def.negative_pressure = c->negative;
    def.wall_slip = c->no_slip ? SLIP_NONE : SLIP_FREE;
    if (c->solids)
        add_solids(&def);
    for (int k = 0; c->sides && k < 3; k++)
        def.periodic[k] = strchr(c->sides, "xyz"[k]) != NULL;
    if (c->sides)
        def.motion_count = 1; /* such a box does not turn */
    for (int f = 0; f < 2; f++) {
        def.fluids[f].viscosity = c->viscosity[f];
        def.fluids[f].surface_tension = c->tension ? (c->dimensions == 2 ? 2 : 20) : 0;
    }
    return def;
}

/* The same iterations, and what is left of the residuals. */
static void compare_solves(World *cpu, World *gpu)
{
    const StepSolve *a = &cpu->solves[0], *b = &gpu->solves[0];
    printf("  %g and %g iterations, mean %.3g and %.3g, most %.3g and %.3g\n", a->iterations, b->iterations,
           a->mean, b->mean, a->most, b->most);
    assert_true(a->iterations == b->iterations && a->iterations > 0);
    assert_true(fabs(a->mean - b->mean) < 1e-3 * a->mean + 1e-7);
    assert_true(fabs(a->most - b->most) < 1e-3 * a->most + 1e-6);
}

static void steps_are_those_of_the_cpu(void **state)
{
    (void)state;
    for (int k = 0; k < CASES; k++) {
        const WorldDef def = def_of(&cases[k]);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        fixture_step(cpu, 100);
        copy_state(cpu, gpu);
        compare_step(cases[k].label, cpu, gpu);
        compare_solves(cpu, gpu);
        if (cases[k].runs) {
            copy_state(cpu, gpu);
            compare_run(&def, "  and", cpu, gpu, 100);
        }
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(steps_are_those_of_the_cpu, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.compute_pbf", tests, compare_setup, context_teardown);
}
