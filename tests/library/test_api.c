/* libslosh.so as a program sees it: the headers of include/slosh alone. */
#include "slosh/mesh.h"
#include "slosh/state.h"
#include "tests/scratch.h"

#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static slosh_error error;

static slosh_world *world_of(const char *name, const char *setting)
{
    const char *settings[] = {"particles=600", setting};
    slosh_scene *scene = slosh_scene_load(name, settings, setting ? 2 : 1, &error);
    slosh_world *world = scene ? slosh_world_create(scene, &error) : NULL;
    slosh_scene_free(scene);
    if (!world)
        fail_msg("%s", error.message);
    return world;
}

static void step(slosh_world *world, int frames)
{
    for (int i = 0; i < frames; i++)
        if (!slosh_world_step(world, &error))
            fail_msg("%s", error.message);
}

static slosh_column column_of(slosh_world *world, const char *name)
{
    slosh_column column = {.size = sizeof column};
    if (!slosh_world_column(world, name, &column, &error))
        fail_msg("%s", error.message);
    return column;
}

static const float *row(const slosh_column *column, size_t i)
{
    return (const float *)((const char *)column->data + i * column->stride);
}

/* The call has failed with a message that has the word. */
static void check_said(const char *word)
{
    if (!strstr(error.message, word))
        fail_msg("'%s' has no '%s'", error.message, word);
    memset(&error, 0, sizeof error);
}

static void a_world_steps(void **state)
{
    (void)state;
    slosh_world *world = world_of("dam_break", NULL);
    double size[3], g[3], position[3], orientation[4];
    assert_true(slosh_world_time(world) == 0);
    step(world, 2);
    assert_float_equal(slosh_world_time(world), 2 * 10 * slosh_world_dt(world), 1e-9);
    assert_int_equal(slosh_world_steps(world), 20);
    assert_true(slosh_world_run(world, 0.2, &error));
    assert_true(slosh_world_time(world) >= 0.2 - 1e-6);
    assert_int_equal(slosh_world_dimensions(world), 3);
    slosh_world_box_size(world, size);
    slosh_world_gravity(world, g);
    slosh_world_box(world, position, orientation);
    assert_float_equal(size[0], 1.6, 1e-12);
    assert_float_equal(g[1], -9.81, 1e-12);
    assert_float_equal(orientation[3], 1, 1e-12);
    assert_string_equal(slosh_world_outcome(world), "holds");
    slosh_world_destroy(world);
}

static void columns_are_of_the_present_state(void **state)
{
    (void)state;
    slosh_world *world = world_of("dam_break", NULL);
    const slosh_column x = column_of(world, "position"), id = column_of(world, "id");
    const size_t count = slosh_world_count(world);
    assert_int_equal(x.count, count);
    assert_int_equal(x.components, 3);
    assert_string_equal(x.unit, "m");
    uint64_t sum = 0;
    double height = 0, later = 0;
    for (size_t i = 0; i < count; i++) {
        sum += ((const uint64_t *)id.data)[i];
        height += (double)row(&x, i)[1];
        assert_in_range((int)(1000 * (row(&x, i)[0] + 0.8F)), 0, 1600);
    }
    assert_int_equal(id.type, SLOSH_UINT64);
    assert_int_equal(sum, count * (count - 1) / 2);
    step(world, 5);
    const slosh_column after = column_of(world, "position"), v = column_of(world, "velocity");
    assert_ptr_equal(after.data, x.data); /* the memory stays */
    for (size_t i = 0; i < count; i++)
        later += (double)row(&after, i)[1];
    assert_true(later < height);
    const slosh_column speed = column_of(world, "speed"), volume = column_of(world, "volume");
    for (size_t i = 0; i < count; i++) {
        const float *u = row(&v, i);
        assert_float_equal(sqrtf(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]), *row(&speed, i), 1e-5);
        assert_true(*row(&volume, i) > 0);
    }
    size_t names = 0;
    while (slosh_world_column_name(world, names)) {
        const slosh_column any = column_of(world, slosh_world_column_name(world, names++));
        assert_int_equal(any.count, count);
    }
    assert_true(names >= 8);
    slosh_world_destroy(world);
}

