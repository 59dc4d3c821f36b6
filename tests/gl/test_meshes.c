/* Solids that are meshes, on the backends `cpu` and `compute`: the rabbit of scenes/rabbit.yaml. */
#include "tests/gl/compare.h"
#include "tests/lists.h"

#include "sim/gpu/compute/compute.h"

static WorldDef rabbit_def(double spacing)
{
    WorldDef def = scene_def("rabbit", spacing);
    def.retries = 0;
    return def;
}

/* Shaken and turned as no hand can, in a fluid that is shaken too. */
static WorldDef shaken_def(double spacing)
{
    WorldDef def = rabbit_def(spacing);
    SolidDef *rabbit = &def.solids[0];
    rabbit->centre[1] = 0.25;
    add_solid_motion(rabbit,
                     (Motion){.kind = MOTION_SHAKE, .axis = {1, 0.5, 0}, .amplitude = 0.1, .frequency = 3});
    add_solid_motion(rabbit,
                     (Motion){.kind = MOTION_ROCK, .axis = {0, 1, 1}, .angle_deg = 40, .frequency = 2});
    add_motion(&def,
               (Motion){.kind = MOTION_SHAKE, .axis = {1, 0.3, 0.2}, .amplitude = 0.08, .frequency = 2.5});
    return def;
}

static void one_step_is_that_of_the_cpu(void **state)
{
    (void)state;
    for (int run = 0; run < 2; run++) {
        const WorldDef def = run ? shaken_def(0.04) : rabbit_def(0.04);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        substeps(cpu, 250);
        copy_state(cpu, gpu);
        compare_one_step(run ? "the rabbit shaken" : "the rabbit", cpu, gpu);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

static void runs_stay_with_the_cpu(void **state)
{
    (void)state;
    WorldDef def = rabbit_def(0.04);
    def.reproducible = false;
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    substeps(cpu, 200);
    copy_state(cpu, gpu);
    compare_run(&def, "the rabbit, single precision", cpu, gpu, 100);
    world_destroy(cpu);
    world_destroy(gpu);
}

static void a_shaken_rabbit_does_not_leak(void **state)
{
    (void)state;
    static const char *const backends[] = {"cpu", "compute"};
    for (int k = 0; k < 2; k++)
        for (int exact = 0; exact < (k ? 2 : 1); exact++) {
            WorldDef def = shaken_def(0.045);
            def.reproducible = exact;
            World *world = world_on(def, backends[k]);
            double least = INFINITY;
            for (int i = 0; i < 10; i++) {
                fixture_step(world, 5);
                least = fmin(least, least_clearance(world, &def));
            }
            printf("%s: no particle nearer than %.1e m, guarded %zu\n", backends[k], least,
                   info_of(world).guarded);
            assert_true(least > -1e-5);
            assert_true(info_of(world).guarded > 0);
            world_destroy(world);
        }
}

static void save_load_step_is_step(void **state)
{
    (void)state;
    check_save_load_step(shaken_def(0.05), "cpu", 5);
    check_save_load_step(shaken_def(0.05), "compute", 3);
}

static void any_number_of_threads_gives_the_same(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int k = 0; k < 2; k++) {
        WorldDef def = shaken_def(0.045);
        *world_threads(&def) = 1 + 2 * k;
        World *world = world_on(def, "cpu");
        fixture_step(world, 20);
        hash[k] = world_hash(world);
        world_destroy(world);
    }
    assert_true(hash[0] == hash[1]);
}

/* A scene without meshes has no mesh resources. */
static void without_meshes_there_is_no_texture(void **state)
{
    (void)state;
    WorldDef def = rabbit_def(0.06);
    def.solids[0] = (SolidDef){.kind = SOLID_SPHERE, .centre = {0.2, 0.2, 0}, .radius = 0.1};
    World *world = world_on(def, "compute");
    const Compute *compute = world->state;
    assert_true(compute->boundary.block && !compute->meshes.block && !compute->meshes.texture);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(one_step_is_that_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(runs_stay_with_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(a_shaken_rabbit_does_not_leak, no_gl_errors),
        cmocka_unit_test_teardown(save_load_step_is_step, no_gl_errors),
        cmocka_unit_test_teardown(any_number_of_threads_gives_the_same, no_gl_errors),
        cmocka_unit_test_teardown(without_meshes_there_is_no_texture, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.meshes", tests, compare_setup, context_teardown);
}
