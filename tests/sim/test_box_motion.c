/* The box as the frame of reference: against the parabola of the world's frame; sim.box_surface has the
 * surface of fluid. */
#include "tests/lists.h"

#include "fixture.h"

#include "sim/box/box.h"

/* A turn about a moving axis, and a shake: no quantity is constant in the box's frame. */
static const Motion wild[] = {
    {.kind = MOTION_SHAKE, .axis = {1, 0.5, 0.2}, .amplitude = 0.3, .frequency = 1.1},
    {.kind = MOTION_ROCK, .axis = {0.1, 0, 1}, .angle_deg = 40, .frequency = 0.7},
    {.kind = MOTION_SPIN, .axis = {0.3, 1, 0.2}, .rate = 1.3},
    {.kind = MOTION_TURN, .axis = {1, 0, 0}, .angle_deg = 70, .start = 0.1, .duration = 0.6},
    {.kind = MOTION_ACCELERATE, .axis = {0, 0, 1}, .acceleration = 1.5, .start = 0.2},
};
/* Motions that begin late and end. */
static const Motion passing[] = {
    {.kind = MOTION_SHAKE,
     .axis = {0, 0, 1},
     .amplitude = 0.2,
     .frequency = 2,
     .start = 0.1,
     .duration = 0.5},
    {.kind = MOTION_TURN, .axis = {0, 1, 0}, .angle_deg = 50, .start = 0.2, .duration = 0.3},
    {.kind = MOTION_ACCELERATE, .axis = {1, 0, 0}, .acceleration = 3, .start = 0.15, .duration = 0.4},
};
/* By tables, which begin late and end. */
static const Motion tables[] = {
    {.kind = MOTION_PATH, .axis = {0, 3, 4}, .table = {4, {0.1, 0.3, 0.6, 1}, {0, 0.1, -0.05, 0.02}}},
    {.kind = MOTION_TILT, .axis = {1, 0, 1}, .table = {3, {0.2, 0.5, 0.9}, {0, 40, 15}}},
    {.kind = MOTION_PATH, .axis = {1, 0, 0}, .held = 0.3},
};
enum { TABLES = sizeof tables / sizeof *tables };
enum { PASSING = sizeof passing / sizeof *passing };
enum { WILD = sizeof wild / sizeof *wild };

/* The rates are the derivatives of the poses. */
static void check_rates(const Motion *list, int count)
{
    for (double t = 0.01; t < 1.2; t += 0.037) {
        const double e = 1e-6, point[3] = {0.3, 0.2, -0.4}, still[3] = {0};
        BoxState before, now, after;
        box_state_at(list, count, 2, t - e, &before);
        box_state_at(list, count, 2, t, &now);
        box_state_at(list, count, 2, t + e, &after);
        double x0[3], x1[3], x[3], v[3], unused[3];
        box_to_world(&before, point, still, x0, unused);
        box_to_world(&after, point, still, x1, unused);
        box_to_world(&now, point, still, x, v);
        for (int k = 0; k < 3; k++)
            if (fabs((x1[k] - x0[k]) / (2 * e) - v[k]) > 1e-5)
                fail_msg("at t = %g component %d moves at %g, not %g", t, k, (x1[k] - x0[k]) / (2 * e), v[k]);
    }
}

/* No pose jumps, where a motion begins or ends neither. */
static void check_no_jump(const Motion *list, int count)
{
    const double point[3] = {0.3, 0.2, -0.4}, e = 1e-4;
    double before[3] = {0};
    for (double t = 0; t < 1.2; t += e) {
        BoxState box;
        double x[3];
        box_state_at(list, count, 2, t, &box);
        box_to_world(&box, point, NULL, x, NULL);
        for (int k = 0; k < 3; k++)
            if (t > 0 && fabs(x[k] - before[k]) > 10 * e)
                fail_msg("at t = %g component %d jumps by %g", t, k, x[k] - before[k]);
        memcpy(before, x, sizeof before);
    }
}

static void rates_are_derivatives(void **state)
{
    (void)state;
    check_no_jump(wild, WILD);
    check_no_jump(passing, PASSING);
    check_rates(wild, WILD);
    check_rates(passing, PASSING);
    check_no_jump(tables, TABLES);
    check_rates(tables, TABLES);
}

/* At a row the place is the row's; the speed is the mean from the row before to the row after, and 0 at the
   ends: a lone row is a place. */
static void tables_pass_through_their_rows(void **state)
{
    (void)state;
    const Motion *motion = &tables[0];
    const TimeTable *table = &motion->table;
    BoxState box;
    for (int k = 0; k < 4; k++) {
        const double slope = k > 0 && k < 3 ? (table->value[k + 1] - table->value[k - 1]) /
                                                  (table->time[k + 1] - table->time[k - 1])
                                            : 0;
        box_state_at(motion, 1, 0, table->time[k], &box);
        assert_float_equal(box.position[1], 0.6 * table->value[k], 1e-12);
        assert_float_equal(box.position[2], 0.8 * table->value[k], 1e-12);
        assert_float_equal(box.velocity[2], 0.8 * slope, 1e-12);
    }
    for (double t = 0; t < 1.2; t += 0.01) {
        box_state_at(motion, 1, 0, t, &box);
        assert_true(fabs(box.position[1]) <= 0.6 * motion_farthest(motion));
    }
    box_state_at(motion, 1, 0, 7, &box);
    assert_float_equal(box.position[2], 0.8 * 0.02, 1e-12);
    box_state_at(&tables[1], 1, 0, 0.5, &box);
    assert_float_equal(2 * acos(box.orientation[3]) * 180 / M_PI, 40, 1e-9);
    const Motion one = {.kind = MOTION_PATH, .axis = {1, 0, 0}, .table = {1, {0.5}, {0.25}}};
    box_state_at(&one, 1, 0, 0.1, &box);
    assert_float_equal(box.position[0], 0.25, 1e-12);
}

