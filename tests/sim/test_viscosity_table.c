/* A viscosity that is a table over time: how flows decay, how long steps may be, what a state needs. */
#include "fixture.h"

#include "sim/state.h"
#include "sim/step/constants.h"

static Error error;

static void must(bool ok)
{
    if (!ok)
        fail_msg("%s", error.message);
}

/* 3,000 Pa s, then a fall to 200, a rise to 1,000. */
static const TimeTable up_and_down = {4, {0, 0.05, 0.15, 0.2}, {3000, 3000, 200, 1000}};

enum { SIDE = 12, COUNT = SIDE * SIDE };
static const double EDGE = 1.2;

/* Taylor and Green's vortex, one cell in a full square without gravity; free-slip walls are lines of
 * symmetry. */
static WorldDef vortex_def(float x[3 * COUNT], float v[3 * COUNT], InitialState *initial)
{
    WorldDef def = fixture_def(EDGE, EDGE, 0);
    def.dimensions = 2;
    def.support = 2.6;
    *world_threads(&def) = 1;
    def.gravity[1] = 0;
    def.dt = 0.001;
    def.fluids[0].density = 2000;
    for (int i = 0; i < COUNT; i++) {
        const int row = i / SIDE;
        const double p = (i % SIDE + 0.5) / SIDE, q = (row + 0.5) / SIDE;
        x[3 * i] = (float)((p - 0.5) * EDGE);
        x[3 * i + 1] = (float)(q * EDGE);
        v[3 * i] = (float)(0.01 * sin(M_PI * p) * cos(M_PI * q));
        v[3 * i + 1] = (float)(-0.01 * cos(M_PI * p) * sin(M_PI * q));
        x[3 * i + 2] = v[3 * i + 2] = 0;
    }
    *initial = (InitialState){.count = COUNT, .position = x, .velocity = v};
    def.initial = initial;
    return def;
}

static double amplitude(World *world)
{
    State s = fixture_read(world);
    double sum = 0;
    for (size_t i = 0; i < s.count; i++) {
        const float *x = &s.position[4 * i], *v = &s.velocity[4 * i];
        const double p = x[0] / EDGE + 0.5, q = x[1] / EDGE;
        sum += v[0] * sin(M_PI * p) * cos(M_PI * q) - v[1] * cos(M_PI * p) * sin(M_PI * q);
    }
    fixture_free(&s);
    return sum / COUNT;
}

/* Minus the logarithm of what is left after 0.25 s. */
static double decay(const WorldDef *def)
{
    World *world = fixture_world(def);
    const double before = amplitude(world);
    fixture_step(world, 250);
    const double left = amplitude(world) / before;
    world_destroy(world);
    return -log(left);
}

/* By 2 nu (pi / a)^2 t, which depends only on the time integral of the viscosity; a sixth less here,
   without drag behind free-slip walls. */
static void flows_decay_by_the_integral(void **state)
{
    (void)state;
    float x[3 * COUNT], v[3 * COUNT];
    InitialState initial;
    WorldDef def = vortex_def(x, v, &initial);
    const double integral = 0.05 * 3000 + 0.1 * 1600 + 0.05 * 600 + 0.05 * 1000; /* Pa s s */
    def.fluids[0].viscosity = integral / 0.25;
    const double mean = decay(&def);
    def.fluids[0].viscosity = 0;
    def.fluids[0].viscosity_table = up_and_down;
    const double table = decay(&def), exact = 2 * integral / 2000 * pow(M_PI / EDGE, 2);
    if (!(fabs(table / mean - 1) < 0.004) || !(fabs(table / exact - 1) < 0.2))
        fail_msg("decay %g with the table, %g with its mean, %g by the formula", table, mean, exact);
}

static double viscosity_now(World *world)
{
    WorldNumbers numbers;
    WorldDef def = {.fluid_count = 1};
    world_save_numbers(world, &numbers);
    live_load(numbers.live, &def);
    return def.fluids[0].viscosity;
}

static double time_now(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    return info.time;
}

/* Mode cfl: each step is as long as the viscosity at its begin allows. */
static void steps_follow_the_viscosity(void **state)
{
    (void)state;
    float x[3 * COUNT], v[3 * COUNT];
    InitialState initial;
    WorldInfo info;
    int bound = 0;
    WorldDef def = vortex_def(x, v, &initial);
    TimeTable table = up_and_down;
    for (int k = 0; k < 4; k++)
        table.value[k] *= 10;
    def.fluids[0].viscosity_table = table;
    def.sound_speed = 2;
    def.step_mode = STEP_CFL;
    const StepFriction friction = step_friction(&def);
    World *world = fixture_world(&def);
    while (time_now(world) < 0.25) {
        const double mu = time_table_at(&table, time_now(world));
        fixture_step(world, 1);
        world_info(world, &info);
        if (info.limit != STEP_LIMIT_VISCOUS)
            continue;
        bound++;
        def.fluids[0].viscosity = mu;
        assert_true(fabs(info.dt / (2 * def.cfl_number * step_viscous(&def, &friction)) - 1) < 1e-6);
    }
    assert_true(bound > 100 && viscosity_now(world) == 10000);
    world_destroy(world);
}

