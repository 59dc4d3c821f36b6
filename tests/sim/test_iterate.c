/* What is counted of solvers that iterate: over steps, in bounded memory. */
#include "sim/methods/dfsph/dfsph.h"
#include "sim/state.h"
#include "sim/step/substep.h"
#include "tests/sim/fixture.h"

static void add(SolveTally *tally, int density, int divergence, double mean, double most)
{
    const StepSolve solves[SOLVES_MAX] = {{density, mean, most, 1e-3, false}, {divergence, 1, 1, 1, false}};
    solve_tally_add(tally, solves);
}

/* Of 100 steps those with the most iterations lie above the 95th percentile. */
static void figures_are_those_of_the_steps(void **state)
{
    (void)state;
    SolveTally tally = {0};
    for (int k = 1; k <= 94; k++)
        add(&tally, 4, 1, 0.001, 0.01);
    add(&tally, 20, 3, 0.002, 0.05);
    for (int k = 0; k < 5; k++)
        add(&tally, 30, 10, 0.001, 0.01);
    const SolveFigures f = solve_tally_figures(&tally);
    assert_int_equal(f.steps, 100);
    assert_float_equal(f.iterations_mean, (94 * 5 + 23 + 5 * 40) / 100.0, 1e-12);
    assert_float_equal(f.iterations_p95, 23, 0);
    assert_float_equal(f.density_error_mean, (99 * 0.001 + 0.002) / 100, 1e-12);
    assert_float_equal(f.density_error_max, 0.05, 0);
}

/* Any number of iterations is its own percentile to an eighth, and never less than it is. */
static void percentiles_are_near(void **state)
{
    (void)state;
    for (int n = 1; n <= 20000; n++) {
        SolveTally tally = {0};
        for (int k = 0; k < 19; k++)
            add(&tally, n, 0, 0, 0);
        add(&tally, 20000, 20000, 0, 0);
        const double p95 = solve_tally_figures(&tally).iterations_p95;
        if (n < 64 ? p95 != n : p95 < n || p95 > 1.125 * n)
            fail_msg("%d iterations: %g", n, p95);
    }
}

static SolveFigures solved(const World *world)
{
    WorldInfo info;
    world_info(world, &info);
    return info.solved;
}

static WorldDef column(void)
{
    WorldDef def = fixture_def(0.6, 0.6, 0.6);
    strcpy(def.method, "dfsph");
    def.retries = 3;
    fixture_block(&def, 0, -0.3, 0, -0.3, 0.3, 0.4, 0.3);
    return def;
}

static void nothing_is_counted_of_a_method_without_solvers(void **state)
{
    (void)state;
    WorldDef def = column();
    strcpy(def.method, "mueller");
    World *world = fixture_world(&def);
    fixture_step(world, 2);
    const SolveFigures f = solved(world);
    assert_int_equal(f.steps, 0);
    assert_true(f.iterations_mean == 0 && f.iterations_p95 == 0 && f.density_error_mean == 0);
    world_destroy(world);
}

/* Each step is counted, another backend goes on counting, a saved state has none of it. */
static void a_world_counts(void **state)
{
    (void)state;
    const WorldDef def = column();
    Error error = {0};
    WorldState saved = {0};
    World *world = fixture_world(&def), *other = fixture_world(&def);
    fixture_step(world, 10);
    assert_int_equal(solved(world).steps, 10);
    assert_true(solved(world).iterations_mean >= 1 && solved(world).density_error_max > 0);
    assert_true(world_save(world, &saved, &error));
    fixture_step(world, 5);
    assert_true(world_move(&world, "cpu", &error));
    fixture_step(world, 1);
    assert_int_equal(solved(world).steps, 16);
    assert_true(world_load(other, &saved, &error));
    fixture_step(other, 2);
    assert_int_equal(solved(other).steps, 2);
    world_solved_restart(world);
    assert_int_equal(solved(world).steps, 0);
    world_state_free(&saved);
    world_destroy(world);
    world_destroy(other);
}

/* A step taken back is not counted, and the trouble names the solver. */
static void trouble_names_its_solver(void **state)
{
    (void)state;
    Error error = {0};
    WorldDef def = column();
    char words[160];
    WorldInfo info;
    dfsph_def(&def)->iterations = 1;
    dfsph_def(&def)->divergence_tolerance = 1e-12;
    World *world = fixture_world(&def);
    assert_true(world_substep(world, NULL, &error));
    world_info(world, &info);
    assert_int_equal(info.trouble.what, STEP_TROUBLE_SOLVE);
    assert_int_equal(info.solved.steps, 0);
    world_trouble_words(&info.trouble, words);
    assert_non_null(strstr(words, "the solver of divergence does not converge: solver.iterations 1 leaves"));
    assert_non_null(strstr(words, "solver.divergence_tolerance is 1e-10 %"));
    world_destroy(world);
}

/* A solver whose mean is little at once and whose worst particle never is. */
static Excess few_are_far(void *state, const ColumnDef *column)
{
    (void)column;
    (*(int *)state)++;
    return (Excess){.mean = 1e-4, .greatest = 0.1};
}

static double iterations_of(double tolerance, double worst, int few, int most)
{
    static const Backend backend = {.excess = few_are_far};
    StepSolve solves[SOLVES_MAX] = {{0}};
    int measured = 0;
    const Substep step = {.backend = &backend, .state = &measured, .solves = solves};
    const Iteration iteration = {
        .tolerance = tolerance, .worst = worst, .few = few, .most = most, .begun = true};
    substep_iterate(&step, &iteration, 0, 1e-3);
    assert_int_equal(measured, 1 + (int)solves[0].iterations);
    return solves[0].iterations;
}

static void the_worst_is_worth_a_few_iterations(void **state)
{
    (void)state;
    assert_true(iterations_of(1e-3, 0.05, 2, 100) == 2);
    assert_true(iterations_of(1e-3, 0.2, 2, 100) == 0);
    assert_true(iterations_of(1e-3, 0.05, 2, 1) == 1);
    assert_true(iterations_of(1e-5, 0.2, 2, 100) == 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_worst_is_worth_a_few_iterations),
        cmocka_unit_test(figures_are_those_of_the_steps),
        cmocka_unit_test(percentiles_are_near),
        cmocka_unit_test(nothing_is_counted_of_a_method_without_solvers),
        cmocka_unit_test(a_world_counts),
        cmocka_unit_test(trouble_names_its_solver),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
