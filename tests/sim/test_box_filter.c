/* The box in the hand: within its limits, without overshoot, without a force that is not the world's. */
#include "fixture.h"
#include "tests/tolerance.h"

#include <string.h>

static const BoxTarget home = {.orientation = {0, 0, 0, 1}};

static BoxTarget turned(double x, double y, double z, const double axis[3], double degrees)
{
    const double half = degrees * M_PI / 360;
    return (BoxTarget){{x, y, z}, {axis[0] * sin(half), axis[1] * sin(half), axis[2] * sin(half), cos(half)}};
}

static double norm(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Any step size arrives, never beyond the target, never beyond a limit. */
static void filter_arrives_within_its_limits(void **state)
{
    (void)state;
    const double steps[] = {0.0005, 0.003, 0.02, 0.2};
    const BoxLimits limits = box_limits_default();
    const double axis[3] = {0, 0, 1};
    for (int s = 0; s < 4; s++) {
        const BoxTarget target = turned(0.7, 0, 0, axis, 90);
        BoxFilter filter = box_filter_at_rest();
        double before = 0, turn_before = 0;
        for (double t = 0; t < 4; t += steps[s]) {
            box_filter_step(&filter, &target, &limits, steps[s]);
            const double turn = 2 * atan2(filter.orientation[2], filter.orientation[3]) * 180 / M_PI;
            const double speed = norm(filter.velocity),
                         turn_speed = norm(filter.angular_velocity) * 180 / M_PI;
            assert_true(speed <= limits.speed * (1 + 1e-9));
            assert_true(fabs(speed - before) <= limits.acceleration * steps[s] * (1 + 1e-9));
            assert_true(turn_speed <= limits.turn_speed_deg * (1 + 1e-9));
            assert_true(fabs(turn_speed - turn_before) <=
                        limits.turn_acceleration_deg * steps[s] * (1 + 1e-9));
            if (steps[s] < 0.1) { /* a step longer than the response sees its target late */
                assert_true(filter.position[0] <= 0.7 * 1.05);
                assert_true(turn <= 90 * 1.05);
            }
            before = speed;
            turn_before = turn_speed;
        }
        assert_true(fabs(filter.position[0] - 0.7) < 1e-3);
        assert_true(fabs(2 * atan2(filter.orientation[2], filter.orientation[3]) - M_PI / 2) < 1e-3);
    }
}

/* The reversed quaternion is the same turn: the short way is taken. */
static void filter_turns_the_short_way(void **state)
{
    (void)state;
    const BoxLimits limits = box_limits_default();
    BoxTarget target = turned(0, 0, 0, (double[3]){1, 0, 0}, 20);
    for (int k = 0; k < 4; k++)
        target.orientation[k] = -target.orientation[k];
    BoxFilter filter = box_filter_at_rest();
    for (int i = 0; i < 1000; i++) {
        box_filter_step(&filter, &target, &limits, 0.002);
        assert_true(2 * acos(fmin(1, fabs(filter.orientation[3]))) * 180 / M_PI < 21);
    }
}

/* The rates are those of the pose, with a prescribed motion below. */
static void rates_are_derivatives(void **state)
{
    (void)state;
    const Motion rock = {.kind = MOTION_ROCK, .axis = {0, 0.3, 1}, .angle_deg = 25, .frequency = 0.8};
    const BoxLimits limits = box_limits_default();
    const BoxTarget target = turned(0.5, 0.1, -0.3, (double[3]){0.6, 0.8, 0}, 70);
    BoxFilter filter = box_filter_at_rest();
    const double e = 1e-5, point[3] = {0.3, 0.9, -0.2}, still[3] = {0};
    for (double t = 0; t < 0.6; t += e) {
        BoxState box[2];
        double x[2][3], v[2][3];
        for (int i = 0; i < 2; i++) {
            box_state_at(&rock, 1, 1.5, t + i * e, &box[i]);
            box_filter_apply(&filter, 1.5, &box[i]);
            box_to_world(&box[i], point, still, x[i], v[i]);
            if (i == 0)
                box_filter_step(&filter, &target, &limits, e);
        }
        for (int k = 0; k < 3; k++)
            if (fabs((x[1][k] - x[0][k]) / e - 0.5 * (v[0][k] + v[1][k])) > 1e-4)
                fail_msg("at t = %g component %d moves at %g, not %g", t, k, (x[1][k] - x[0][k]) / e,
                         v[0][k]);
    }
}

/* Through any movement of the hand a lone particle keeps to the parabola of the world. */
static void lone_particle_ignores_the_hand(void **state)
{
    (void)state;
    WorldDef def = fixture_def(8, 8, 8);
    def.dt = 0.018;
    def.substeps = 3;
    const float x0[3] = {0.5f, 4.5f, -0.3f}, v0[3] = {0.4f, 3, 0.3f};
    def.initial = &(InitialState){.count = 1, .position = x0, .velocity = v0};
    World *world = fixture_world(&def);
    for (int frame = 0; frame < 45; frame++) {
        const BoxTarget target =
            turned(0.5 * (frame % 3), 0, -0.4, (double[3]){0.6, 0, 0.8}, frame / 15 % 2 ? 40 : -30);
        world_set_target(world, &target);
        fixture_step(world, 1);
    }
    WorldInfo info;
    world_info(world, &info);
    State s = fixture_read(world);
    double x[3], v[3];
    box_to_world(&info.box, (double[3]){s.position[0], s.position[1], s.position[2]},
                 (double[3]){s.velocity[0], s.velocity[1], s.velocity[2]}, x, v);
    for (int k = 0; k < 3; k++) {
        const double t = info.time, fall = k == 1 ? -0.5 * 9.81 * t * t : 0;
        assert_true(fabs(x[k] - (x0[k] + v0[k] * t + fall)) < 1e-4 * 8);
    }
    assert_int_equal(info.guarded, 0);
    fixture_free(&s);
    world_destroy(world);
}

static WorldDef tank(void)
{
    WorldDef def = fixture_def(1.6, 1, 0.8);
    def.sound_speed = 15;
    def.dt = 0.012;
    def.substeps = 3;
    def.fluids[0].viscosity = 5;
    fixture_block(&def, 0, -0.8, 0, -0.4, 0.8, 0.5, 0.4);
    return def;
}

/* Shaken and turned to and fro as hard as the default limits allow, the box keeps every particle, and the
 * fluid moves. */
static void shaking_lets_nothing_out(void **state)
{
    (void)state;
    const WorldDef def = tank();
    World *world = fixture_world(&def);
    uint32_t seed = 4;
    double fastest = 0;
    for (int frame = 0; frame < 250; frame++) {
        if (frame % 8 == 0) {
            const double axis[3] = {fixture_random(&seed) < 0.5 ? 0.6 : -0.6, 0, 0.8};
            const BoxTarget target =
                turned(fixture_random(&seed) < 0.5 ? 3 : -3, fixture_random(&seed) - 0.5,
                       fixture_random(&seed) - 0.5, axis, 170 * fixture_random(&seed) - 85);
            world_set_target(world, &target);
        }
        fixture_step(world, 1);
        State s = fixture_read(world);
        for (size_t i = 0; i < s.count; i++) {
            const float *x = s.position + 4 * i;
            if (!(fabsf(x[0]) <= 0.8f && x[1] >= 0 && x[1] <= 1 && fabsf(x[2]) <= 0.4f))
                fail_msg("particle %zu is at %g %g %g in frame %d", i, x[0], x[1], x[2], frame);
        }
        fixture_free(&s);
        WorldSums sums;
        world_sums(world, &sums);
        fastest = fmax(fastest, sums.max_speed);
    }
    assert_true(fastest > 2);
    world_destroy(world);
}

/* Of the box's centre, which is what the hand moves. */
static void centre_velocity(const BoxState *box, const double size[3], double v[3])
{
    double arm[3], swirl[3];
    quat_rotate(box->orientation, (double[]){0, 0.5 * size[1], 0}, arm);
    cross_product(box->angular_velocity, arm, swirl);
    for (int k = 0; k < 3; k++)
        v[k] = box->velocity[k] + swirl[k];
}

static double change_of(const double before[3], const double after[3], double dt)
{
    return norm((double[]){after[0] - before[0], after[1] - before[1], after[2] - before[2]}) / dt;
}

/* A hand moving during a pause gives many targets and no step. Afterwards only the last target counts,
   and the box goes there within the limits, without a jump. */
static void what_waited_comes_within_the_limits(void **state)
{
    (void)state;
    const WorldDef def = tank();
    World *dragged = fixture_world(&def), *told = fixture_world(&def);
    BoxTarget target = home;
    WorldInfo info;
    double most = 0, most_turn = 0, v[2][3] = {{0}}, spin[3] = {0}, time = 0;
    for (int i = 1; i <= 100; i++) {
        target = turned(0.03 * i, 0, 0, (double[3]){0, 0, 1}, 0.9 * i);
        world_set_target(dragged, &target);
    }
    world_set_target(told, &target);
    for (int frame = 0; frame < 250; frame++) {
        fixture_step(dragged, 1);
        fixture_step(told, 1);
        world_info(dragged, &info);
        centre_velocity(&info.box, def.box_size, v[1]);
        most = fmax(most, change_of(v[0], v[1], info.time - time));
        most_turn = fmax(most_turn, change_of(spin, info.box.angular_velocity, info.time - time));
        memcpy(v[0], v[1], sizeof v[0]);
        memcpy(spin, info.box.angular_velocity, sizeof spin);
        time = info.time;
    }
    check_near(most, def.limits.acceleration, 0.01 * def.limits.acceleration, "the greatest acceleration");
    check_near(most_turn * 180 / M_PI, def.limits.turn_acceleration_deg,
               0.01 * def.limits.turn_acceleration_deg, "that of turning");
    check_near(info.hand.position[0], 3, 1e-3, "where it comes to rest");
    assert_int_equal(world_hash(dragged), world_hash(told));
    world_destroy(dragged);
    world_destroy(told);
}

/* A carried box takes the fluid along: no bit changes, and the run continues undisturbed. */
static void carry_is_not_felt(void **state)
{
    (void)state;
    const WorldDef def = tank();
    World *stays = fixture_world(&def), *carried = fixture_world(&def);
    fixture_step(stays, 20);
    fixture_step(carried, 20);
    const BoxTarget away = {.position = {4, 1, -2}, .orientation = {0, 0, 0, 1}};
    world_carry_box(carried, &away);
    assert_int_equal(world_hash(stays), world_hash(carried));
    fixture_step(stays, 20);
    fixture_step(carried, 20);
    assert_int_equal(world_hash(stays), world_hash(carried));
    WorldInfo info;
    world_info(carried, &info);
    assert_true(fabs(info.box.position[0] - 4) < 1e-12);
    world_destroy(stays);
    world_destroy(carried);
}

/* An invalid pose has no effect. */
static void nonsense_is_not_taken(void **state)
{
    (void)state;
    const WorldDef def = tank();
    World *world = fixture_world(&def), *other = fixture_world(&def);
    const BoxTarget bad[] = {{.position = {NAN, 0, 0}, .orientation = {0, 0, 0, 1}},
                             {.position = {0, 0, 0}},
                             {.orientation = {0, INFINITY, 0, 1}}};
    for (int i = 0; i < 3; i++) {
        world_set_target(world, &bad[i]);
        world_carry_box(world, &bad[i]);
    }
    world_set_target(other, &home);
    fixture_step(world, 5);
    fixture_step(other, 5);
    assert_int_equal(world_hash(world), world_hash(other));
    world_destroy(world);
    world_destroy(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(filter_arrives_within_its_limits),
        cmocka_unit_test(filter_turns_the_short_way),
        cmocka_unit_test(rates_are_derivatives),
        cmocka_unit_test(lone_particle_ignores_the_hand),
        cmocka_unit_test(shaking_lets_nothing_out),
        cmocka_unit_test(what_waited_comes_within_the_limits),
        cmocka_unit_test(carry_is_not_felt),
        cmocka_unit_test(nonsense_is_not_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
