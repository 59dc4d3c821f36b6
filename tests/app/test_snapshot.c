/* Snapshot files: what is written is read, and only whole steps are. */
#include "tests/app/output_fixture.h"
#include "tests/lists.h"

#include "app/files/snapshot.h"
#include "sim/methods/mueller/mueller.h"
#include "sim/world.h"

#include <hdf5.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

static Scene small_scene(void)
{
    Scene scene = {.title = "A test", .world = world_def_default()};
    WorldDef *def = &scene.world;
    def->spacing = 0.1;
    for (int k = 0; k < 3; k++)
        def->box_size[k] = 1;
    def->fluid_count = 2;
    def->fluids[0] = (FluidDef){.name = "water", .density = 1000, .color = {0, 1, 0.5F}};
    add_fill(&def->fluids[0], (Fill){.kind = FILL_BLOCK, .min = {-0.5, 0, -0.5}, .max = {0, 0.5, 0.5}});
    def->fluids[1] = (FluidDef){.name = "oil", .density = 900};
    add_fill(&def->fluids[1], (Fill){.kind = FILL_BLOCK, .min = {0, 0, -0.5}, .max = {0.5, 0.5, 0.5}});
    def->dt = 0.004;
    def->substeps = 2;
    add_motion(def, (Motion){.kind = MOTION_ROCK, .axis = {0, 0, 1}, .angle_deg = 20, .frequency = 1});
    return scene;
}

/* A made-up state with every value different. */
static SnapshotStep some_step(size_t count, double time)
{
    SnapshotStep step;
    assert_true(snapshot_step_allocate(&step, count));
    step.time = time;
    step.step = (uint64_t)(1000 * time);
    for (int k = 0; k < 4; k++)
        step.box.orientation[k] = 0.1 + k;
    for (int k = 0; k < 3; k++) {
        step.box.position[k] = 1 + k;
        step.box.velocity[k] = 4 + k;
        step.box.angular_velocity[k] = 7 + k;
        step.gravity[k] = -k;
    }
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            step.position[k][i] = (float)(time + k + 0.001 * (double)i);
            step.velocity[k][i] = (float)(-time - k - 0.003 * (double)i);
        }
        step.density[i] = 1000 + (float)i;
        step.pressure[i] = -5 * (float)i;
        step.compression[i] = 1e-6f * (float)i;
        step.fluid[i] = (int32_t)(i % 3);
        step.id[i] = (int64_t)(count - i);
    }
    return step;
}

static void assert_same_step(const SnapshotStep *a, const SnapshotStep *b)
{
    assert_true(a->time == b->time);
    assert_int_equal(a->step, b->step);
    assert_int_equal(a->count, b->count);
    assert_memory_equal(&a->box, &b->box, sizeof a->box);
    assert_memory_equal(a->gravity, b->gravity, sizeof a->gravity);
#define X(name, type, field)                                                                                 \
    if (a->count > 0)                                                                                        \
        assert_memory_equal(a->field, b->field, a->count * sizeof(type));
    SNAPSHOT_FIELDS(X)
#undef X
}

static size_t whole_steps(const char *path)
{
    Error error = {{0}};
    SnapshotReader *reader = snapshot_open(path, &error);
    if (!reader)
        fail_msg("%s", error.message);
    size_t steps = snapshot_count_steps(reader);
    snapshot_reader_close(reader);
    return steps;
}