static void what_is_written_is_read(void **state)
{
    (void)state;
    slosh_world *world = world_of("dam_break", NULL);
    step(world, 2);
    const uint64_t before = slosh_world_hash(world);
    slosh_column v = column_of(world, "velocity"), x = column_of(world, "position");
    assert_true(slosh_world_write(world, x.data, v.data, v.count, v.stride, &error));
    assert_int_equal(slosh_world_hash(world), before);
    float *still = calloc(v.count, 3 * sizeof *still);
    still[3] = 0.5F;
    const uint64_t second = ((const uint64_t *)column_of(world, "id").data)[1];
    assert_true(slosh_world_write(world, NULL, still, v.count, 0, &error));
    v = column_of(world, "velocity");
    const uint64_t *id = column_of(world, "id").data;
    for (size_t i = 0; i < v.count; i++)
        assert_true(row(&v, i)[0] == (id[i] == second ? 0.5F : 0) && row(&v, i)[1] == 0);
    free(still);
    step(world, 1);
    slosh_world_destroy(world);
}

static void a_saved_state_goes_on_to_the_same_bits(void **state)
{
    (void)state;
    char path[SCRATCH_SIZE];
    slosh_world *world = world_of("dam_break", NULL), *other = world_of("dam_break", NULL);
    step(world, 3);
    assert_true(slosh_world_save(world, scratch_name(path, ".h5part"), &error));
    step(world, 3);
    if (!slosh_world_load(other, path, &error))
        fail_msg("%s", error.message);
    assert_float_equal(slosh_world_time(other), 0.5 * slosh_world_time(world), 1e-9);
    step(other, 3);
    assert_int_equal(slosh_world_hash(other), slosh_world_hash(world));
    slosh_world_destroy(other);
    other = world_of("dam_break", "fluids[0].viscosity=3");
    assert_false(slosh_world_load(other, path, &error));
    check_said("viscosity");
    slosh_world_destroy(other);
    slosh_world_destroy(world);
}

static void a_run_is_recorded_and_opened(void **state)
{
    (void)state;
    char path[SCRATCH_SIZE];
    slosh_world *world = world_of("dam_break", NULL);
    slosh_record *record = slosh_record_create(world, scratch_name(path, ".h5part"), &error);
    for (int k = 0; k < 3; k++) {
        assert_true(slosh_record_add(record, world, &error));
        step(world, 1);
    }
    slosh_record_close(record);
    slosh_run *run = slosh_run_open(path, &error);
    double time = 0;
    slosh_column x = {.size = sizeof x};
    assert_non_null(run);
    assert_int_equal(slosh_run_count(run), 3);
    assert_true(slosh_run_time(run, 2, &time, &error));
    assert_float_equal(time, slosh_world_time(world) * 2 / 3, 1e-9);
    for (size_t k = 0; slosh_run_column_name(run, k); k++) {
        assert_true(slosh_run_column(run, 1, slosh_run_column_name(run, k), &x, &error));
        assert_int_equal(x.count, slosh_world_count(world));
    }
    x.data = NULL;
    assert_true(slosh_run_column(run, 0, "speed", &x, &error));
    assert_true(*row(&x, 0) == 0);
    assert_true(slosh_run_column(run, 2, "speed", &x, &error));
    assert_true(*row(&x, 0) > 0);
    assert_false(slosh_run_column(run, 3, "position", &x, &error));
    check_said("there is no step 3");
    assert_false(slosh_run_column(run, 0, "colour", &x, &error));
    check_said("no such column");
    slosh_run_close(run);
    slosh_world_destroy(world);
}

