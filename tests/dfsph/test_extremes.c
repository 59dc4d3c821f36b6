/* dfsph under stress: a lid, a jet, boxes at the limits of a hand, a single particle, an unreachable
   tolerance. Worlds are small, and the sentinel is on. */
#include "tests/lists.h"
#include "tests/sim/fixture.h"

#include "sim/methods/dfsph/dfsph.h"
#include "sim/step/world.h"

static WorldDef def_in(int dimensions, double width, double height, double depth)
{
    WorldDef def = fixture_def(width, height, depth);
    strcpy(def.method, "dfsph");
    def.dimensions = dimensions;
    def.retries = 3;
    return def;
}

static void expect_no_trouble(const World *world)
{
    WorldInfo info;
    world_info(world, &info);
    if (info.trouble.count > 0)
        fail_msg("%s", step_trouble_words(info.trouble.what));
}

static void expect_inside(const WorldDef *def, const State *s)
{
    for (size_t i = 0; i < s->count; i++)
        for (int k = 0; k < def->dimensions; k++) {
            const double low = k == 1 ? 0 : -0.5 * def->box_size[k], x = (double)s->position[4 * i + k];
            assert_true(x >= low - 1e-6 && x <= low + def->box_size[k] + 1e-6);
        }
}

/* |p - rho0 g depth| over rho0 g H, in the mean, of a column that gravity presses against floor or lid. */
static double column_error(bool lid)
{
    WorldDef def = def_in(2, 0.6, 1.2, 0);
    const double low = lid ? 0.6 : 0;
    def.spacing = 0.05;
    def.gravity[1] = lid ? 9.81 : -9.81;
    def.fluids[0].viscosity = 20;
    dfsph_def(&def)->divergence_tolerance = 1e-5;
    fixture_block(&def, 0, -0.3, low, 0, 0.3, low + 0.6, 0);
    World *world = fixture_world(&def);
    fixture_step(world, 100);
    State s = fixture_read(world);
    double off = 0;
    expect_no_trouble(world);
    expect_inside(&def, &s);
    for (size_t i = 0; i < s.count; i++) {
        const double y = (double)s.position[4 * i + 1], depth = lid ? y - 0.6 : 0.6 - y;
        assert_true(depth > -0.01);
        off += fabs((double)s.pressure[i] - 9810 * depth) / (9810 * 0.6) / (double)s.count;
    }
    fixture_free(&s);
    world_destroy(world);
    return off;
}

static void a_column_hangs_on_the_lid_as_on_the_floor(void **state)
{
    (void)state;
    const double floor = column_error(false), lid = column_error(true);
    printf(
        "pressure of a column off by %.2f %% of rho0 g H in the mean on the floor, by %.2f %% on the lid\n",
        100 * floor, 100 * lid);
    assert_true(floor < 0.06 && lid < 0.06);
}

/* A jet falls on the floor of an empty box and spreads; what comes is neither pressed nor thrown about. */
static void a_jet_falls_on_the_floor(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        WorldDef def = def_in(dimensions, 1.6, 1, 0.4);
        def.spacing = 0.05;
        def.most = 2000;
        add_emit(&def.fluids[0],
                 (Emit){.centre = {0, 0.9, 0}, .direction = {0, -1, 0}, .radius = 0.12, .speed = 2});
        World *world = fixture_world(&def);
        fixture_step(world, 300);
        State s = fixture_read(world);
        WorldSums sums;
        WorldInfo info;
        world_sums(world, &sums);
        world_info(world, &info);
        printf("jet, %dD: %zu particles, fastest %.2f m/s, compression %.3f %%\n", dimensions, s.count,
               sums.max_speed, 100 * info.solved.density_error_mean);
        expect_no_trouble(world);
        expect_inside(&def, &s);
        assert_true(s.count > 100 && info.solved.density_error_mean < 0.0005);
        assert_true(sums.max_speed <
                    3 * sqrt(2 * 2 + 2 * 9.81 * 0.9)); /* along the floor: up to that of a wedge */
        fixture_free(&s);
        world_destroy(world);
    }
}