/* Changing counts, zero, and more than a single chunk. */
static void what_is_written_is_read(void **state)
{
    (void)state;
    static const size_t counts[] = {5, 0, 1, 70000, 70001};
    enum { STEPS = sizeof counts / sizeof counts[0] };
    Scene scene = small_scene();
    Error error = {{0}};
    SnapshotStep step[STEPS];
    SnapshotWriter *file = snapshot_create("a.h5part", &scene, &error);
    assert_non_null(file);
    for (int k = 0; k < STEPS; k++) {
        step[k] = some_step(counts[k], 0.25 * k);
        assert_true(snapshot_append_step(file, &step[k], &error));
    }
    assert_int_equal(snapshot_steps(file), STEPS);
    snapshot_close(file);
    assert_int_equal(count_files("."), 1);
    SnapshotReader *reader = snapshot_open("a.h5part", &error);
    assert_non_null(reader);
    assert_int_equal(snapshot_count_steps(reader), STEPS);
    for (int k = STEPS - 1; k >= 0; k--) {
        SnapshotStep read;
        if (!snapshot_read_step(reader, (size_t)k, &read, &error))
            fail_msg("%s", error.message);
        assert_same_step(&read, &step[k]);
        snapshot_step_free(&read);
        snapshot_step_free(&step[k]);
    }
    double time = 0;
    assert_true(snapshot_read_time(reader, 3, &time, &error));
    assert_true(time == 0.75);
    assert_false(snapshot_read_time(reader, STEPS, &time, &error));
    SnapshotStep none;
    assert_false(snapshot_read_step(reader, STEPS, &none, &error));
    assert_contains(error.message, "has no step 5");
    snapshot_reader_close(reader);
}

static void a_world_is_written_as_it_is(void **state)
{
    (void)state;
    Scene scene = small_scene();
    Error error = {{0}};
    WorldInfo info;
    World *world = world_create(&scene.world, &error);
    SnapshotWriter *file = snapshot_create("a.h5part", &scene, &error);
    assert_non_null(world);
    assert_non_null(file);
    assert_true(snapshot_append(file, world, &error));
    for (int i = 0; i < 5; i++)
        assert_true(world_step(world, NULL, &error));
    assert_true(snapshot_append(file, world, &error));
    snapshot_close(file);
    world_info(world, &info);
    float *position = calloc(4 * info.count, sizeof(float)),
          *velocity = calloc(4 * info.count, sizeof(float));
    float *density = calloc(info.count, sizeof(float)), *pressure = calloc(info.count, sizeof(float));
    uint32_t *fluid = calloc(info.count, sizeof(uint32_t)), *id = calloc(info.count, sizeof(uint32_t));
    world_read(world, &(ParticleArrays){
                          .position = position,
                          .velocity = velocity,
                          .scalar = {[SCALAR_DENSITY] = density, [SCALAR_PRESSURE] = pressure},
                          .fluid = fluid,
                          .id = id,
                      });
    SnapshotReader *reader = snapshot_open("a.h5part", &error);
    SnapshotStep step;
    assert_true(snapshot_read_step(reader, 1, &step, &error));
    assert_int_equal(step.count, 500);
    assert_int_equal(step.count, info.count);
    assert_int_equal(step.step, 10);
    assert_true(step.time == info.time);
    assert_true(step.box.angular_velocity[2] > 1);
    assert_memory_equal(&step.box, &info.box, sizeof info.box);
    assert_memory_equal(step.gravity, info.gravity, sizeof info.gravity);
    for (size_t i = 0; i < info.count; i++) {
        for (int k = 0; k < 3; k++) {
            assert_true(step.position[k][i] == position[4 * i + k]);
            assert_true(step.velocity[k][i] == velocity[4 * i + k]);
        }
        assert_true(step.density[i] == density[i] && step.pressure[i] == pressure[i]);
        assert_true(step.fluid[i] == (int32_t)fluid[i] && step.id[i] == id[i]);
    }
    snapshot_step_free(&step);
    snapshot_reader_close(reader);
    world_destroy(world);
    free(position), free(velocity), free(density), free(pressure), free(fluid), free(id);
}