/* Two viscous fluids, one of which thins, in a box half full. */
static WorldDef thinning_def(StepMode mode)
{
    WorldDef def = fixture_def(0.8, 0.8, 0.8);
    *world_threads(&def) = 1;
    def.retries = 3;
    def.step_mode = mode;
    def.fluid_count = 2;
    def.fluids[0].viscosity_table = (TimeTable){3, {0, 0.02, 0.1}, {900, 900, 20}};
    def.fluids[1] = (FluidDef){.name = "oil", .density = 700, .viscosity = 2};
    fixture_block(&def, 0, -0.4, 0, -0.4, 0, 0.4, 0.4);
    fixture_block(&def, 1, 0, 0, -0.4, 0.4, 0.3, 0.4);
    return def;
}

/* Save, load, step equals step; for any viscosity of the target world, the viscosity is of the state's
   time. */
static void a_state_has_its_viscosity(void **state)
{
    (void)state;
    for (int mode = STEP_FIXED; mode <= STEP_CFL; mode++) {
        const WorldDef def = thinning_def((StepMode)mode);
        World *straight = fixture_world(&def), *loaded = fixture_world(&def);
        WorldState saved = {.count = 0};
        WorldDef thick = def;
        thick.fluids[0].viscosity_table.rows = 0;
        thick.fluids[0].viscosity = 1500;
        fixture_step(straight, 25);
        must(world_save(straight, &saved, &error));
        const double now = viscosity_now(straight);
        assert_true(now > 20 && now < 900);
        assert_true(now == time_table_at(&def.fluids[0].viscosity_table, time_now(straight)));
        must(world_change(loaded, &thick, &error)); /* a number takes the table's place */
        fixture_step(loaded, 3);
        assert_true(viscosity_now(loaded) == 1500);
        must(world_load(loaded, &saved, &error));
        assert_true(viscosity_now(loaded) == now);
        fixture_step(straight, 20);
        fixture_step(loaded, 20);
        assert_true(time_now(straight) == time_now(loaded) && world_hash(straight) == world_hash(loaded));
        assert_true(viscosity_now(loaded) < now);
        world_state_free(&saved);
        world_destroy(straight);
        world_destroy(loaded);
    }
}

/* A table with a single row is a number; a world given the table later equals a world made with the
   table. */
static void a_table_may_come_and_go(void **state)
{
    (void)state;
    WorldDef table = thinning_def(STEP_FIXED), number = table, row = table;
    number.fluids[0].viscosity_table.rows = 0;
    number.fluids[0].viscosity = 300;
    row.fluids[0].viscosity_table = (TimeTable){1, {5}, {300}};
    World *a = fixture_world(&number), *b = fixture_world(&row), *c = fixture_world(&table);
    must(world_change(c, &number, &error));
    for (int k = 0; k < 2; k++) {
        fixture_step(a, 20);
        fixture_step(b, 20);
        fixture_step(c, 20);
        assert_true(world_hash(a) == world_hash(b) && world_hash(a) == world_hash(c));
        must(world_change(b, &table, &error));
        must(world_change(a, &table, &error));
        must(world_change(c, &table, &error));
    }
    world_destroy(a);
    world_destroy(b);
    world_destroy(c);
}

/* Thicker than the step stands: back, half the step, and on with the viscosity of that time. */
static void trouble_goes_back_in_time(void **state)
{
    (void)state;
    WorldDef def = thinning_def(STEP_FIXED);
    WorldInfo info;
    def.fluids[0].viscosity_table = (TimeTable){2, {0.02, 0.1}, {200, 9000}};
    World *world = fixture_world(&def);
    fixture_step(world, 100);
    world_info(world, &info);
    assert_true(info.trouble.count > 0);
    assert_true(viscosity_now(world) == time_table_at(&def.fluids[0].viscosity_table, info.time));
    world_destroy(world);
}

static void refuse(const TimeTable *table)
{
    WorldDef def = thinning_def(STEP_FIXED);
    World *world = fixture_world(&def);
    def.fluids[0].viscosity_table = *table;
    assert_false(world_change(world, &def, &error));
    assert_non_null(strstr(error.message, "table of viscosity"));
    assert_true(viscosity_now(world) == 900);
    world_destroy(world);
    assert_null(world_create(&def, &error));
}

static void nonsense_is_refused(void **state)
{
    (void)state;
    refuse(&(TimeTable){2, {1, 1}, {1, 1}});
    refuse(&(TimeTable){2, {0, 1}, {1, -1}});
    refuse(&(TimeTable){2, {0, NAN}, {1, 1}});
    refuse(&(TimeTable){1, {0}, {INFINITY}});
    refuse(&(TimeTable){TIME_TABLE_ROWS + 1, {0}, {1}});
    refuse(&(TimeTable){1.5, {0}, {1}});
}

static void between_rows_it_is_a_line(void **state)
{
    (void)state;
    const TimeTable *t = &up_and_down;
    assert_true(time_table_at(t, -1) == 3000 && time_table_at(t, 0.02) == 3000);
    assert_true(fabs(time_table_at(t, 0.1) - 1600) < 1e-9 && fabs(time_table_at(t, 0.19) - 840) < 1e-9);
    assert_true(time_table_at(t, 0.15) == 200 && time_table_at(t, 7) == 1000);
    assert_true(time_table_most(t) == 3000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(between_rows_it_is_a_line),  cmocka_unit_test(flows_decay_by_the_integral),
        cmocka_unit_test(steps_follow_the_viscosity), cmocka_unit_test(a_state_has_its_viscosity),
        cmocka_unit_test(a_table_may_come_and_go),    cmocka_unit_test(trouble_goes_back_in_time),
        cmocka_unit_test(nonsense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
