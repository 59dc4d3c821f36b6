/* Solids moved by fluid, in worlds: draught, containment in the box, bits. */
#include "tests/lists.h"

#include "../sim/fixture.h"

#include "sim/state.h"

enum { METHODS = 4 };

/* A tank, 2D, half a metre deep, with a floating block at about the equilibrium height. */
static WorldDef tank(const char *method, double density)
{
    WorldDef def = fixture_def(1.6, 1, 0);
    const bool projects = strcmp(method, "pbf") == 0 || strcmp(method, "dfsph") == 0;
    def.dimensions = 2;
    def.spacing = 0.04;
    def.support = 2.6;
    def.sound_speed = 20;
    def.dt = 0.01;
    def.substeps = strcmp(method, "pbf") == 0 ? 1 : projects ? 4 : 10;
    def.retries = 3;
    snprintf(def.method, sizeof def.method, "%s", method);
    fixture_block(&def, 0, -0.8, 0, 0, 0.8, 0.48, 0);
    def.solid_count = 1;
    def.solids[0] = (SolidDef){.kind = SOLID_BOX,
                               .centre = {0.02, 0.6 - 0.24 * fmin(density / 1000, 1), 0},
                               .size = {0.4, 0.24, 1},
                               .axis = {0, 0, 1},
                               .density = density};
    return def;
}

static double middle_of(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    return info.floating[0].position[1];
}

/* Half of the block under water, by the actual water; the mean over a while, since the block still bobs. */
static void half_floats_half_under(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        const WorldDef def = tank(fixture_method_names[m], 500);
        World *world = fixture_world(&def);
        WorldInfo info;
        double mean = 0;
        world_info(world, &info);
        const double water = pow(def.spacing, 2) * (double)info.count, part = 0.5 * 0.4 * 0.24,
                     level = (water + part) / def.box_size[0];
        for (int i = 0; i < 200; i++) {
            fixture_step(world, 1);
            mean += i >= 100 ? middle_of(world) / 100 : 0;
        }
        const double under = 0.5 + (level - mean) / 0.24;
        printf("%s: %.3f of its height under water\n", fixture_method_names[m], under);
        if (!(fabs(under - 0.5) < 0.06)) /* 6 particles high: twice the bound for finer blocks (floating) */
            fail_msg("%s: %.3f of its height is under water", fixture_method_names[m], under);
        world_info(world, &info);
        assert_int_equal(info.trouble.count, 0);
        world_destroy(world);
    }
}

/* Far lighter than the added mass. */
static void light_ones_hold(void **state)
{
    (void)state;
    static const double densities[] = {100, 20};
    for (int m = 0; m < METHODS; m++)
        for (int d = 0; d < 2; d++) {
            const WorldDef def = tank(fixture_method_names[m], densities[d]);
            World *world = fixture_world(&def);
            WorldInfo info;
            double speed = 0; /* mean of the second second */
            double first = 0; /* greatest in the first second */
            for (int i = 0; i < 100; i++) {
                fixture_step(world, 1);
                world_info(world, &info);
                first = fmax(first, hypot(info.floating[0].velocity[0], info.floating[0].velocity[1]));
            }
            for (int i = 0; i < 100; i++) {
                fixture_step(world, 1);
                world_info(world, &info);
                speed += hypot(info.floating[0].velocity[0], info.floating[0].velocity[1]) / 100;
            }
            const double y = info.floating[0].position[1];
            printf("%s, %g kg/m3: middle at %.3f m, %.3f m/s, at first up to %.3f m/s, %u times back\n",
                   fixture_method_names[m], densities[d], y, speed, first, info.trouble.count);
            if (!(info.trouble.count == 0 && y > 0.45 && y < 0.7 && speed < 0.2 && first < 1))
                fail_msg("%s: a body of %g kg/m3 is at %.3g m with %.3g m/s; went back %u times",
                         fixture_method_names[m], densities[d], y, speed, info.trouble.count);
            world_destroy(world);
        }
}

/* A heavy block sinks to the floor and stays; shaken hard, the block is never beyond a wall. */
static void heavy_ones_stay_in_the_box(void **state)
{
    (void)state;
    WorldDef def = tank("mueller", 2500);
    World *world;
    add_motion(
        &def,
        (Motion){.kind = MOTION_SHAKE, .axis = {1, 0.3, 0}, .amplitude = 0.1, .frequency = 2, .start = 1.5});
    world = fixture_world(&def);
    for (int i = 0; i < 300; i++) {
        WorldInfo info;
        fixture_step(world, 1);
        world_info(world, &info);
        const BoxState *pose = &info.floating[0];
        for (int corner = 0; corner < 4; corner++) {
            const double at[3] = {corner & 1 ? 0.2 : -0.2, corner & 2 ? 0.12 : -0.12, 0};
            double x[3];
            quat_rotate(pose->orientation, at, x);
            for (int k = 0; k < 2; k++)
                x[k] += pose->position[k];
            if (!(x[1] > -1e-4 && x[1] < 1.0001 && fabs(x[0]) < 0.8001))
                fail_msg("a corner is at %g %g at t = %g s", x[0], x[1], info.time);
        }
        if (i == 149 && !(pose->position[1] < 0.125))
            fail_msg("it is %g m over the floor", pose->position[1] - 0.12);
    }
    world_destroy(world);
}

/* As many threads as may be give the same bits, and so does going on from a saved state. */
static void bits_are_the_same(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        WorldDef def = tank(fixture_method_names[m], 400);
        WorldState saved = {.count = 0};
        Error error = {0};
        def.solids[0].angle_deg = 20;
        def.solids[1] = (SolidDef){.kind = SOLID_SPHERE,
                                   .centre = {-0.5, 0.5, 0},
                                   .radius = 0.1,
                                   .density = 300,
                                   .hinge_at = {-0.45, 0.5, 0},
                                   .hinge_axis = {0, 0, 1}};
        def.solid_count = 2;
        *world_threads(&def) = 1;
        World *one = fixture_world(&def);
        *world_threads(&def) = 3;
        World *three = fixture_world(&def), *later = fixture_world(&def);
        fixture_step(one, 10);
        fixture_step(three, 10);
        assert_true(world_hash(one) == world_hash(three));
        assert_true(world_save(one, &saved, &error));
        if (!world_load(later, &saved, &error))
            fail_msg("%s", error.message);
        assert_true(world_hash(later) == world_hash(one));
        fixture_step(one, 10);
        fixture_step(later, 10);
        assert_true(world_hash(later) == world_hash(one));
        saved.numbers.bodies.of[0].pose.orientation[3] = 7; /* what is no state is not taken */
        assert_false(world_load(later, &saved, &error));
        world_state_free(&saved);
        world_destroy(one);
        world_destroy(three);
        world_destroy(later);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_floats_half_under),
        cmocka_unit_test(light_ones_hold),
        cmocka_unit_test(heavy_ones_stay_in_the_box),
        cmocka_unit_test(bits_are_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