/* What a body at rest in the box feels is gravity less the acceleration of its place in the world. */
static void apparent_gravity_is_that_of_the_place(void **state)
{
    (void)state;
    const double gravity[3] = {0.5, -9.81, 0.2}, dt = 1e-3, still[3] = {0};
    const double points[3][3] = {{0, 0, 0}, {0.9, 1.7, -0.6}, {-0.8, 0.2, 1.1}};
    for (double t = 0.3; t < 1; t += 0.11) {
        BoxState box[3];
        for (int i = 0; i < 3; i++)
            box_state_at(wild, WILD, 2, t + (i - 1) * 0.5 * dt, &box[i]);
        ApparentGravity apparent;
        apparent_gravity(gravity, &box[0], &box[1], &box[2], dt, &apparent);
        for (int p = 0; p < 3; p++) {
            double x[3], v[2][3], felt[3], expected[3];
            for (int i = 0; i < 2; i++)
                box_to_world(&box[2 * i], points[p], still, x, v[i]);
            for (int k = 0; k < 3; k++)
                felt[k] = gravity[k] - (v[1][k] - v[0][k]) / dt;
            quat_rotate_inverse(box[1].orientation, felt, expected);
            const float at[3] = {(float)points[p][0], (float)points[p][1], (float)points[p][2]};
            float g[3];
            apparent_gravity_at(&apparent, at, g);
            for (int k = 0; k < 3; k++)
                if (fabs(g[k] - expected[k]) > 2e-3 * (10 + fabs(expected[k])))
                    fail_msg("t = %g, point %d: component %d is %g, not %g", t, p, k, g[k], expected[k]);
        }
    }
}

static void lone_particle_follows_the_parabola(void **state)
{
    (void)state;
    WorldDef def = fixture_def(8, 8, 8);
    def.spacing = fixture_coarse(0.05, 0.2);
    def.dt = 0.018;
    def.substeps = 3;
    fixture_layers(&def, 1);
    def.motion_count = WILD;
    def.motions = wild;
    const float x0[3] = {0.5f, 4.5f, -0.3f}, v0[3] = {0.4f, 2.5f, 0.3f};
    def.initial = &(InitialState){.count = 1, .position = x0, .velocity = v0};
    World *world = fixture_world(&def);

    BoxState box;
    box_state_at(wild, WILD, 8, 0, &box);
    double start[3], speed[3];
    box_to_world(&box, (double[3]){x0[0], x0[1], x0[2]}, (double[3]){v0[0], v0[1], v0[2]}, start, speed);
    double worst = 0;
    for (int frame = 0; frame < 50; frame++) {
        fixture_step(world, 1);
        WorldInfo info;
        world_info(world, &info);
        State s = fixture_read(world);
        double x[3], v[3];
        box_to_world(&info.box, (double[3]){s.position[0], s.position[1], s.position[2]},
                     (double[3]){s.velocity[0], s.velocity[1], s.velocity[2]}, x, v);
        const double t = info.time;
        for (int k = 0; k < 3; k++) {
            const double g = k == 1 ? -9.81 : 0;
            worst = fmax(worst, fabs(x[k] - (start[k] + speed[k] * t + 0.5 * g * t * t)));
            assert_true(fabs(v[k] - (speed[k] + g * t)) < 1e-4 * 10);
        }
        assert_int_equal(info.guarded, 0);
        fixture_free(&s);
    }
    printf("lone particle: worst %.2g of the box's size off its parabola after 0.9 s\n", worst / 8);
    assert_true(worst <= 1e-4 * 8);
    world_destroy(world);
}

/* A box in free fall: the fluid floats, to rounding. */
static void fluid_floats_in_free_fall(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1);
    fixture_block(&def, 0, -0.3, 0.3, -0.3, 0.3, 0.7, 0.3);
    add_motion(&def, (Motion){.kind = MOTION_ACCELERATE, .axis = {0, -1, 0}, .acceleration = 9.81});
    World *world = fixture_world(&def);
    WorldSums before, after;
    world_sums(world, &before);
    fixture_step(world, fixture_count(500, 100));
    world_sums(world, &after);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(after.centre[k] - before.centre[k]) < 1e-4);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates_are_derivatives),
        cmocka_unit_test(tables_pass_through_their_rows),
        cmocka_unit_test(apparent_gravity_is_that_of_the_place),
        cmocka_unit_test(lone_particle_follows_the_parabola),
        cmocka_unit_test(fluid_floats_in_free_fall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
