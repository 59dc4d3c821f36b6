/* A finger in the fluid: the impulse is force times time, on every backend and with every method; no
   sentinel trouble; part of the saved state. */
#include "tests/touch/touch_rig.h"

#include "app/run/offscreen.h"

static Headless *context;

static int setup(void **state)
{
    Error error = {{0}};
    (void)state;
    context = headless_create(HEADLESS_GPU_AUTO, &error);
    backends_add();
    return context ? 0 : -1;
}

static int teardown(void **state)
{
    (void)state;
    headless_destroy(context);
    return 0;
}

static void the_share_is_that_of_e(void **state)
{
    (void)state;
    for (int i = 0; i <= 100; i++) {
        const float x = powf(10, 0.1F * (float)i - 8);
        const double must = -expm1(-(double)x);
        if (fabs((double)finger_share(x) / must - 1) > 2e-6)
            fail_msg("of %g: %g, not %g", (double)x, (double)finger_share(x), must);
    }
    assert_true(finger_share(1e30F) > 0.999999F && finger_share(1e30F) <= 1 && finger_share(0) == 0);
}

static void mean_velocity(World *world, double mean[3])
{
    WorldSums sums;
    world_sums(world, &sums);
    for (int k = 0; k < 3; k++)
        mean[k] = sums.momentum[k] / sums.mass;
}

/* dp/dt = rate (M V - p), with all of the block held alike: internal forces cancel. */
static void a_stir_gives_force_times_time(void **state)
{
    (void)state;
    enum { STEPS = 12 };
    const double rate = 30, across = 0.4;
    for (int form = 0; form < TOUCH_FORMS; form++) {
        const WorldDef def = touch_def(form, 3);
        World *world = fixture_world(&def);
        double is[3], must = 0, last = 0;
        for (int i = 0; i < STEPS; i++) {
            const Finger finger = touch_at(FINGER_STIR, across * def.dt * i, 0.8, 0, 1000, rate);
            world_set_finger(world, &finger);
            fixture_step(world, 1);
            const double now = touch_state(world).point[0], speed = (now - last) / def.dt;
            must += (1 - exp(-rate * def.dt)) * (speed - must);
            last = now;
        }
        mean_velocity(world, is);
        if (fabs(is[0] / must - 1) > 2e-4 || fabs(is[1]) > 1e-5 || fabs(is[2]) > 1e-5 || !(must > 0.01))
            fail_msg("%s %s: %g %g %g, not %g", touch_forms[form].backend, touch_forms[form].method, is[0],
                     is[1], is[2], must);
        world_destroy(world);
    }
}

/* What a particle off the point gains in a step, from sim/world.h's words. */
static double gain_of(const float x[3], const Finger *finger, double dt, double out[3])
{
    double r2 = 0;
    for (int k = 0; k < 3; k++) {
        out[k] = (double)x[k] - finger->at[k];
        r2 += out[k] * out[k];
    }
    const double r = sqrt(r2), q = r / finger->radius, w = q < 1 ? (1 - q * q) * (1 - q * q) : 0;
    double most = 0;
    for (int i = 0; i <= 1000; i++) {
        const double s = 1e-3 * i;
        most = fmax(most, s * (1 - s * s) * (1 - s * s));
    }
    for (int k = 0; k < 3; k++)
        out[k] = r > 0 ? out[k] / r : 0;
    return finger->strength * dt * q * w / most;
}

/* Each particle goes out by force times time, and all together nowhere: the lattice is the same on all sides.
 */