/* Target of a hand for the box: to and fro and around, beyond the box's limits. */
static BoxTarget wild_target(int dimensions, int step)
{
    const double turn = 0.05 * step, side = step / 40 % 2 ? 3 : -3;
    BoxTarget target = {.position = {side, 0.5 * side, dimensions == 3 ? -side : 0}};
    const double axis = dimensions == 3 ? sqrt(1.0 / 3) : 0;
    target.orientation[0] = axis * sin(0.5 * turn);
    target.orientation[1] = axis * sin(0.5 * turn);
    target.orientation[2] = (dimensions == 3 ? axis : 1) * sin(0.5 * turn);
    target.orientation[3] = cos(0.5 * turn);
    return target;
}

static void a_box_at_the_limits_of_a_hand_holds(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        WorldDef def = def_in(dimensions, 0.8, 0.6, 0.6);
        def.spacing = dimensions == 3 ? 0.1 : 0.04;
        def.dt = 0.004;
        fixture_block(&def, 0, -0.4, 0, -0.3, 0.4, 0.4, 0.3);
        World *world = fixture_world(&def);
        double fastest = 0;
        for (int step = 0; step < 250; step++) {
            const BoxTarget target = wild_target(dimensions, step);
            world_set_target(world, &target);
            fixture_step(world, 1);
            WorldSums sums;
            world_sums(world, &sums);
            fastest = fmax(fastest, sums.max_speed);
        }
        State s = fixture_read(world);
        WorldInfo info;
        world_info(world, &info);
        printf(
            "thrown about, %dD: fastest %.1f m/s, %.1f iterations a step, compression %.3f %%, %.1f %% at worst\n",
            dimensions, fastest, info.solved.iterations_mean, 100 * info.solved.density_error_mean,
            100 * info.solved.density_error_max);
        expect_no_trouble(world);
        expect_inside(&def, &s);
        assert_true(fastest > 3 && fastest < 40 && info.solved.density_error_mean < 0.001);
        fixture_free(&s);
        world_destroy(world);
    }
}

/* One particle falls on the floor, and lies there. */
static void one_particle_falls_and_lies(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const float x[] = {0.1F, 0.5F, 0};
        WorldDef def = def_in(dimensions, 1, 1, 1);
        def.initial = &(InitialState){.count = 1, .position = x};
        World *world = fixture_world(&def);
        fixture_step(world, 500);
        expect_no_trouble(world);
        State s = fixture_read(world);
        WorldSums sums;
        world_sums(world, &sums);
        assert_true(s.position[1] >= 0 && s.position[1] < 0.06F && sums.max_speed < 0.05);
        assert_true(s.position[0] == x[0] && s.position[2] == x[2]);
        fixture_free(&s);
        world_destroy(world);
    }
}

/* A tolerance of 0 uses all iterations, reports the residual, and ends. */
static void a_tolerance_of_nothing_ends(void **state)
{
    (void)state;
    for (int most = 1; most <= 40; most += 39) {
        WorldDef def = def_in(2, 0.8, 0.6, 0);
        def.spacing = 0.05;
        def.retries = 0;
        fixture_block(&def, 0, -0.4, 0, 0, 0, 0.4, 0);
        dfsph_def(&def)->tolerance = dfsph_def(&def)->divergence_tolerance = 0;
        dfsph_def(&def)->iterations = most;
        World *world = fixture_world(&def);
        fixture_step(world, 20);
        for (int k = 0; k < 2; k++) {
            const StepSolve *solve = &world->solves[k];
            assert_true(solve->iterations == most && solve->mean > 0 && solve->failed);
        }
        world_destroy(world);
    }
}

/* Steps by number become long in still fluid; without STEP_LIMIT_PRESSURE the column has a mean
   compression of 29 %. */
