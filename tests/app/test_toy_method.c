/* A run continues from a file with a method unknown to the program (tests/sim/toy_method.h). */
#include "tests/app/output_fixture.h"

#include "app/files/snapshot.h"
#include "app/run/offscreen.h"
#include "app/run/recording/recording.h"
#include "app/scene/scene.h"
#include "sim/gpu/gl.h"
#include "sim/world.h"
#include "tests/sim/toy_method.h"
#include "tests/sim/toy_shaders.h"

#include <hdf5.h>

static const char text[] = "box: {size: [1, 1, 1]}\n"
                           "particles: {spacing: 0.1}\n"
                           "fluids: [{fill: [{block: {min: [-0.4, 0, -0.4], max: [0.2, 0.5, 0.4]}}]}]\n"
                           "solver: {method: toy, step: {dt: 0.004, substeps: 2}}\n";

static void step_on(World *world, int frames)
{
    Error error;
    for (int k = 0; k < frames; k++)
        if (!world_step(world, NULL, &error))
            fail_msg("%s", error.message);
}

/* A file of the state after three frames; the hash of the one after six. */
static uint64_t write_file(const Scene *scene)
{
    Error error;
    World *world = world_create(&scene->world, &error);
    SnapshotWriter *file = snapshot_create("a.h5part", scene, &error);
    step_on(world, 3);
    assert_true(snapshot_append(file, world, &error));
    snapshot_close(file);
    step_on(world, 3);
    const uint64_t hash = world_hash(world);
    world_destroy(world);
    return hash;
}

static void goes_on_from_a_file(const char *backend)
{
    static Scene scene;
    Error error = {{0}};
    WorldState last = {.count = 0};
    bool busy;
    assert_true(scene_parse("toy.yaml", text, strlen(text), NULL, &scene, NULL, &error));
    snprintf(scene.world.backend, sizeof scene.world.backend, "%s", backend);
    scene.world.reproducible = true;
    const uint64_t hash = write_file(&scene);
    SnapshotWriter *file = snapshot_resume("a.h5part", &scene, "", &last, &busy, &error);
    World *world = world_create(&scene.world, &error);
    assert_true(file && world && world_load(world, &last, &error));
    step_on(world, 3);
    assert_true(world_hash(world) == hash);
    assert_true(snapshot_append(file, world, &error));
    snapshot_close(file);
    world_destroy(world);
    world_state_free(&last);
}

static void a_run_goes_on_from_a_file(void **state)
{
    (void)state;
    goes_on_from_a_file("cpu");
}

static void and_on_a_gpu(void **state)
{
    (void)state;
    Error error;
    Headless *context = headless_create(HEADLESS_GPU_AUTO, &error);
    assert_non_null(context);
    backends_add();
    toy_shaders_add();
    goes_on_from_a_file("compute");
    toy_shaders_remove();
    headless_destroy(context);
}

static void a_file_without_its_column_is_refused(void **state)
{
    (void)state;
    static Scene scene;
    Error error = {{0}};
    WorldState last = {.count = 0};
    bool busy;
    assert_true(scene_parse("toy.yaml", text, strlen(text), NULL, &scene, NULL, &error));
    write_file(&scene);
    const hid_t edit = H5Fopen("a.h5part", H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(H5Ldelete(edit, "Step#0/age", H5P_DEFAULT) >= 0);
    H5Fclose(edit);
    assert_null(snapshot_resume("a.h5part", &scene, "", &last, &busy, &error));
    assert_contains(error.message, "Step#0: 'age' is missing");
    world_state_free(&last);
}

/* As the panel, the window and a recording change it. */
static void its_key_reaches_the_world_that_runs(void **state)
{
    (void)state;
    static Scene scene;
    Error error = {{0}};
    const SimCommand set[2] = {{0, SIM_SET, {.setting = "solver.springs=50"}},
                               {0, SIM_SET, {.setting = "solver.springs=200"}}};
    uint64_t hash[2];
    for (int k = 0; k < 2; k++) {
        assert_true(scene_parse("toy.yaml", text, strlen(text), NULL, &scene, NULL, &error));
        World *world = world_create(&scene.world, &error);
        step_on(world, 3);
        assert_true(sim_command_apply(&set[k], &world, &scene, &error));
        step_on(world, 3);
        hash[k] = world_hash(world);
        world_destroy(world);
    }
    assert_true(hash[0] != hash[1]);
}

/* The program has no shaders of it. */
static void a_gpu_has_no_such_method(void **state)
{
    (void)state;
    static Scene scene;
    Error error = {{0}};
    backends_add();
    assert_true(scene_parse("toy.yaml", text, strlen(text), NULL, &scene, NULL, &error));
    assert_true(world_can(&scene.world, &error));
    snprintf(scene.world.backend, sizeof scene.world.backend, "compute");
    assert_false(world_can(&scene.world, &error));
    assert_string_equal(error.message, "backend compute has no method toy; use backend cpu");
    snprintf(scene.world.backend, sizeof scene.world.backend, "fragment");
    assert_false(world_can(&scene.world, &error));
}

int main(void)
{
    toy_method_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_run_goes_on_from_a_file, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(and_on_a_gpu, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(a_file_without_its_column_is_refused, folder_setup, folder_teardown),
        cmocka_unit_test(its_key_reaches_the_world_that_runs),
        cmocka_unit_test(a_gpu_has_no_such_method),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