static void a_push_in_the_middle_moves_nothing_on_the_whole(void **state)
{
    (void)state;
    for (int form = 0; form < TOUCH_FORMS; form++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            const WorldDef def = touch_def(form, dimensions);
            const Finger finger = touch_at(FINGER_PUSH, 0, 0.8, 0, 0.4, 20);
            World *world = fixture_world(&def);
            State before = fixture_read(world);
            world_set_finger(world, &finger);
            fixture_step(world, 1);
            State after = fixture_read(world);
            double whole[3] = {0}, outward = 0, must = 0;
            for (size_t i = 0; i < after.count; i++) {
                double out[3];
                must += gain_of(before.position + 4 * i, &finger, def.dt, out);
                for (int k = 0; k < 3; k++) {
                    whole[k] += (double)after.velocity[4 * i + (size_t)k];
                    outward += (double)after.velocity[4 * i + (size_t)k] * out[k];
                }
            }
            const double rest = fabs(whole[0]) + fabs(whole[1]) + fabs(whole[2]);
            if (rest > 1e-4 * must || fabs(outward / must - 1) > 0.02 || !(must > 0.1))
                fail_msg("%s %s in %d dimensions: %g on the whole, %g outward, not %g",
                         touch_forms[form].backend, touch_forms[form].method, dimensions, rest, outward,
                         must);
            fixture_free(&before);
            fixture_free(&after);
            world_destroy(world);
        }
}

static double fastest(World *world)
{
    WorldSums sums;
    world_sums(world, &sums);
    return sums.max_speed;
}

/* However strong, stirred fluid is not faster than the point, whose speed has a bound, and nothing is upset.
 */
static void no_strength_and_no_haste_upsets_it(void **state)
{
    (void)state;
    static const FingerWay ways[] = {FINGER_STIR, FINGER_PULL, FINGER_PUSH};
    for (int form = 0; form < TOUCH_FORMS; form++)
        for (int w = 0; w < 3; w++) {
            WorldDef def = touch_def(form, 3);
            def.gravity[1] = -9.81;
            def.retries = 3;
            World *world = fixture_world(&def);
            WorldInfo info;
            double most = 0;
            for (int i = 0; i < 24; i++) {
                const double side = i / 5 % 2 ? 0.5 : -0.5;
                const Finger finger = touch_at(ways[w], side, 0.4 + 0.4 * side, 0, 0.35, w == 0 ? 1e12 : 60);
                world_set_finger(world, &finger);
                fixture_step(world, 1);
                most = fmax(most, fastest(world));
            }
            world_info(world, &info);
            const double bound = 0.26 * def.support * def.spacing / def.dt;
            if (info.trouble.count > 0 || info.trouble.ended || !(most > 0.2) || most > bound)
                fail_msg("%s %s, way %d: %d troubles, %g m/s", touch_forms[form].backend,
                         touch_forms[form].method, (int)ways[w], info.trouble.count, most);
            world_destroy(world);
        }
}

/* Work of a finger is none of an error: the watch over energy takes no step back. With it a block that is
   flung about in a closed box would be trouble. */
static void its_work_is_no_trouble(void **state)
{
    (void)state;
    WorldDef def = touch_def(0, 3);
    def.retries = 3;
    World *world = fixture_world(&def);
    WorldInfo info;
    for (int i = 0; i < 150; i++) {
        const Finger finger = touch_at(FINGER_STIR, 0.4 * sin(0.1 * i), 0.8 + 0.4 * cos(0.1 * i), 0, 2, 40);
        world_set_finger(world, &finger);
        fixture_step(world, 1);
    }
    const Finger finger = touch_at(FINGER_PULL, 0.5, 0.8, 0, 2, 20); /* that goes on without a command */
    world_set_finger(world, &finger);
    fixture_step(world, 80);
    world_set_finger(world, &(Finger){.way = FINGER_NONE});
    fixture_step(world, 30);
    world_info(world, &info);
    assert_int_equal(info.trouble.count, 0);
    assert_true(fastest(world) > 0.5);
    world_destroy(world);
}

static void touch_along(World *world, int from, int to)
{
    for (int i = from; i < to; i++) {
        const Finger finger =
            touch_at(i % 20 < 10 ? FINGER_STIR : FINGER_PULL, 0.02 * i, 0.8, 0.01 * i, 0.3, 30);
        world_set_finger(world, &finger);
        fixture_step(world, 1);
    }
}