static void forces_and_probes(void **state)
{
    (void)state;
    slosh_world *world = world_of("impact", NULL);
    double force[3], torque[3], values[8] = {0};
    assert_true(slosh_world_watch_forces(world, &error));
    assert_true(slosh_world_force(world, -1, force, torque, &error) == 0);
    step(world, 3);
    const double time = slosh_world_time(world);
    assert_float_equal(slosh_world_force(world, -1, force, torque, &error), time, 1e-6);
    assert_true(force[1] < 0); /* weight */
    assert_true(slosh_world_force(world, -1, force, NULL, &error) == 0);
    assert_true(slosh_world_force(world, 99, force, torque, &error) < 0);
    check_said("there is no solid 99");
    const size_t count = slosh_world_probe_count(world);
    assert_in_range(count, 1, 8);
    assert_non_null(strchr(slosh_world_probe_name(world, 0), '.'));
    assert_non_null(slosh_world_probe_unit(world, 0));
    assert_null(slosh_world_probe_name(world, count));
    assert_true(slosh_world_read_probes(world, values, count, &error));
    assert_false(slosh_world_read_probes(world, values, count + 1, &error));
    check_said("there is room for");
    slosh_world_destroy(world);
}

static void count_words(void *user, const char *words)
{
    *(int *)user += strlen(words) > 0;
}

static void changes_and_the_box(void **state)
{
    (void)state;
    int told = 0;
    double g[3], position[3], orientation[4];
    slosh_world *world = world_of("dam_break", NULL);
    slosh_world_on_message(world, count_words, &told);
    assert_true(slosh_world_set(world, "gravity=[0, -3, 0]", &error));
    step(world, 1);
    slosh_world_gravity(world, g);
    assert_float_equal(g[1], -3, 1e-12);
    assert_non_null(strstr(slosh_world_settings(world), "\"gravity\""));
    assert_false(slosh_world_set(world, "box.depth=3", &error));
    check_said("box.depth");
    assert_false(slosh_world_set(world, "gravity", &error));
    check_said("path=value");
    assert_false(slosh_world_set(world, "solver.backend=compute", &error));
    check_said("GPU");
    assert_true(slosh_world_carry_box(world, (double[]){0.3, 0, 0}, NULL, &error));
    step(world, 1);
    slosh_world_box(world, position, orientation);
    assert_float_equal(position[0], 0.3, 1e-9);
    assert_true(slosh_world_move_box(world, (double[]){0, 0, 0}, (double[]){0, 0, 0, 2}, &error));
    step(world, 5);
    slosh_world_box(world, position, orientation);
    assert_true(position[0] < 0.29);
    assert_false(slosh_world_move_box(world, (double[]){NAN, 0, 0}, NULL, &error));
    check_said("finite");
    slosh_world_destroy(world);
}

static void a_mesh_is_closed(void **state)
{
    (void)state;
    slosh_world *world = world_of("dam_break", NULL);
    slosh_mesh *mesh = slosh_mesh_create(world, 0, 0, &error);
    assert_non_null(mesh);
    const double spacing = slosh_world_spacing(world);
    const double volume = (double)slosh_world_count(world) * spacing * spacing * spacing;
    assert_float_equal(slosh_mesh_volume(mesh), volume, 0.15 * volume);
    /* Euler: a closed surface without holes has 2 (vertices - 2) triangles */
    assert_int_equal(slosh_mesh_triangle_count(mesh), 2 * (slosh_mesh_vertex_count(mesh) - 2));
    const uint32_t *triangle = slosh_mesh_triangles(mesh);
    const float *vertex = slosh_mesh_vertices(mesh);
    double enclosed = 0;
    for (size_t i = 0; i < slosh_mesh_triangle_count(mesh); i++) {
        const float *a = vertex + 3 * triangle[3 * i], *b = vertex + 3 * triangle[3 * i + 1],
                    *c = vertex + 3 * triangle[3 * i + 2];
        enclosed += (double)(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                             a[2] * (b[0] * c[1] - b[1] * c[0])) /
                    6;
    }
    assert_float_equal(enclosed, slosh_mesh_volume(mesh), 0.01 * volume);
    const slosh_column x = column_of(world, "position");
    for (int k = 0; k < 3; k++) { /* the middle of mesh and particles */
        float low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
        for (size_t i = 0; i < slosh_mesh_vertex_count(mesh); i++)
            low[0] = fminf(low[0], vertex[3 * i + k]), high[0] = fmaxf(high[0], vertex[3 * i + k]);
        for (size_t i = 0; i < x.count; i++)
            low[1] = fminf(low[1], row(&x, i)[k]), high[1] = fmaxf(high[1], row(&x, i)[k]);
        assert_float_equal(low[0] + high[0], low[1] + high[1], 0.3 * spacing);
    }
    slosh_mesh_free(mesh);
    assert_null(slosh_mesh_create(world, 2, 0, &error));
    check_said("level");
    slosh_world_destroy(world);
    world = world_of("dam_break_2d", NULL);
    assert_null(slosh_mesh_create(world, 0, 0, &error));
    check_said("two dimensions");
    slosh_world_destroy(world);
}

