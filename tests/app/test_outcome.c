/* Outcomes of made-up histories; findings of a look at places, and at failing worlds. */
#include "tests/sim/fixture.h"

#include "app/run/measure/measure.h"
#include "sim/methods/wcsph/wcsph.h"

#include <jansson.h>

static OutcomeHistory history;
static Outcome outcome;

/* Ten looks at a thousand particles with constant energy, as with a good solver. */
static int calm(void **state)
{
    (void)state;
    history = (OutcomeHistory){.count = 10};
    for (int i = 0; i < history.count; i++)
        history.look[i] = (OutcomeSample){
            .time = 0.1 * i, .count = 1000, .energy = 100 + 0.02 * i, .scale = 100 + 0.02 * i};
    return 0;
}

static void expect(OutcomeKind kind, double time, const char *text)
{
    char words[OUTCOME_TEXT];
    outcome_judge(&history, &outcome);
    assert_string_equal(outcome_text(&outcome, words), text);
    assert_int_equal(outcome.kind, kind);
    if (isfinite(time))
        assert_true(fabs(outcome.time - time) < 1e-9);
    else
        assert_true(isnan(outcome.time));
}

static void what_keeps_its_energy_holds(void **state)
{
    (void)state;
    expect(OUTCOME_HOLDS, (double)NAN, "holds");
    for (int i = 0; i < history.count; i++)
        history.look[i].energy = (double)NAN; /* a shaken box: unknown */
    expect(OUTCOME_HOLDS, (double)NAN, "holds");
    history.count = 0;
    expect(OUTCOME_HOLDS, (double)NAN, "holds");
    history.trouble = (WorldTrouble){.count = 2, .what = STEP_TROUBLE_SPEED}; /* halving helped */
    expect(OUTCOME_HOLDS, (double)NAN, "holds");
}

/* Energy that falls before growing is compared with the minimum; unknown values are skipped. */
static void energy_that_grows_is_noise(void **state)
{
    (void)state;
    for (int i = 0; i < 5; i++)
        history.look[i].energy = 100 - 2 * i;
    history.look[5].energy = (double)NAN;
    history.look[6].energy = 92 + 0.9 * OUTCOME_GAIN * 100;
    for (int i = 7; i < 10; i++)
        history.look[i].energy = 92;
    expect(OUTCOME_HOLDS, (double)NAN, "holds");
    history.look[8].energy = 92 + 1.2 * OUTCOME_GAIN * history.look[8].scale;
    history.look[9].energy = 150;
    expect(OUTCOME_NOISY, 0.8, "noisy at t = 0.8 s: energy grows without work done: 6 %");
}

static void fluid_that_loses_volume_is_squeezed(void **state)
{
    (void)state;
    history.look[3].pressed = 0.9 * OUTCOME_PRESSED;
    expect(OUTCOME_HOLDS, (double)NAN, "holds");
    history.look[4].pressed = 1.2 * OUTCOME_PRESSED;
    history.look[5].pressed = 0.5;
    expect(OUTCOME_SQUEEZED, 0.4,
           "squeezed at t = 0.4 s: fluid has lost volume: it is pressed by 6 % in the mean");
}

static void neighbours_that_move_in_all_directions_boil(void **state)
{
    (void)state;
    for (int i = 0; i < history.count; i++)
        history.look[i].together = 0.9 * OUTCOME_TOGETHER; /* of fluid that is as good as at rest */
    history.look[3].together = 1.1 * OUTCOME_TOGETHER;
    history.look[3].jump = 1.1;
    expect(OUTCOME_HOLDS, (double)NAN, "holds");
    history.look[6].jump = 1.1;
    expect(
        OUTCOME_BOILS, 0.6,
        "boils at t = 0.6 s: neighbours move in all directions, as in a gas: 82 % of their energy of motion");
}

static void who_is_faster_than_sound_is_too_fast(void **state)
{
    (void)state;
    history.look[3].fastest = 1e3; /* without sound */
    for (int i = 4; i < history.count; i++)
        history.look[i].sound = 20;
    history.look[4].fastest = 19.9;
    expect(OUTCOME_HOLDS, (double)NAN, "holds");
    history.look[5].fastest = 30;
    history.look[6].fastest = 40;
    expect(OUTCOME_FAST, 0.5, "too fast at t = 0.5 s: a particle moves at 30 m/s, and sound at 20 m/s");
}