static void deep_fluid_at_rest_does_not_boil(void **state)
{
    (void)state;
    WorldDef def = def_in(3, 0.3, 1.5, 0.3);
    WorldInfo info;
    def.spacing = 0.05;
    def.step_mode = STEP_CFL;
    def.cfl_number = 0.3;
    def.max_dt = 0.02;
    fixture_block(&def, 0, -0.15, 0, -0.15, 0.15, 1, 0.15);
    World *world = fixture_world(&def);
    fixture_step(world, 250);
    State s = fixture_read(world);
    double pressed = 0;
    for (size_t i = 0; i < s.count; i++)
        pressed += fmax((double)s.density[i] / 1000 - 1, 0) / (double)s.count;
    world_info(world, &info);
    printf("steps of %.3g ms: pressed by %.3g %%\n", 1e3 * info.dt, 100 * pressed);
    assert_true(pressed < 0.001 && info.limited[STEP_LIMIT_PRESSURE] > 100);
    fixture_free(&s);
    world_destroy(world);
}

/* Friction at the end of a step damps boiling: steps are longer by the derived factor. At twice the step
   of fluid without friction 2.6 times longer steps still rest; 2.9 times boil. */
static void thick_fluid_stands_longer_steps(void **state)
{
    (void)state;
    WorldDef def = def_in(3, 0.3, 1.5, 0.3);
    WorldInfo info;
    def.spacing = 0.05;
    def.step_mode = STEP_CFL;
    def.cfl_number = 0.3;
    def.max_dt = 0.05;
    fixture_block(&def, 0, -0.15, 0, -0.15, 0.15, 1, 0.15);
    const double still = step_pressure(&def);
    def.fluids[0].viscosity = 80;
    assert_true(step_pressure(&def) == still);
    def.viscosity_solver = VISCOSITY_IMPLICIT;
    def.viscosity_tolerance = 0.02;
    const double longest = step_pressure(&def);
    World *world = fixture_world(&def);
    fixture_step(world, 150);
    State s = fixture_read(world);
    double pressed = 0;
    for (size_t i = 0; i < s.count; i++)
        pressed += fmax((double)s.density[i] / 1000 - 1, 0) / (double)s.count;
    world_info(world, &info);
    printf("steps of %.3g ms, %.3g times those without friction: pressed by %.3g %%\n", 1e3 * info.dt,
           longest / still, 100 * pressed);
    assert_true(longest > 1.5 * still && longest < 2 * still);
    assert_true(pressed < 0.001 && info.limited[STEP_LIMIT_PRESSURE] > 50);
    fixture_free(&s);
    world_destroy(world);
}

/* Particles at rest that stand far too close part by places, and by a fifth of a spacing a step at most. */
static void crowds_part_in_small_moves(void **state)
{
    (void)state;
    enum { EDGE = 6, COUNT = EDGE * EDGE * EDGE };
    static float x[3 * COUNT];
    WorldDef def = def_in(3, 2, 2, 2);
    double most = 0;
    memset(def.gravity, 0, sizeof def.gravity);
    def.dt = 1.0 / 60;
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 3; k++) {
            const int index = (int[]){i % EDGE, i / EDGE % EDGE, i / EDGE / EDGE}[k];
            x[3 * i + k] = (float)(0.7 * def.spacing * (index - 0.5 * EDGE) + (k == 1));
        }
    def.initial = &(InitialState){.count = COUNT, .position = x};
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    State s = fixture_read(world);
    for (int i = 0; i < COUNT; i++) {
        const float *to = s.position + (size_t)(4 * i);
        const double d[3] = {(double)to[0] - (double)x[3 * i], (double)to[1] - (double)x[3 * i + 1],
                             (double)to[2] - (double)x[3 * i + 2]};
        most = fmax(most, sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
    }
    printf("a crowd parts by %.3f spacings\n", most / def.spacing);
    assert_true(most > 0.15 * def.spacing && most < 0.201 * def.spacing);
    fixture_free(&s);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(deep_fluid_at_rest_does_not_boil),
        cmocka_unit_test(thick_fluid_stands_longer_steps),
        cmocka_unit_test(a_column_hangs_on_the_lid_as_on_the_floor),
        cmocka_unit_test(a_jet_falls_on_the_floor),
        cmocka_unit_test(a_box_at_the_limits_of_a_hand_holds),
        cmocka_unit_test(one_particle_falls_and_lies),
        cmocka_unit_test(a_tolerance_of_nothing_ends),
        cmocka_unit_test(crowds_part_in_small_moves),
    };
    return cmocka_run_group_tests_name("dfsph.extremes", tests, NULL, NULL);
}