/* ---- two worlds in two threads ---- */

typedef struct Alone {
    const char *scene;
    uint64_t hash;
} Alone;

static void *run_alone(void *user)
{
    Alone *alone = user;
    slosh_world *world = world_of(alone->scene, NULL);
    char path[SCRATCH_SIZE];
    slosh_column x = {.size = sizeof x};
    snprintf(path, sizeof path, "%s/slosh-%s-%d.h5part", P_tmpdir, alone->scene, (int)getpid());
    for (int k = 0; k < 5; k++) {
        slosh_world_step(world, NULL);
        slosh_world_column(world, "position", &x, NULL);
        slosh_world_save(world, path, NULL);
    }
    unlink(path);
    alone->hash = slosh_world_hash(world);
    slosh_world_destroy(world);
    return NULL;
}

static void two_worlds_in_two_threads(void **state)
{
    (void)state;
    Alone alone[2] = {{"dam_break", 0}, {"dam_break_2d", 0}},
          beside[2] = {{"dam_break", 1}, {"dam_break_2d", 1}};
    pthread_t thread[2];
    for (int k = 0; k < 2; k++)
        run_alone(&alone[k]);
    for (int k = 0; k < 2; k++)
        pthread_create(&thread[k], NULL, run_alone, &beside[k]);
    for (int k = 0; k < 2; k++) {
        pthread_join(thread[k], NULL);
        assert_int_equal(beside[k].hash, alone[k].hash);
    }
    assert_int_not_equal(alone[0].hash, alone[1].hash);
}

/* ---- wrong input ---- */

static void refuse_scene(const char *name, const char *setting, const char *word)
{
    assert_null(slosh_scene_load(name, &setting, setting ? 1 : 0, &error));
    check_said(word);
}

static void wrong_scenes_are_errors(void **state)
{
    (void)state;
    static const char text[] = "title: Twice\nbox: {size: [1, 1]}\nnonsense: 3\n";
    refuse_scene("dam_braek", NULL, "dam_break");
    refuse_scene("/nowhere/mine.yaml", NULL, "/nowhere/mine.yaml");
    refuse_scene("dam_break", "fluids[0].viscosty=2", "did you mean 'viscosity'");
    refuse_scene("dam_break", "particles=many", "particles=many");
    refuse_scene(NULL, NULL, "NULL");
    assert_null(slosh_scene_parse("mine.yaml", text, sizeof text - 1, NULL, 0, &error));
    check_said("mine.yaml:");
    assert_null(slosh_scene_parse("mine.yaml", NULL, 3, NULL, 0, &error));
    check_said("NULL");
    const size_t large = 2 << 20;
    char *spaces = malloc(large);
    memset(spaces, ' ', large);
    assert_null(slosh_scene_parse("mine.yaml", spaces, large, NULL, 0, &error));
    check_said("1 MiB");
    free(spaces);
    assert_null(slosh_scene_load("dam_break", NULL, 2, &error));
    check_said("NULL");
    assert_null(slosh_scene_load("dam_braek", NULL, 0, NULL));
    slosh_scene *scene = slosh_scene_load("dam_break", (const char *[]){"solver.backend=compute"}, 1, &error);
    assert_non_null(scene);
    assert_string_equal(slosh_scene_title(scene), "Dam break");
    assert_non_null(strstr(slosh_scene_path(scene), "dam_break.yaml"));
    assert_non_null(strstr(slosh_scene_settings(scene), "\"fluids[0].viscosity\""));
    assert_null(slosh_scene_note(scene, slosh_scene_note_count(scene)));
    assert_null(slosh_world_create(scene, &error));
    check_said("GPU");
    slosh_scene_free(scene);
    assert_non_null(slosh_scene_name(0));
    assert_null(slosh_scene_name(1000));
}