static void particles_on_each_other_clump(void **state)
{
    (void)state;
    for (int i = 0; i < history.count; i++)
        history.look[i].close = 300; /* the begin */
    history.look[4].close = 300 + 95;
    expect(OUTCOME_HOLDS, (double)NAN, "holds");
    history.look[5].close = history.look[6].close = 300 + 105;
    expect(OUTCOME_CLUMPS, 0.5,
           "clumps at t = 0.5 s: 40.5 % of the particles are nearer than 0.2 spacings to another");
    history.look[9].energy = 200; /* noise is less */
    assert_true(outcome.kind == OUTCOME_CLUMPS);
}

static void particles_beyond_walls_are_a_leak(void **state)
{
    (void)state;
    history.look[2].close = 900;
    history.look[3].beyond = 1;
    expect(OUTCOME_CLUMPS, 0.2,
           "clumps at t = 0.2 s: 90 % of the particles are nearer than 0.2 spacings to another");
    history.look[4].beyond = 2;
    expect(OUTCOME_LEAKS, 0.4, "leaks at t = 0.4 s: 2 of 1000 particles are beyond a wall");
    history.look[3].lost = 5;
    expect(OUTCOME_LEAKS, 0.3, "leaks at t = 0.3 s: 5 of 1000 particles have no place in the grid");
}

static void solvers_that_are_stuck_do_not_converge(void **state)
{
    (void)state;
    history.look[1].beyond = 100;
    history.look[7].stuck = true;
    expect(OUTCOME_DIVERGES, 0.7, "does not converge at t = 0.7 s: a solver does not converge");
}

/* Whatever was seen before. */
static void trouble_that_ends_a_run_is_its_kind(void **state)
{
    (void)state;
    static const struct {
        StepTrouble what;
        OutcomeKind kind;
    } ends[] = {{STEP_TROUBLE_SPEED, OUTCOME_BLOWN_UP},
                {STEP_TROUBLE_DENSITY, OUTCOME_BLOWN_UP},
                {STEP_TROUBLE_ENERGY, OUTCOME_NOISY},
                {STEP_TROUBLE_LOST, OUTCOME_LEAKS},
                {STEP_TROUBLE_MEMORY, OUTCOME_NONE}};
    history.look[1].stuck = true;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        char text[OUTCOME_TEXT];
        history.trouble = (WorldTrouble){.ended = true, .what = ends[i].what, .time = 0.25};
        snprintf(text, sizeof text, "%s at t = 0.25 s: %s", outcome_word(ends[i].kind),
                 step_trouble_words(ends[i].what));
        expect(ends[i].kind, 0.25, text);
    }
    static const MethodSolver solver = {"density", "solver.tolerance", "solver.iterations"};
    history.trouble = (WorldTrouble){.ended = true, .what = STEP_TROUBLE_SOLVE, .time = 1, .solver = &solver};
    expect(
        OUTCOME_DIVERGES, 1,
        "does not converge at t = 1 s: the solver of density does not converge: solver.iterations 0 leaves 0 % "
        "in the mean, solver.tolerance is 0 %");
}

static void words_are_the_same_everywhere(void **state)
{
    (void)state;
    for (int k = 0; k < OUTCOME_COUNT; k++)
        assert_int_equal(outcome_of_word(outcome_word((OutcomeKind)k)), k);
    assert_int_equal(outcome_of_word("fine"), OUTCOME_COUNT);
    outcome_not_run("no memory, or no GPU\nat all", &outcome);
    json_t *json = json_object();
    outcome_json(json, &outcome);
    assert_string_equal(json_string_value(json_object_get(json, "outcome")), "not run");
    assert_true(json_is_null(json_object_get(json, "outcome_time")));
    assert_string_equal(json_string_value(json_object_get(json, "outcome_words")),
                        "no memory, or no GPU at all");
    json_decref(json);
}

static double together(const Cloud *cloud, double h, size_t stride)
{
    double common = -1, kinetic = -1;
    assert_true(metric_common_motion(cloud, h, stride, &common, &kinetic));
    return kinetic > 0 ? common / kinetic : 1;
}

