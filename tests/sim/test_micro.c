/* The parts of a substep alone: they are the method's own, and leave the state as it was. */
#include "sim/methods/wcsph/wcsph.h"
#include "sim/step/method.h"
#include "sim/step/world.h"
#include "tests/sim/fixture.h"

/* A tank around a ball, with terms that have passes of their own. */
static World *tank(const char *method)
{
    WorldDef def = fixture_def(1, 1, 1);
    Error error;
    snprintf(def.method, sizeof def.method, "%s", method);
    def.spacing = 0.08;
    def.sound_speed = 20;
    def.dt = 0.0005;
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.3, 0}, .radius = 0.15, .slip = SLIP_NONE};
    wcsph_def(&def)->delta_sph = 0.1;
    wcsph_def(&def)->shifting = 0.2;
    fixture_block(&def, 0, -0.5, 0, -0.5, 0, 0.6, 0.5);
    World *world = world_create(&def, &error);
    if (!world)
        fail_msg("%s", error.message);
    for (int k = 0; k < 5; k++)
        assert_true(world_step(world, NULL, &error));
    return world;
}

static void test_parts_are_those_of_the_method(void **state)
{
    (void)state;
    for (const Method *const *method = method_list(); *method; method++) {
        World *world = tank((*method)->name);
        MicroPart parts[MICRO_PARTS_MAX];
        const int count = world_micro_parts(world, parts);
        assert_string_equal(parts[0].name, "grid");
        assert_string_equal(parts[1].name, "lists");
        int k = 2;
        for (const Pass *const *pass = (*method)->passes; *pass; pass++)
            if (!(*pass)->needed || (*pass)->needed(&world->constants))
                assert_ptr_equal(parts[k++].pass, *pass);
        assert_int_equal(k, count);
        for (k = 0; k < count; k++) {
            assert_true(parts[k].stream >= 12); /* a position at least */
            assert_int_equal(parts[k].pairs, parts[k].pair.flops > 0);
        }
        world_destroy(world);
    }
}

/* Places, velocities, densities: within roundings of sums over neighbours. */
static void assert_alike(World *world, World *other)
{
    State a = fixture_read(world), b = fixture_read(other);
    assert_int_equal(a.count, b.count);
    for (size_t i = 0; i < 4 * a.count; i++) {
        assert_float_equal(a.position[i], b.position[i], 1e-6);
        assert_float_equal(a.velocity[i], b.velocity[i], 1e-4);
        assert_float_equal(a.density[i / 4], b.density[i / 4], 0.01);
    }
    fixture_free(&a);
    fixture_free(&b);
}

static void test_a_part_that_runs_alone_changes_nothing(void **state)
{
    (void)state;
    for (const Method *const *method = method_list(); *method; method++) {
        World *world = tank((*method)->name), *other = tank((*method)->name);
        MicroPart parts[MICRO_PARTS_MAX];
        Error error;
        const int count = world_micro_parts(world, parts);
        for (int round = 0; round < 3; round++)
            for (int k = 0; k < count; k++)
                world_micro_run(world, &parts[k]);
        assert_true(world_hash(world) == world_hash(other));
        assert_true(world_step(world, NULL, &error) && world_step(other, NULL, &error));
        assert_alike(world, other);
        world_destroy(other);
        world_destroy(world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parts_are_those_of_the_method),
        cmocka_unit_test(test_a_part_that_runs_alone_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