static void wrong_calls_are_errors(void **state)
{
    (void)state;
    slosh_world *world = world_of("dam_break", NULL);
    slosh_column column = {.size = sizeof column};
    const size_t count = slosh_world_count(world);
    float *data = calloc(count, 3 * sizeof *data);
    assert_false(slosh_world_column(world, "colour", &column, &error));
    check_said("the world has position, velocity");
    assert_false(slosh_world_column(world, NULL, &column, &error));
    check_said("NULL");
    column.size = 3;
    assert_false(slosh_world_column(world, "position", &column, &error));
    check_said("size");
    assert_false(slosh_world_write(world, NULL, data, count - 1, 0, &error));
    check_said("rows");
    assert_false(slosh_world_write(world, NULL, data, count, 4, &error));
    check_said("stride");
    data[4] = -1;
    assert_false(slosh_world_write(world, data, NULL, count, 0, &error));
    check_said("outside the box");
    data[4] = NAN;
    assert_false(slosh_world_write(world, NULL, data, count, 0, &error));
    check_said("finite");
    assert_false(slosh_world_save(world, "state.txt", &error));
    check_said(".h5part");
    assert_false(slosh_world_save(world, "/nowhere/state.h5part", &error));
    check_said("/nowhere");
    assert_false(slosh_world_load(world, "/nowhere/state.h5part", &error));
    check_said("/nowhere");
    assert_null(slosh_run_open("/nowhere/state.h5part", &error));
    check_said("/nowhere");
    assert_false(slosh_world_run(world, INFINITY, &error));
    check_said("finite");
    free(data);
    slosh_world_destroy(world);
}

static void null_is_an_error(void **state)
{
    (void)state;
    slosh_column column = {.size = sizeof column};
    double v[4] = {0};
    assert_false(slosh_world_step(NULL, &error) || slosh_world_run(NULL, 1, NULL) ||
                 slosh_world_column(NULL, "id", &column, &error) ||
                 slosh_world_save(NULL, "a.h5part", &error) || slosh_world_load(NULL, "a.h5part", &error) ||
                 slosh_world_set(NULL, "gravity=1", &error) ||
                 slosh_world_write(NULL, NULL, NULL, 0, 0, &error) ||
                 slosh_world_move_box(NULL, v, NULL, &error) || slosh_world_read_probes(NULL, v, 0, &error) ||
                 slosh_run_column(NULL, 0, "id", &column, &error) || slosh_record_add(NULL, NULL, &error));
    assert_null(slosh_world_create(NULL, &error));
    check_said("NULL");
    assert_null(slosh_mesh_create(NULL, 0, 0, &error));
    assert_null(slosh_record_create(NULL, "a.h5part", &error));
    assert_null(slosh_run_open(NULL, &error));
    assert_true(slosh_world_force(NULL, -1, v, v, &error) < 0);
    assert_int_equal(slosh_world_count(NULL), 0);
    assert_null(slosh_world_outcome(NULL));
    assert_null(slosh_scene_title(NULL));
    slosh_world_box(NULL, v, v);
    slosh_world_destroy(NULL);
    slosh_scene_free(NULL);
    slosh_mesh_free(NULL);
    slosh_run_close(NULL);
    slosh_record_close(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_world_steps),
        cmocka_unit_test(columns_are_of_the_present_state),
        cmocka_unit_test(what_is_written_is_read),
        cmocka_unit_test(a_saved_state_goes_on_to_the_same_bits),
        cmocka_unit_test(a_run_is_recorded_and_opened),
        cmocka_unit_test(forces_and_probes),
        cmocka_unit_test(changes_and_the_box),
        cmocka_unit_test(a_mesh_is_closed),
        cmocka_unit_test(two_worlds_in_two_threads),
        cmocka_unit_test(wrong_scenes_are_errors),
        cmocka_unit_test(wrong_calls_are_errors),
        cmocka_unit_test(null_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