/* Densities in the file give the densities of the views: sums by each kernel, and carried densities. */
static void volumes_are_those_of_the_solver(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"mueller", "spiky"}, {"mueller", "poly6"}, {"wcsph", "spiky"}, {"dfsph", "spiky"}, {"pbf", "spiky"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        Scene scene = small_scene();
        Error error = {{0}};
        SnapshotScene read;
        SnapshotStep step;
        snprintf(scene.world.method, NAME_SIZE, "%s", cases[k][0]);
        snprintf(mueller_def(&scene.world)->density_kernel, NAME_SIZE, "%s", cases[k][1]);
        World *world = world_create(&scene.world, &error);
        SnapshotWriter *file = snapshot_create("a.h5part", &scene, &error);
        assert_true(world && file);
        for (int i = 0; i < 5; i++)
            assert_true(world_step(world, NULL, &error));
        assert_true(snapshot_append(file, world, &error));
        snapshot_close(file);
        SnapshotReader *reader = snapshot_open("a.h5part", &error);
        assert_true(reader && snapshot_read_scene(reader, &read, &error));
        assert_true(read.dimensions == 3 && read.spacing == 0.1 && read.box_size[1] == 1);
        assert_true(read.support_radius == scene.world.support * 0.1);
        assert_true(read.fluid_count == 2 && read.density[0] == 1000 && read.density[1] == 900);
        assert_true(snapshot_read_step(reader, 0, &step, &error));
        float *position = calloc(4 * step.count, sizeof(float));
        assert_true(world_read(world, &(ParticleArrays){.position = position}));
        for (size_t i = 0; i < step.count; i++)
            if (!(fabs(snapshot_volume(&read, &step, i) / position[4 * i + 3] - 1) < 1e-5))
                fail_msg("%s, %s: particle %zu: %g, not %g", cases[k][0], cases[k][1], i,
                         snapshot_volume(&read, &step, i), (double)position[4 * i + 3]);
        step.density[0] = -1000;
        step.density[1] = NAN;
        step.fluid[2] = 2;
        assert_true(fabs(snapshot_volume(&read, &step, 0) - 20e-3) < 1e-9);
        assert_false(isfinite(snapshot_volume(&read, &step, 1)) ||
                     isfinite(snapshot_volume(&read, &step, 2)));
        free(position);
        snapshot_step_free(&step);
        snapshot_reader_close(reader);
        world_destroy(world);
    }
}

