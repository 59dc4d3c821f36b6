/* The driver's calls in a step: dispatches, draws, barriers, context queries, and the total.
   docs/labbook/performance.md has the printed figures. */
#include "tests/gl/compare.h"

#include "sim/gpu/compute/compute.h"
#include "sim/gpu/gl.h"
#include "sim/methods/dfsph/dfsph.h"
#include "sim/methods/wcsph/wcsph.h"
#include "tests/lists.h"

/* Of one step at most so many. */
typedef struct Bounds {
    int passes, questions, calls;
    int waits; /* of a frame of four steps */
} Bounds;

/* In the second frame of a world, of four steps. */
static void count_step(const char *label, const WorldDef *def, Bounds most)
{
    enum { SUBSTEPS = 4, COPIES = 5 };
    Error error = {0};
    WorldDef four = *def;
    four.substeps = SUBSTEPS;
    four.dt *= SUBSTEPS;
    World *world = fixture_world(&four);
    fixture_step(world, 1);
    draw_check_set(false);
    const GlCalls before = gl_calls();
    const bool good = world_step(world, NULL, &error);
    const GlCalls of = gl_calls_since(&before);
    draw_check_set(true);
    assert_true(good);
    printf(
        "%s: %.1f calls a step: %.1f dispatches, %.1f draws, %.1f barriers, %.1f questions; %.0f bytes; %d waits "
        "a frame, %d read-backs\n",
        label, (double)of.calls / SUBSTEPS, (double)of.dispatches / SUBSTEPS, (double)of.draws / SUBSTEPS,
        (double)of.barriers / SUBSTEPS, (double)of.questions / SUBSTEPS, (double)of.bytes / SUBSTEPS,
        (int)of.waits, (int)of.readbacks);
    /* and for a look at the energy, at most once a frame, a wait and one or two passes; a frame's mark copies
       each buffer of the particles and each column of the method's own */
    assert_in_range(of.dispatches + of.draws, 1, SUBSTEPS * most.passes + 2 + COPIES);
    assert_in_range(of.questions, 0, SUBSTEPS * most.questions + (most.questions > 0 ? 30 : 0));
    assert_in_range(of.calls, 1, SUBSTEPS * most.calls + 40);
    assert_in_range(of.waits, 0, most.waits + 1);
    assert_in_range(of.bytes, 1, SUBSTEPS * 16384); /* parts of sums, with the energy sums; no particles */
    world_destroy(world);
}

static void a_step_makes_so_many_calls(void **state)
{
    (void)state;
    WorldDef def = pool_on("compute", "mueller");
    count_step("compute, mueller", &def, (Bounds){10, 0, 55, 1});
    def.reproducible = true;
    count_step("compute, mueller, reproducible", &def, (Bounds){11, 0, 60, 1});
    def = pool_on("compute", "wcsph");
    count_step("compute, wcsph", &def, (Bounds){12, 0, 67, 1});
    wcsph_def(&def)->delta_sph = wcsph_def(&def)->shifting = 0.1;
    count_step("compute, wcsph, delta_sph, shifting", &def, (Bounds){14, 0, 77, 1});
    /* A wait each solver and step: it asks at once for as many iterations as the step before had, and more.
       The first step is guessed, and the many iterations of the world's first steps have not faded yet. */
    def = pool_on("compute", "dfsph");
    def.dt = 0.002;
    dfsph_def(&def)->iterations = 1;
    count_step("compute, dfsph, one iteration each", &def, (Bounds){31, 0, 155, 9});
    dfsph_def(&def)->iterations = 100;
    dfsph_def(&def)->tolerance = dfsph_def(&def)->divergence_tolerance = 1e-6;
    def.reproducible = true; /* else iterations differ from run to run */
    count_step("compute, dfsph, reproducible", &def, (Bounds){62, 0, 274, 9});
    def = pool_on("compute", "pbf");
    def.dt = 1.0 / 60;
    count_step("compute, pbf", &def, (Bounds){45, 0, 190, 6});
    def = pool_on("fragment", "mueller");
    count_step("fragment, mueller", &def, (Bounds){44, 43, 370, 1}); /* the energy sums among them */
}

/* ---- guesses of solvers ---- */

/* A pool with a jet, a drain, a moving box and a floating solid. */
static WorldDef busy_def(const char *method)
{
    WorldDef def = pool_on("compute", method);
    def.reproducible = true;
    def.dt = 0.01;
    def.most = 3000;
    add_emit(&def.fluids[0],
             (Emit){.centre = {0.2, 0.5, 0}, .direction = {0, -1, 0}, .radius = 0.06, .speed = 1});
    add_drain(&def, (Fill){.kind = FILL_BLOCK, .min = {0.3, 0, -0.25}, .max = {0.4, 0.1, 0.25}});
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.01, .frequency = 1});
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0.1, 0.25, 0}, .radius = 0.12, .density = 500};
    def.fluids[0].viscosity = 100;
    def.viscosity_solver = VISCOSITY_IMPLICIT;
    return def;
}