static void it_is_part_of_the_saved_state(void **state)
{
    (void)state;
    for (int form = 0; form < TOUCH_FORMS; form++) {
        const WorldDef def = touch_def(form, 3);
        Error error = {{0}};
        WorldState saved = {.count = 0};
        World *one = fixture_world(&def), *other = fixture_world(&def);
        touch_along(one, 0, 6);
        assert_true(world_save(one, &saved, &error) && world_load(other, &saved, &error));
        fixture_step(one, 4); /* the point still comes */
        fixture_step(other, 4);
        if (world_hash(one) != world_hash(other))
            fail_msg("%s %s: other bits", touch_forms[form].backend, touch_forms[form].method);
        saved.numbers.finger.wanted.radius = -1;
        assert_false(world_load(other, &saved, &error));
        world_state_free(&saved);
        world_destroy(one);
        world_destroy(other);
    }
}

/* A touch that ends before a step, or is no finger, is none: not a bit differs. */
static void without_a_finger_nothing_differs(void **state)
{
    (void)state;
    const WorldDef def = touch_def(0, 3);
    const Finger no_fingers[] = {touch_at(FINGER_STIR, NAN, 0, 0, 1, 1),
                                 touch_at(FINGER_STIR, 0, 0, 0, 0, 1),
                                 touch_at(FINGER_PUSH, 0, 0, 0, 1, INFINITY),
                                 {.way = 1.5, .radius = 1},
                                 {.way = FINGER_POUR + FINGER_FLUIDS, .radius = 1}};
    World *plain = fixture_world(&def), *touched = fixture_world(&def);
    const Finger finger = touch_at(FINGER_STIR, 0, 0.8, 0, 1, 10);
    world_set_finger(touched, &finger);
    world_set_finger(touched, &(Finger){.way = FINGER_NONE});
    for (size_t i = 0; i < sizeof no_fingers / sizeof *no_fingers; i++)
        world_set_finger(touched, &no_fingers[i]);
    fixture_step(plain, 5);
    fixture_step(touched, 5);
    assert_true(world_hash(plain) == world_hash(touched));
    world_destroy(plain);
    world_destroy(touched);
}

static void backends_agree(void **state)
{
    (void)state;
    static const int pairs[][2] = {{0, 4}, {2, 5}, {0, 6}, {1, 7}, {3, 8}};
    for (size_t p = 0; p < sizeof pairs / sizeof *pairs; p++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            const WorldDef defs[] = {touch_def(pairs[p][0], dimensions), touch_def(pairs[p][1], dimensions)};
            State states[2];
            for (int k = 0; k < 2; k++) {
                World *world = fixture_world(&defs[k]);
                touch_along(world, 0, 14);
                states[k] = fixture_read(world);
                world_destroy(world);
            }
            double apart = 0, fast = 0, across = 0;
            for (size_t i = 0; i < states[0].count; i++)
                for (size_t k = 0; k < 3; k++) {
                    const size_t at = 4 * i + k;
                    apart =
                        fmax(apart, fabs((double)states[0].velocity[at] - (double)states[1].velocity[at]));
                    fast = fmax(fast, fabs((double)states[0].velocity[at]));
                    across = fmax(across, k == 2 ? fabs((double)states[0].velocity[at]) : 0);
                }
            if (apart > 2e-3 * fast || !(fast > 0.1) || (dimensions == 2 && across > 0))
                fail_msg("%s %s in %d dimensions: %g of %g m/s apart, %g out of the plane",
                         touch_forms[pairs[p][1]].backend, touch_forms[pairs[p][1]].method, dimensions, apart,
                         fast, across);
            fixture_free(&states[0]);
            fixture_free(&states[1]);
        }
}