/* A current, a gas, and both, against all pairs. */
static void motion_together_is_that_of_all_pairs(void **state)
{
    (void)state;
    enum { N = 700 };
    static float position[4 * N], velocity[4 * N];
    const double h = 0.15, current[3] = {1, -2, 0.5};
    const Cloud cloud = {.count = N, .spacing = 0.05, .position = position, .velocity = velocity};
    uint32_t seed = 1;
    for (int kind = 0; kind < 3; kind++) {
        double alike = 0, all = 0;
        for (size_t i = 0; i < 4 * N; i++) {
            seed = seed * 1664525U + 1013904223U;
            const double random = (double)(seed >> 8) / 0x1p24 - 0.5;
            if (kind == 0)
                position[i] = (float)(0.6 * random);
            velocity[i] =
                (float)((kind > 0 ? 4 * random : 0) + (kind != 1 && i % 4 < 3 ? current[i % 4] : 0));
        }
        for (size_t i = 0; i < N; i += 3) {
            double sum[3] = {0}, weights = 0;
            for (size_t j = 0; j < N; j++) {
                double r2 = 0;
                for (size_t k = 0; k < 3; k++)
                    r2 += pow((double)position[4 * i + k] - (double)position[4 * j + k], 2);
                const double weight = i == j ? 0 : fmax(1 - sqrt(r2) / h, 0);
                for (size_t k = 0; k < 3; k++)
                    sum[k] += weight * (double)velocity[4 * j + k];
                weights += weight;
            }
            for (size_t k = 0; k < 3; k++) {
                const double v = (double)velocity[4 * i + k];
                all += v * v;
                alike += v * (weights > 0 ? sum[k] / weights : v);
            }
        }
        printf("%d: %.3f together\n", kind, alike / all);
        assert_true(fabs(together(&cloud, h, 3) - alike / all) < 1e-9);
        assert_true(kind == 0 ? alike / all > 0.999 : kind == 1 ? alike / all < 0.1 : alike / all > 0.3);
    }
    memset(velocity, 0, sizeof velocity);
    assert_true(together(&cloud, h, 1) == 1);
}

/* A block of a lattice with pairs in it, against all pairs. */
static void close_particles_are_those_of_all_pairs(void **state)
{
    (void)state;
    enum { N = 600 };
    static float position[4 * N], other[4 * N];
    const double limit = 0.03;
    Cloud cloud = {.count = N, .spacing = 0.1, .position = position};
    uint32_t seed = 1;
    size_t close, by_hand = 0;
    for (size_t i = 0; i < 4 * N; i++) {
        seed = seed * 1664525U + 1013904223U;
        position[i] = (float)((double)(seed >> 8) / 0x1p24 - 0.5) * 0.6f;
    }
    position[4] = NAN;
    for (size_t i = 0; i < N; i++) {
        bool is = false;
        for (size_t j = 0; j < N; j++) {
            double r2 = 0;
            for (size_t k = 0; k < 3; k++)
                r2 += pow((double)position[4 * i + k] - (double)position[4 * j + k], 2);
            is |= i != j && r2 < limit * limit;
        }
        by_hand += is;
    }
    assert_true(metric_close(&cloud, limit, 1, &close));
    assert_int_equal(close, by_hand);
    assert_true(close > 20 && close < N - 20);
    size_t some = 0;
    for (size_t i = 0; i < N; i += 7) /* each seventh, against all */
        for (size_t j = 0, found = 0; j < N && !found; j++) {
            double r2 = 0;
            for (size_t k = 0; k < 3; k++)
                r2 += pow((double)position[4 * i + k] - (double)position[4 * j + k], 2);
            some += found = i != j && r2 < limit * limit;
        }
    assert_true(metric_close(&cloud, limit, 7, &close));
    assert_int_equal(close, some);
    cloud.position = other; /* all at a place */
    assert_true(metric_close(&cloud, limit, 1, &close));
    assert_int_equal(close, N);
    cloud.count = 1;
    assert_true(metric_close(&cloud, limit, 1, &close));
    assert_int_equal(close, 0);
}

/* A tank with a far too long step ends with a readable trouble. */
static void a_world_that_ends_says_of_what(void **state)
{
    (void)state;
    Error error = {{0}};
    WorldDef def = fixture_def(1, 1, 1);
    fixture_block(&def, 0, -0.5, 0, -0.5, 0, 0.5, 0.5);
    def.dt = 0.2;
    def.substeps = 1;
    World *world = world_create(&def, &error);
    assert_non_null(world);
    history = (OutcomeHistory){.count = 0};
    assert_true(outcome_sample(&history, &def, false, world));
    assert_int_equal(history.look[0].close, 0);
    assert_int_equal(history.look[0].beyond, 0);
    assert_true(isfinite(history.look[0].energy) && history.look[0].scale >= history.look[0].energy);
    for (int i = 0; i < 200 && world_step(world, NULL, &error); i++)
        continue;
    outcome_end(&history, world);
    world_destroy(world);
    assert_true(history.trouble.ended);
    outcome_judge(&history, &outcome);
    assert_true(outcome.kind == OUTCOME_BLOWN_UP || outcome.kind == OUTCOME_NOISY);
    assert_true(outcome.time > 0 && strstr(error.message, outcome.words));
}