/* With `few` the solvers are expected to end at once. Returns true if a guess was wrong. */
static bool step_and_guess(World *world, bool few)
{
    ComputeSolves *solves = &((Compute *)world->state)->solves;
    const uint64_t before = solves->wrong;
    for (int k = 0; few && k < SOLVES_MAX; k++)
        solves->budgets[k] = (ComputeBudget){{1}};
    fixture_step(world, 1);
    return solves->wrong > before;
}

/* The same bits as of a world without guesses: without a sentinel there is no state to begin again from. */
static void a_wrong_guess_leaves_no_trace(void **state)
{
    enum { FRAMES = 24 };
    static const char *const methods[] = {"pbf", "dfsph"};
    (void)state;
    for (int m = 0; m < 2; m++) {
        WorldDef def = busy_def(methods[m]);
        int wrong = 0;
        World *guesses = fixture_world(&def);
        def.retries = 0;
        World *waits = fixture_world(&def);
        for (int k = 0; k < FRAMES; k++) {
            wrong += step_and_guess(guesses, k % 3 == 2);
            fixture_step(waits, 1);
            if (world_hash(guesses) != world_hash(waits))
                fail_msg("%s: frame %d differs, after %d wrong guesses", methods[m], k, wrong);
        }
        const WorldInfo one = info_of(guesses), two = info_of(waits);
        printf("%s: %d of %d guesses wrong; %zu particles, %lu drained\n", methods[m], wrong, FRAMES,
               one.count, (unsigned long)one.drained);
        assert_true(one.solved.steps == two.solved.steps &&
                    one.solved.iterations_mean == two.solved.iterations_mean &&
                    one.solved.density_error_mean == two.solved.density_error_mean);
        assert_in_range(wrong, 1, FRAMES / 2);
        world_destroy(guesses);
        world_destroy(waits);
    }
}

/* ---- new lists within a step ---- */

/* Fluid that falls onto the floor moves further than lists reach: new lists, and the CPU's iterations. */
static void new_lists_are_those_of_the_cpu(void **state)
{
    enum { FRAMES = 4 };
    (void)state;
    WorldDef def = pool_on("compute", "pbf");
    def.dt = 1.0 / 60;
    def.reproducible = true;
    def.fluids[0].velocity[1] = -4;
    World *guesses = world_on(def, "compute"), *cpu = world_on(def, "cpu");
    def.retries = 0;
    World *waits = world_on(def, "compute");
    const ComputeSolves *solves = &((const Compute *)guesses->state)->solves;
    for (int k = 0; k < FRAMES; k++) {
        fixture_step(guesses, 1);
        fixture_step(waits, 1);
        fixture_step(cpu, 1);
        const StepSolve one = info_of(guesses).solves[0], two = info_of(cpu).solves[0];
        printf("%g and %g iterations, mean %.4g and %.4g; second round: %.2g\n", one.iterations,
               two.iterations, one.mean, two.mean, solves->budgets[0].rounds[1]);
        assert_true(k > 0 || solves->budgets[0].rounds[1] >= 1);
        assert_true(one.iterations == two.iterations && fabs(one.mean - two.mean) < 0.01 * two.mean);
        assert_true(world_hash(guesses) == world_hash(waits));
    }
    assert_true(solves->right > 0);
    world_destroy(guesses);
    world_destroy(waits);
    world_destroy(cpu);
}

/* ---- sums of a solver ---- */

/* With room for more particles, and particles in more than the least number of groups: the CPU's residuals.
 */
static void many_groups_sum_as_the_cpu(void **state)
{
    (void)state;
    WorldDef def = pool_on("compute", "dfsph");
    def.spacing = 0.025;
    def.dt = 0.002;
    def.most = 100000;
    add_emit(&def.fluids[0],
             (Emit){.centre = {0, 0.5, 0}, .direction = {0, -1, 0}, .radius = 0.05, .speed = 1, .start = 9});
    World *gpu = world_on(def, "compute"), *cpu = world_on(def, "cpu");
    fixture_step(gpu, 2);
    fixture_step(cpu, 2);
    const WorldInfo one = info_of(gpu), two = info_of(cpu);
    assert_in_range(one.count, 64 * COMPUTE_GROUP + 1, 100000);
    for (int k = 0; k < SOLVES_OF_METHOD; k++) {
        const StepSolve *a = &one.solves[k], *b = &two.solves[k];
        printf("%g and %g iterations, mean %.4g and %.4g, most %.4g and %.4g\n", a->iterations, b->iterations,
               a->mean, b->mean, a->most, b->most);
        assert_true(a->iterations == b->iterations && b->mean > 0);
        assert_true(fabs(a->mean - b->mean) < 0.01 * b->mean && fabs(a->most - b->most) < 0.05 * b->most);
    }
    world_destroy(gpu);
    world_destroy(cpu);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_step_makes_so_many_calls, no_gl_errors),
        cmocka_unit_test_teardown(a_wrong_guess_leaves_no_trace, no_gl_errors),
        cmocka_unit_test_teardown(new_lists_are_those_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(many_groups_sum_as_the_cpu, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.calls", tests, compare_setup, context_teardown);
}