/* In a box whose sides are one the finger reaches across. */
static void it_reaches_across_periodic_sides(void **state)
{
    (void)state;
    for (int form = 0; form < 5; form += 4) {
        WorldDef def = fixture_def(1.6, 0.8, 0.8);
        snprintf(def.backend, sizeof def.backend, "%s", touch_forms[form].backend);
        memset(def.gravity, 0, sizeof def.gravity);
        def.periodic[0] = true;
        fixture_block(&def, 0, -0.8, 0, -0.4, 0.8, 0.8, 0.4);
        World *world = fixture_world(&def);
        const Finger finger = touch_at(FINGER_PUSH, 0.78, 0.4, 0, 0.3, 20);
        world_set_finger(world, &finger);
        fixture_step(world, 1);
        State after = fixture_read(world);
        double left = 0, right = 0;
        for (size_t i = 0; i < after.count; i++) {
            const double x = (double)after.position[4 * i], v = (double)after.velocity[4 * i];
            left += x < -0.5 ? v : 0;
            right += x > 0.5 && x < 0.78 ? v : 0;
        }
        assert_true(left > 0.1 && right < -0.1);
        fixture_free(&after);
        world_destroy(world);
    }
}

/* Poured fluid is the requested fluid at the requested speed, and part of the saved state. */
static void what_is_poured_comes_with_every_method(void **state)
{
    (void)state;
    for (int form = 0; form < TOUCH_FORMS; form++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            WorldDef def = touch_def(form, dimensions);
            const Finger finger = touch_at(FINGER_POUR + 1, 0.6, 1.3, 0, 0.12, 1.5);
            def.fluid_count = 2;
            def.fluids[1] = def.fluids[0];
            def.fluids[1].fill_count = 0;
            def.most = 10000;
            World *world = fixture_world(&def);
            Error error = {{0}};
            WorldInfo before, after;
            WorldState saved = {.count = 0};
            world_info(world, &before);
            world_set_finger(world, &finger); /* where there is no room it is not taken */
            assert_false(touch_state(world).wanted.way == finger.way);
            if (strcmp(touch_forms[form].backend, "fragment") == 0) {
                assert_false(world_make_room(&world, &error));
                assert_non_null(strstr(error.message, "backend fragment has no pouring"));
                world_destroy(world);
                continue;
            }
            const uint64_t hash = world_hash(world);
            assert_true(world_make_room(&world, &error));
            assert_true(world_hash(world) == hash);
            fixture_step(world, 3); /* layers count from here on, and not from the begin */
            world_set_finger(world, &finger);
            fixture_step(world, 12);
            world_info(world, &after);
            if (!(after.emitted > 0) || after.count != before.count + after.emitted ||
                after.trouble.count > 0)
                fail_msg("%s %s: %g came", touch_forms[form].backend, touch_forms[form].method,
                         (double)after.emitted);
            State now = fixture_read(world);
            for (size_t i = 0; i < now.count; i++)
                if (i >= before.count) /* ordered by ids */
                    assert_true(now.fluid[i] == 1 && now.velocity[4 * i + 1] < -1 &&
                                fabsf(now.position[4 * i] - 0.6F) < 0.2F);
            fixture_free(&now);
            World *other = fixture_world(&def);
            assert_true(world_make_room(&other, &error));
            assert_true(world_save(world, &saved, &error) && world_load(other, &saved, &error));
            fixture_step(world, form ? 4 : 20);
            fixture_step(other, form ? 4 : 20);
            assert_true(world_hash(world) == world_hash(other));
            world_state_free(&saved);
            world_destroy(world);
            world_destroy(other);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_share_is_that_of_e),
        cmocka_unit_test(a_stir_gives_force_times_time),
        cmocka_unit_test(a_push_in_the_middle_moves_nothing_on_the_whole),
        cmocka_unit_test(no_strength_and_no_haste_upsets_it),
        cmocka_unit_test(its_work_is_no_trouble),
        cmocka_unit_test(it_is_part_of_the_saved_state),
        cmocka_unit_test(without_a_finger_nothing_differs),
        cmocka_unit_test(backends_agree),
        cmocka_unit_test(it_reaches_across_periodic_sides),
        cmocka_unit_test(what_is_poured_comes_with_every_method),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