/* ---- the watch over a run: findings for a calm world are set by the def ---- */

static World *world;
static WorldDef calm_def;
static FluidWatch watch;
static char said[FLUID_WATCH_WORDS];

static int calm_world(void **state)
{
    (void)state;
    calm_def = fixture_def(1, 1, 1);
    fixture_block(&calm_def, 0, -0.5, 0, -0.5, 0.5, 0.5, 0.5);
    world = fixture_world(&calm_def);
    watch = (FluidWatch){0};
    return 0;
}

static int end_world(void **state)
{
    (void)state;
    world_destroy(world);
    return 0;
}

static bool look_now(const WorldDef *def)
{
    watch.next = 0;
    return fluid_watch(&watch, def, world, said);
}

/* Its fluid is half as dense at rest. */
static WorldDef squeezed_def(void)
{
    WorldDef def = calm_def;
    def.fluids[0].density = 500;
    return def;
}

/* A ball is where the fluid is. */
static WorldDef leaking_def(void)
{
    WorldDef def = squeezed_def();
    def.solids[def.solid_count++] = (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.25, 0}, .radius = 0.2};
    return def;
}

/* All lattice neighbours are close together. */
static WorldDef clumped_def(void)
{
    WorldDef def = calm_def;
    def.spacing = 10 * calm_def.spacing;
    return def;
}

static void looks_come_at_their_steps(void **state)
{
    (void)state;
    Error error = {{0}};
    const WorldTrouble none = {.count = 0};
    const WorldDef squeezed = squeezed_def();
    assert_false(fluid_watch_outcome(&watch, &none, &outcome));
    assert_false(fluid_watch(&watch, &calm_def, world, said));
    assert_int_equal(watch.next, FLUID_WATCH_STEPS);
    for (int k = 1; k < FLUID_WATCH_STEPS; k++) {
        assert_true(world_step(world, NULL, &error));
        assert_false(fluid_watch(&watch, &squeezed, world, said));
    }
    assert_true(fluid_watch_outcome(&watch, &none, &outcome) && outcome.kind == OUTCOME_HOLDS);
    assert_true(world_step(world, NULL, &error) && fluid_watch(&watch, &squeezed, world, said));
}

/* At the first step, and once. */
static void what_is_faster_than_sound_is_told(void **state)
{
    (void)state;
    Error error = {{0}};
    WorldDef slow = calm_def;
    WorldInfo info;
    assert_false(fluid_watch(&watch, &calm_def, world, said));
    assert_true(world_step(world, NULL, &error));
    world_info(world, &info);
    assert_true(info.fastest > 0);
    slow.sound_speed = 1.01 * info.fastest;
    assert_false(fluid_watch(&watch, &slow, world, said));
    slow.sound_speed = 0.99 * info.fastest;
    assert_true(fluid_watch(&watch, &slow, world, said) && strstr(said, "too fast: a particle moves at"));
    assert_false(fluid_watch(&watch, &slow, world, said));
    assert_true(fluid_watch_outcome(&watch, &info.trouble, &outcome) && outcome.kind == OUTCOME_FAST);
}

/* Troubles at the start do not hide later troubles. */
static void each_kind_is_told_once(void **state)
{
    (void)state;
    const WorldDef leaking = leaking_def(), squeezed = squeezed_def(), clumped = clumped_def();
    assert_true(look_now(&leaking) && strstr(said, "s: leaks: ") &&
                strstr(said, "are beyond a wall; use shorter"));
    assert_true(look_now(&leaking) &&
                strstr(said, "t = 0 s: squeezed: fluid has lost volume: it is pressed by"));
    assert_non_null(strstr(said, "in the mean; use a higher solver.sound_speed"));
    assert_false(look_now(&leaking));
    assert_false(look_now(&squeezed));
    assert_true(look_now(&clumped) && strstr(said, "s: clumps: "));
    assert_false(look_now(&clumped) || look_now(&calm_def));
}

/* Compared with the minimum of the whole run, however slow the growth; unknown for runs without outside
   action. */
