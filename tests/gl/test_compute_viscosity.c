/* Implicit viscosity on the backend `compute`: steps against `cpu`, unlimited step length, and a complete
   saved state. */
#include "tests/gl/parity_case.h"
#include "tests/viscosity/ball.h"

/* clang-format off */
static const ParityCase cases[] = {
    {"no slip, solids",             3, 2.1, {300, 20}, .method = "mueller", .no_slip = true, .solids = true},
    {"quintic, no slip, lid",       2, 3,   {0, 200},  .method = "wcsph", .kernel = "quintic", .no_slip = true, .lid = 1},
    {"cubic, periodic",             3, 2.1, {500, 3000}, .method = "wcsph", .kernel = "cubic", .sides = "xz"},
    {"no slip, solids, cohesion",   3, 2.1, {5000, 1}, TENSION_COHESION, .method = "dfsph", .no_slip = true, .solids = true, .dt = 0.004},
    {"Wendland, solids",            2, 3,   {300, 20}, .method = "wcsph", .kernel = "wendland_c2", .solids = true},
    {"no slip, solids",             2, 2.6, {100, 20}, .method = "pbf", .no_slip = true, .solids = true, .dt = 0.004},
};
/* clang-format on */
static const ParityTable table = {NULL, 0.0005, 10, sizeof cases / sizeof *cases, cases};

static WorldDef def_of(const ParityCase *c)
{
    WorldDef def = parity_def(&table, c);
    def.viscosity_solver = VISCOSITY_IMPLICIT;
    def.viscosity_tolerance = 1e-6; /* enough for some iterations */
    def.viscosity_iterations = 500;
    def.reproducible = true;
    return def;
}

/* Of a step: velocities within 1e-4 of the greatest change, 1e-3 of a method whose velocity is a way over the
   step: 0.6 to 6e-4 by the step that is looked at. The same iterations, or one more or less. */
static void compare_viscous(const ParityCase *c, World *cpu, World *gpu)
{
    State before = fixture_read(cpu);
    fixture_step(cpu, 1);
    fixture_step(gpu, 1);
    State a = fixture_read(cpu), b = fixture_read(gpu);
    const StepSolve *own = &cpu->solves[SOLVE_VISCOSITY], *other = &gpu->solves[SOLVE_VISCOSITY];
    double off = 0, change = 0;
    for (size_t k = 0; k < 4 * a.count; k++) {
        off = fmax(off, fabs((double)(a.velocity[k] - b.velocity[k])));
        change = fmax(change, fabs((double)(a.velocity[k] - before.velocity[k])));
    }
    printf(
        "%s, %s: %g and %g iterations leave %.3g and %.3g; velocities off by %.1e of the greatest change\n",
        cpu->def.method, c->label, own->iterations, other->iterations, own->mean, other->mean, off / change);
    assert_true(own->iterations > 2 && fabs(own->iterations - other->iterations) <= 1);
    assert_true(other->mean <= other->tolerance);
    assert_true(off < (cpu->constants.method->leaps ? 1e-3 : 1e-4) * change);
    fixture_free(&before);
    fixture_free(&a);
    fixture_free(&b);
}

static void steps_are_those_of_the_cpu(void **state)
{
    (void)state;
    for (int k = 0; k < table.count; k++) {
        const WorldDef def = def_of(&cases[k]);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        fixture_step(cpu, table.steps);
        copy_state(cpu, gpu);
        compare_viscous(&cases[k], cpu, gpu);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* Of two methods each, in the next two tests: the solver is shared, and tests/viscosity has all methods on
 * cpu. */
static void a_second_at_1e5_pascal_seconds_stands(void **state)
{
    (void)state;
    for (int m = 0; m < 4; m += 3)
        ball_check_long_step(fixture_method_names[m], "compute");
}

static void what_is_thrown_falls(void **state)
{
    (void)state;
    for (int m = 1; m < 3; m++)
        ball_check_thrown(fixture_method_names[m], "compute");
}

static void what_turns_keeps_turning(void **state)
{
    (void)state;
    ball_check_turn("mueller", "compute");
}

static void save_load_step_is_step(void **state)
{
    (void)state;
    for (int k = 3; k < table.count; k += 2)
        check_save_load_step(def_of(&cases[k]), "compute", 3);
}

/* A viscosity in an inviscid world brings the solver, its buffers and programs. */
static void a_viscosity_may_come_later(void **state)
{
    (void)state;
    WorldDef def = def_of(&cases[0]);
    Error error = {{0}};
    def.fluids[0].viscosity = def.fluids[1].viscosity = 0;
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    fixture_step(cpu, 2);
    copy_state(cpu, gpu);
    def.fluids[0].viscosity = 100;
    if (!world_change(cpu, &def, &error) || !world_change(gpu, &def, &error))
        fail_msg("%s", error.message);
    compare_viscous(&cases[0], cpu, gpu);
    world_destroy(cpu);
    world_destroy(gpu);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(steps_are_those_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(a_second_at_1e5_pascal_seconds_stands, no_gl_errors),
        cmocka_unit_test_teardown(what_is_thrown_falls, no_gl_errors),
        cmocka_unit_test_teardown(what_turns_keeps_turning, no_gl_errors),
        cmocka_unit_test_teardown(save_load_step_is_step, no_gl_errors),
        cmocka_unit_test_teardown(a_viscosity_may_come_later, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.compute_viscosity", tests, compare_setup, context_teardown);
}