static void colors_are_as_in_the_scene_file(void **state)
{
    (void)state;
    Scene scene = small_scene();
    Error error = {{0}};
    double colors[FLUIDS_MAX][3];
    SnapshotStep step = some_step(3, 0);
    SnapshotWriter *file = snapshot_create("a.h5part", &scene, &error);
    assert_true(snapshot_append_step(file, &step, &error));
    snapshot_close(file);
    SnapshotReader *reader = snapshot_open("a.h5part", &error);
    assert_int_equal(snapshot_read_colors(reader, colors), 2);
    assert_true(colors[0][0] == 0);
    assert_true(fabs(colors[0][1] - 1) < 1e-9);
    assert_true(fabs(colors[0][2] - 0.735357) < 1e-6); /* IEC 61966-2-1 of 0.5 */
    snapshot_reader_close(reader);
    hid_t edit = H5Fopen("a.h5part", H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(H5Adelete(edit, "fluid_colors") >= 0);
    H5Fclose(edit);
    reader = snapshot_open("a.h5part", &error);
    assert_int_equal(snapshot_read_colors(reader, colors), 0);
    snapshot_reader_close(reader);
    snapshot_step_free(&step);
}

/* The file gets the final name with the first complete step. */
static void an_old_file_stays_until_the_first_step(void **state)
{
    (void)state;
    Scene scene = small_scene();
    Error error = {{0}};
    SnapshotStep step = some_step(3, 0);
    write_text("a.h5part", "old");
    SnapshotWriter *file = snapshot_create("a.h5part", &scene, &error);
    assert_non_null(file);
    assert_text("a.h5part", "old");
    snapshot_close(file);
    assert_text("a.h5part", "old");
    assert_int_equal(count_files("."), 1);
    file = snapshot_create("a.h5part", &scene, &error);
    assert_true(snapshot_append_step(file, &step, &error));
    assert_int_equal(whole_steps("a.h5part"), 1); /* while it is still being written */
    assert_int_equal(count_files("."), 1);
    assert_true(snapshot_append_step(file, &step, &error));
    assert_int_equal(whole_steps("a.h5part"), 2);
    snapshot_close(file);
    snapshot_step_free(&step);
}

static void an_incomplete_last_step_is_dropped(void **state)
{
    (void)state;
    Scene scene = small_scene();
    Error error = {{0}};
    SnapshotStep step = some_step(3, 0);
    SnapshotWriter *file = snapshot_create("a.h5part", &scene, &error);
    for (int k = 0; k < 3; k++)
        assert_true(snapshot_append_step(file, &step, &error));
    snapshot_close(file);
    assert_int_equal(whole_steps("a.h5part"), 3);
    hid_t edit = H5Fopen("a.h5part", H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(H5Adelete_by_name(edit, "Step#2", "complete", H5P_DEFAULT) >= 0);
    H5Fclose(edit);
    assert_int_equal(whole_steps("a.h5part"), 2);
    snapshot_step_free(&step);
}

/* Killed without a chance to clean up, after a step was added. */
static void a_killed_program_leaves_whole_steps(void **state)
{
    (void)state;
    int status = 0;
    pid_t child = fork();
    if (child == 0) {
        Scene scene = small_scene();
        SnapshotStep step = some_step(100, 0);
        SnapshotWriter *file = snapshot_create("a.h5part", &scene, NULL);
        for (int k = 0; k < 4; k++)
            if (!snapshot_append_step(file, &step, NULL))
                _exit(1);
        kill(getpid(), SIGKILL);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
    assert_int_equal(whole_steps("a.h5part"), 4);
}

/* In a child, since the limit is permanent: `bytes` is the maximum file size. Returns the number of
   complete steps of 1,000 particles. */
static int steps_within(rlim_t bytes, const char *path)
{
    int status = 0;
    pid_t child = fork();
    if (child == 0) {
        Scene scene = small_scene();
        SnapshotStep step = some_step(1000, 0);
        Error error = {{0}};
        int steps = 0;
        signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &(struct rlimit){bytes, bytes});
        SnapshotWriter *file = snapshot_create(path, &scene, &error);
        while (file && steps < 100 && snapshot_append_step(file, &step, &error))
            steps++;
        if (!strstr(error.message, "cannot be written: File too large") ||
            (file && snapshot_append_step(file, &step, &error)))
            steps = 200;
        snapshot_close(file);
        _exit(steps);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void a_full_disk_leaves_whole_steps_or_nothing(void **state)
{
    (void)state;
    assert_int_equal(steps_within(1000, "none.h5part"), 0);
    assert_int_equal(steps_within(60000, "none.h5part"), 0);
    assert_int_equal(count_files("."), 0);
    int steps = steps_within(400000, "some.h5part");
    assert_in_range(steps, 3, 20);
    assert_int_equal(whole_steps("some.h5part"), steps);
    assert_int_equal(count_files("."), 1);
}

/* The space reserved before a step is sufficient. */
static void the_reserve_is_enough(void **state)
{
    (void)state;
    Scene scene = small_scene();
    Error error = {{0}};
    struct stat before, after;
    SnapshotStep step = some_step(1, 0);
    SnapshotWriter *file = snapshot_create("a.h5part", &scene, &error);
    assert_true(snapshot_append_step(file, &step, &error));
    for (int k = 0; k < 40; k++) {
        assert_int_equal(stat("a.h5part", &before), 0);
        assert_true(snapshot_append_step(file, &step, &error));
        assert_int_equal(stat("a.h5part", &after), 0);
        assert_in_range(after.st_size - before.st_size, 1, 60000);
    }
    snapshot_close(file);
    snapshot_step_free(&step);
}

static void what_is_no_snapshot_is_refused(void **state)
{
    (void)state;
    Error error = {{0}};
    write_text("text.h5part", "not HDF5");
    assert_null(snapshot_open("text.h5part", &error));
    assert_contains(error.message, "text.h5part: is no file of snapshots");
    assert_null(snapshot_open("missing.h5part", &error));
    assert_contains(error.message, "missing.h5part: cannot be read: No such file or directory");
    Scene scene = small_scene();
    assert_null(snapshot_create("missing/a.h5part", &scene, &error));
    assert_contains(error.message, "create it first");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, folder_setup, folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(what_is_written_is_read),
        TEST(a_world_is_written_as_it_is),
        TEST(volumes_are_those_of_the_solver),
        TEST(colors_are_as_in_the_scene_file),
        TEST(an_old_file_stays_until_the_first_step),
        TEST(an_incomplete_last_step_is_dropped),
        TEST(a_killed_program_leaves_whole_steps),
        TEST(a_full_disk_leaves_whole_steps_or_nothing),
        TEST(the_reserve_is_enough),
        TEST(what_is_no_snapshot_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