static void energy_is_followed_where_nothing_else_acts(void **state)
{
    (void)state;
    WorldDef lifted = calm_def;
    watch.closed = true;
    assert_false(look_now(&calm_def));
    assert_true(watch.start.energy > 0);
    const double energy = watch.start.energy;
    assert_true(energy > 0.2 * 500 * 9.81 * 0.25 && energy < 5 * 500 * 9.81 * 0.25); /* of 500 kg */
    watch.start.energy = energy - 0.5 * OUTCOME_GAIN * 500 * 9.81 * 0.25;
    assert_false(look_now(&calm_def));
    watch.start.energy = energy - 3 * OUTCOME_GAIN * 500 * 9.81 * 0.25;
    assert_true(look_now(&calm_def) && strstr(said, "noisy: energy grows without work done: "));
    assert_non_null(strstr(said, "; use shorter steps"));
    assert_false(look_now(&calm_def));
    assert_true(fluid_watch_outcome(&watch, &(WorldTrouble){.count = 0}, &outcome));
    assert_int_equal(outcome.kind, OUTCOME_NOISY);
    watch = (FluidWatch){.closed = false};
    assert_false(look_now(&calm_def));
    assert_true(isnan(watch.start.energy));
    watch = (FluidWatch){.closed = true};
    lifted.motion_count = 1;
    assert_false(look_now(&lifted));
    assert_true(isnan(watch.start.energy));
}

/* Normal at a scene's start, but not in a resumed run. */
static void what_starts_close_is_no_clump(void **state)
{
    (void)state;
    const WorldDef clumped = clumped_def();
    assert_false(look_now(&clumped) || look_now(&clumped));
    watch = (FluidWatch){.resumed = true};
    assert_true(look_now(&clumped) && strstr(said, "s: clumps: "));
}

static void advice_fits_the_kernel(void **state)
{
    (void)state;
    WorldDef clumped = clumped_def();
    static const struct {
        const char *method, *kernel, *advice;
    } cases[] = {{"wcsph", "cubic", "; use solver.kernel wendland_c2 with"},
                 {"wcsph", "wendland_c2", "; use a larger particles.support, or solver.shifting"},
                 {"mueller", NULL, "; use a particles.support of 2.5 or less, or shorter steps"},
                 {"dfsph", NULL, "; use a particles.support of 2.5 or less, or shorter steps"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        watch = (FluidWatch){.resumed = true};
        snprintf(clumped.method, sizeof clumped.method, "%s", cases[k].method);
        if (cases[k].kernel)
            snprintf(wcsph_def(&clumped)->kernel, NAME_SIZE, "%s", cases[k].kernel);
        assert_true(look_now(&clumped));
        assert_non_null(strstr(said, cases[k].advice));
    }
}

static void the_worst_stays_but_for_the_end(void **state)
{
    (void)state;
    const WorldDef leaking = leaking_def();
    const WorldTrouble none = {.count = 1}, end = {.ended = true, .what = STEP_TROUBLE_ENERGY, .time = 2};
    assert_true(look_now(&leaking));
    look_now(&calm_def);
    assert_true(fluid_watch_outcome(&watch, &none, &outcome) && outcome.kind == OUTCOME_LEAKS);
    assert_true(fluid_watch_outcome(&watch, &end, &outcome) && outcome.kind == OUTCOME_NOISY);
    watch = (FluidWatch){0};
    assert_true(fluid_watch_outcome(&watch, &end, &outcome) && outcome.kind == OUTCOME_NOISY);
}

#define WATCHED(test) cmocka_unit_test_setup_teardown(test, calm_world, end_world)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(what_keeps_its_energy_holds, calm),
        cmocka_unit_test_setup(energy_that_grows_is_noise, calm),
        cmocka_unit_test_setup(fluid_that_loses_volume_is_squeezed, calm),
        cmocka_unit_test_setup(neighbours_that_move_in_all_directions_boil, calm),
        cmocka_unit_test_setup(who_is_faster_than_sound_is_too_fast, calm),
        cmocka_unit_test_setup(particles_on_each_other_clump, calm),
        cmocka_unit_test_setup(particles_beyond_walls_are_a_leak, calm),
        cmocka_unit_test_setup(solvers_that_are_stuck_do_not_converge, calm),
        cmocka_unit_test_setup(trouble_that_ends_a_run_is_its_kind, calm),
        cmocka_unit_test(words_are_the_same_everywhere),
        cmocka_unit_test(motion_together_is_that_of_all_pairs),
        cmocka_unit_test(close_particles_are_those_of_all_pairs),
        cmocka_unit_test(a_world_that_ends_says_of_what),
        WATCHED(looks_come_at_their_steps),
        WATCHED(what_is_faster_than_sound_is_told),
        WATCHED(each_kind_is_told_once),
        WATCHED(energy_is_followed_where_nothing_else_acts),
        WATCHED(what_starts_close_is_no_clump),
        WATCHED(advice_fits_the_kernel),
        WATCHED(the_worst_stays_but_for_the_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
