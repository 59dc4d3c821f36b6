/* A file of snapshots for views: states to the bit, the original scene, and errors for invalid files. */
#include "tests/playback/recorded_fixture.h"

#include "app/scene/scene.h"
#include "sim/step/method.h"
#include "sim/world.h"

#include <hdf5.h>

/* ---- states ---- */

static void assert_same_floats(const char *what, const float *a, const float *b, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (memcmp(&a[i], &b[i], sizeof *a) != 0)
            fail_msg("%s: number %zu is %.9g, not %.9g", what, i, (double)a[i], (double)b[i]);
}

static void assert_same_still(const StateCopy *a, const StateCopy *b, unsigned attributes)
{
    const size_t count = b->state.count;
    assert_int_equal(a->state.count, count);
    assert_true(a->state.time == b->state.time && a->state.step == b->state.step);
    assert_memory_equal(&a->state.box, &b->state.box, sizeof a->state.box);
    assert_memory_equal(a->state.gravity, b->state.gravity, sizeof a->state.gravity);
    assert_memory_equal(a->state.box_size, b->state.box_size, sizeof a->state.box_size);
    assert_true(a->state.spacing == b->state.spacing);
    assert_true(fabs(a->state.support_radius / b->state.support_radius - 1) < 1e-7); /* a world has a float */
    for (size_t i = 0; i < count; i++) {
        assert_same_floats("position", &a->arrays.position[4 * i], &b->arrays.position[4 * i], 3);
        assert_true(fabsf(a->arrays.position[4 * i + 3] / b->arrays.position[4 * i + 3] - 1) < 1e-5F);
    }
    assert_same_floats("velocity", a->arrays.velocity, b->arrays.velocity, 4 * count);
    assert_memory_equal(a->arrays.fluid, b->arrays.fluid, count * sizeof *a->arrays.fluid);
    assert_memory_equal(a->arrays.id, b->arrays.id, count * sizeof *a->arrays.id);
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (attributes & PARTICLE_SCALAR(s))
            assert_same_floats(scalar_name((Scalar)s), a->arrays.scalar[s], b->arrays.scalar[s], count);
        else
            assert_null(a->arrays.scalar[s]);
}

static void run_and_read(const char *method)
{
    enum { STEPS = 4 };
    char setting[64];
    snprintf(setting, sizeof setting, "solver.method=%s", method);
    const Scene scene = tank_scene(setting);
    const unsigned all = columns_scalars(&scene.world);
    Error error = {{0}};
    StateCopy lived[STEPS] = {{.capacity = 0}}, read = {.capacity = 0};
    Recorded recorded;
    World *world = world_create(&scene.world, &error);
    SnapshotWriter *file = snapshot_create("a.h5part", &scene, &error);
    must(world && file, &error);
    for (int k = 0; k < STEPS; k++) {
        must(snapshot_append(file, world, &error), &error);
        assert_true(state_copy_read(&lived[k], world, all));
        must(world_step(world, NULL, &error), &error);
    }
    snapshot_close(file);
    open_recorded(&recorded, "a.h5part", NULL);
    assert_int_equal(recorded.steps, STEPS);
    for (int k = STEPS; k-- > 0;) {
        must(recorded_read(&recorded, (size_t)k, all, &read, &error), &error);
        assert_same_still(&read, &lived[k], all);
        state_copy_free(&lived[k]);
    }
    state_copy_free(&read);
    must(recorded_read(&recorded, 1, PARTICLE_SCALAR(SCALAR_SPEED), &read, &error), &error);
    assert_true(read.arrays.scalar[SCALAR_SPEED] && !read.arrays.scalar[SCALAR_PRESSURE]);
    state_copy_free(&read);
    recorded_close(&recorded);
    world_destroy(world);
}

static void states_are_those_that_were_written(void **state)
{
    (void)state;
    for (const Method *const *method = method_list(); *method; method++)
        run_and_read((*method)->name);
}

static void the_newest_step_at_or_before_a_time(void **state)
{
    (void)state;
    enum { STEPS = 100 };
    size_t counts[STEPS], index;
    Error error = {{0}};
    Recorded recorded;
    for (size_t k = 0; k < STEPS; k++)
        counts[k] = k % 3;
    write_file("a.h5part", counts, STEPS, 0.1);
    open_recorded(&recorded, "a.h5part", NULL);
    assert_true(recorded.first == 0 && fabs(recorded.last - 9.9) < 1e-12);
    const struct {
        double time;
        size_t index;
    } cases[] = {{-1, 0}, {0, 0}, {0.05, 0}, {0.1 - 1e-12, 1}, {0.1, 1}, {5.55, 55}, {9.9, 99}, {1e9, 99}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        must(recorded_find(&recorded, cases[k].time, &index, &error), &error);
        assert_int_equal(index, cases[k].index);
    }
    recorded_close(&recorded);
}

/* ---- the scene ---- */

static void assert_scene_comes_back(const Scene *scene, const SceneSettings *settings)
{
    Error error = {{0}};
    Notes notes = {.count = 0};
    Recorded recorded;
    SnapshotWriter *file = snapshot_create("a.h5part", scene, &error);
    must(file, &error);
    append(file, 1, 0);
    snapshot_close(file);
    if (!recorded_open("a.h5part", settings, &recorded, &notes, &error))
        fail_msg("%s: %s", scene->path, error.message);
    if (notes.count > 0)
        fail_msg("%s: %s", scene->path, notes.line[0]);
    char *was = scene_print_text(scene), *is = scene_print_text(&recorded.scene);
    assert_string_equal(is, was);
    assert_int_equal(recorded.scene.world.dimensions, scene->world.dimensions);
    assert_true(recorded.scene.world.spacing == scene->world.spacing);
    assert_memory_equal(recorded.scene.world.box_size, scene->world.box_size, sizeof scene->world.box_size);
    assert_memory_equal(recorded.scene.view.background, scene->view.background,
                        sizeof scene->view.background);
    for (int i = 0; i < scene->world.fluid_count; i++)
        assert_memory_equal(recorded.scene.world.fluids[i].color, scene->world.fluids[i].color,
                            sizeof scene->world.fluids[i].color);
    free(was);
    free(is);
    recorded_close(&recorded);
}

static void each_scene_comes_back(void **state)
{
    (void)state;
    const Scene own = tank_scene(NULL);
    assert_scene_comes_back(&own, NULL);
    struct dirent *entry;
    DIR *dir = opendir(SLOSH_SOURCE_DIR "/scenes");
    int found = 0;
    while (dir && (entry = readdir(dir))) {
        char path[600];
        Scene scene;
        Error error = {{0}};
        snprintf(path, sizeof path, "%s/scenes/%.200s", SLOSH_SOURCE_DIR, entry->d_name);
        if (!strstr(entry->d_name, ".yaml") ||
            !scene_load(path, &(SceneSettings){.count = 0}, &scene, NULL, &error))
            continue;
        assert_scene_comes_back(&scene, NULL);
        found++;
    }
    closedir(dir);
    assert_true(found > 15);
}

static bool open_with(const char *setting, Recorded *recorded, Notes *notes, Error *error)
{
    const SceneSettings settings = {.count = 1, .set = {setting}};
    *notes = (Notes){.count = 0};
    return recorded_open("a.h5part", &settings, recorded, notes, error);
}

static void settings_of_the_view_alone(void **state)
{
    (void)state;
    Error error = {{0}};
    Notes notes;
    Recorded recorded;
    write_file("a.h5part", (const size_t[]){3, 4}, 2, 0.1);
    must(open_with("view.kind=splat", &recorded, &notes, &error), &error);
    assert_string_equal(recorded.scene.view.kind, "splat");
    assert_int_equal(notes.count, 0);
    recorded_close(&recorded);
    must(open_with("view.color_by=density", &recorded, &notes, &error), &error);
    assert_true(recorded.scene.view.range_auto); /* the file's is of the speed */
    recorded_close(&recorded);
    must(open_with("view.splat.level=0.1", &recorded, &notes, &error), &error);
    assert_string_equal(notes.line[0], "view.splat.level has no effect; it needs view.kind: splat");
    recorded_close(&recorded);
    assert_false(open_with("solver.step.dt=0.1", &recorded, &notes, &error));
    assert_contains(error.message,
                    "--set solver.step.dt=0.1 makes no sense for a.h5part: nothing is simulated");
    assert_false(open_with("view.radius=-1", &recorded, &notes, &error));
    assert_contains(error.message, "--set view.radius=-1: view.radius");
    assert_false(open_with("view.kind=splot", &recorded, &notes, &error));
    assert_contains(error.message, "did you mean 'splat'?");
}

/* ---- damaged files ---- */

static void edit(void (*change)(hid_t file))
{
    write_file("a.h5part", (const size_t[]){5, 6, 7}, 3, 0.1);
    const hid_t file = H5Fopen("a.h5part", H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(file >= 0);
    change(file);
    H5Fclose(file);
}

static void remove_field(hid_t file, const char *name)
{
    for (int k = 0; k < 3; k++) {
        char path[64];
        snprintf(path, sizeof path, "Step#%d/%s", k, name);
        assert_true(H5Ldelete(file, path, H5P_DEFAULT) >= 0);
    }
}

static void remove_pressure(hid_t file)
{
    remove_field(file, "pressure");
}

static void remove_all_but_places(hid_t file)
{
    static const char *const names[] = {"velocity_0", "velocity_1",  "velocity_2", "density",
                                        "pressure",   "compression", "fluid",      "id"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        remove_field(file, names[k]);
}

static void remove_density_later(hid_t file)
{
    assert_true(H5Ldelete(file, "Step#1/density", H5P_DEFAULT) >= 0);
}

static void what_is_missing_is_told(void **state)
{
    (void)state;
    Error error = {{0}};
    Notes notes = {.count = 0};
    Recorded recorded;
    StateCopy still = {.capacity = 0};
    edit(remove_pressure);
    open_recorded(&recorded, "a.h5part", &notes);
    assert_string_equal(notes.line[0], "a.h5part: has no pressure; what follows from that cannot be shown");
    ViewDef view = recorded.scene.view;
    assert_true(recorded_has(&recorded, &view, &error));
    view.color_by = SCALAR_PRESSURE;
    assert_false(recorded_has(&recorded, &view, &error));
    assert_contains(error.message,
                    "a.h5part: has no pressure to colour by; view.color_by may be speed, density,");
    view.color_by = SCALAR_SPEED;
    view.size.by = 1 + SCALAR_VORTICITY;
    assert_true(recorded_has(&recorded, &view, &error));
    view.opacity.by = 1 + SCALAR_PRESSURE;
    assert_false(recorded_has(&recorded, &view, &error));
    assert_contains(error.message, "a.h5part: view.opacity.by needs pressure, which the file has not");
    must(recorded_read(&recorded, 2, PARTICLE_SCALAR(SCALAR_STATE_COUNT) - 1, &still, &error), &error);
    assert_true(still.state.count == 7 && !still.arrays.scalar[SCALAR_PRESSURE] &&
                still.arrays.scalar[SCALAR_DENSITY]);
    state_copy_free(&still);
    recorded_close(&recorded);
    notes.count = 0;
    edit(remove_all_but_places);
    open_recorded(&recorded, "a.h5part", &notes);
    assert_contains(notes.line[0], "a.h5part: has no velocity_0, velocity_1, velocity_2, density, pressure,");
    assert_contains(notes.line[0], "and particles have the volume of fluid at rest");
    assert_int_equal(recorded.attributes,
                     PARTICLE_FLUID +
                         PARTICLE_SCALAR(SCALAR_BORN)); /* all of the first, and since the start */
    view = recorded.scene.view;
    view.color_by = SCALAR_AGE;
    assert_true(recorded_has(&recorded, &view, &error));
    must(recorded_read(&recorded, 1, ~0U, &still, &error), &error);
    assert_int_equal(still.state.count, 6);
    assert_true(still.arrays.scalar[SCALAR_BORN][5] == 0);
    assert_true(fabsf(still.arrays.position[3] - 1e-3F) < 1e-9F);
    state_copy_free(&still);
    recorded_close(&recorded);
    edit(remove_density_later);
    open_recorded(&recorded, "a.h5part", &notes);
    assert_false(recorded_read(&recorded, 1, ~0U, &still, &error));
    assert_string_equal(error.message, "a.h5part: Step#1 lacks what Step#0 has");
    recorded_close(&recorded);
}

/* Without the column: all from the start where the settings have no emitter. */
static void births_that_no_column_tells(void **state)
{
    (void)state;
    static const struct {
        const char *set;
        bool known;
    } cases[] = {
        {NULL, true},
        {"title=\"fluids[0].emit[0] is gone\"", true},
        {"fluids[1].emit=[{disk: {centre: [0, 0.6, 0], direction: [0, -1, 0], radius: 0.2}, speed: 1}]",
         false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Error error = {{0}};
        Notes notes = {.count = 0};
        Recorded recorded;
        const Scene scene = tank_scene(cases[i].set);
        SnapshotWriter *file = snapshot_create("births.h5part", &scene, &error);
        must(file, &error);
        append(file, 3, 0);
        snapshot_close(file);
        open_recorded(&recorded, "births.h5part", &notes);
        assert_int_equal((recorded.attributes & PARTICLE_SCALAR(SCALAR_BORN)) != 0, cases[i].known);
        recorded_close(&recorded);
    }
}

static void spoil_particles(hid_t file)
{
    float x[] = {NAN, 0, 0, 0, 1e9F, 0, 0}, density[] = {1, 1, -1, 1, 1, 1, 1};
    int32_t fluid[] = {0, 1, 0, 7, 0, 0, 0};
    const hid_t places = H5Dopen2(file, "Step#2/x", H5P_DEFAULT),
                fluids = H5Dopen2(file, "Step#2/fluid", H5P_DEFAULT),
                densities = H5Dopen2(file, "Step#2/density", H5P_DEFAULT);
    assert_true(H5Dwrite(places, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, x) >= 0);
    assert_true(H5Dwrite(fluids, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, fluid) >= 0);
    assert_true(H5Dwrite(densities, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, density) >= 0);
    H5Dclose(places);
    H5Dclose(fluids);
    H5Dclose(densities);
}

/* No shader receives a non-finite position or an invalid fluid number. */
static void spoilt_particles_are_left_out(void **state)
{
    (void)state;
    Error error = {{0}};
    Recorded recorded;
    StateCopy still = {.capacity = 0};
    edit(spoil_particles);
    open_recorded(&recorded, "a.h5part", NULL);
    must(recorded_read(&recorded, 2, ~0U, &still, &error), &error);
    assert_int_equal(still.state.count, 3);
    assert_int_equal(still.arrays.fluid[0], 1);
    assert_int_equal(snapshot_flaws_left_out(&recorded.flaws), 4);
    state_copy_free(&still);
    recorded_close(&recorded);
}

static void huge_field(hid_t file)
{
    const hsize_t size = (hsize_t)1 << 45, chunk = 1 << 16;
    assert_true(H5Ldelete(file, "Step#1/x", H5P_DEFAULT) >= 0);
    const hid_t space = H5Screate_simple(1, &size, NULL), layout = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(layout, 1, &chunk);
    const hid_t set = H5Dcreate2(file, "Step#1/x", H5T_IEEE_F32LE, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    assert_true(set >= 0);
    H5Dclose(set);
    H5Pclose(layout);
    H5Sclose(space);
}

static void a_hostile_size_asks_for_no_memory(void **state)
{
    (void)state;
    Error error = {{0}};
    Recorded recorded;
    StateCopy still = {.capacity = 0};
    edit(huge_field);
    open_recorded(&recorded, "a.h5part", NULL);
    assert_false(recorded_read(&recorded, 1, ~0U, &still, &error));
    assert_string_equal(error.message, "a.h5part: Step#1: out of memory for 35184372088832 particles");
    must(recorded_read(&recorded, 2, ~0U, &still, &error), &error);
    state_copy_free(&still);
    recorded_close(&recorded);
}

static void remove_marks(hid_t file)
{
    for (int k = 0; k < 3; k++) {
        char name[32];
        snprintf(name, sizeof name, "Step#%d", k);
        assert_true(H5Adelete_by_name(file, name, "complete", H5P_DEFAULT) >= 0);
    }
}

static void remove_mark_in_the_middle(hid_t file)
{
    assert_true(H5Adelete_by_name(file, "Step#1", "complete", H5P_DEFAULT) >= 0);
}

static void remove_last_mark(hid_t file)
{
    assert_true(H5Adelete_by_name(file, "Step#2", "complete", H5P_DEFAULT) >= 0);
}

static void remove_first(hid_t file)
{
    assert_true(H5Ldelete(file, "Step#0", H5P_DEFAULT) >= 0);
}

static void remove_middle(hid_t file)
{
    assert_true(H5Ldelete(file, "Step#1", H5P_DEFAULT) >= 0);
}

static void remove_spacing(hid_t file)
{
    assert_true(H5Adelete(file, "spacing") >= 0);
}

static void assert_refused(const char *path, const char *why)
{
    Error error = {{0}};
    Recorded recorded;
    assert_false(recorded_open(path, NULL, &recorded, NULL, &error));
    assert_contains(error.message, path);
    assert_contains(error.message, why);
}

static void what_is_no_file_of_snapshots(void **state)
{
    (void)state;
    assert_refused("missing.h5part", "cannot be read: No such file");
    write_text("empty.h5part", "");
    assert_refused("empty.h5part", "is no file of snapshots");
    write_text("text.h5part", "Step#0");
    assert_refused("text.h5part", "is no file of snapshots");
    H5Fclose(H5Fcreate("other.h5part", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    assert_refused("other.h5part", "has no particles that slosh finds; they must be in groups Step#0");
    edit(remove_marks); /* as of a different program */
    assert_refused("a.h5part",
                   "Step#0 is missing or not whole, but there are 2 behind it, such as 'Step#1'; shown is "
                   "what slosh run has written whole, from Step#0 on");
    edit(remove_first);
    assert_refused("a.h5part", "Step#0 is missing or not whole, but there are 2 behind it");
    edit(remove_spacing);
    assert_refused("a.h5part", "'spacing' is missing");
    write_file("a.h5part", (const size_t[]){50, 60, 70}, 3, 0.1);
    assert_int_equal(truncate("a.h5part", 20000), 0);
    assert_refused("a.h5part", "is no file of snapshots");
}

static void steps_that_are_not_whole(void **state)
{
    (void)state;
    Error error = {{0}};
    Notes notes = {.count = 0};
    Recorded recorded;
    StateCopy still = {.capacity = 0};
    edit(remove_last_mark);
    open_recorded(&recorded, "a.h5part", &notes);
    assert_int_equal(recorded.steps, 2);
    assert_int_equal(notes.count, 0); /* a run that is being written, or was killed */
    recorded_close(&recorded);
    edit(remove_mark_in_the_middle);
    open_recorded(&recorded, "a.h5part", &notes);
    assert_int_equal(recorded.steps, 3);
    assert_false(recorded_read(&recorded, 1, ~0U, &still, &error));
    assert_string_equal(error.message, "a.h5part: Step#1 is not whole");
    recorded_close(&recorded);
    edit(remove_middle);
    open_recorded(&recorded, "a.h5part", &notes);
    assert_int_equal(recorded.steps, 1);
    assert_contains(notes.line[0],
                    "Step#1 is missing or not whole, but there is 'Step#2'; only the 1 before it");
    recorded_close(&recorded);
}

static void replace_settings(hid_t file, const char *text)
{
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, strlen(text) + 1);
    H5Adelete(file, "settings");
    const hid_t attribute = H5Acreate2(file, "settings", type, space, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(attribute >= 0 && H5Awrite(attribute, type, text) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
}

static void older_settings(hid_t file)
{
    replace_settings(file,
                     "title = Old\nsolver.gone = 3 m\nfluids[0].fill[0].block.min = [-0.5, 0, -0.5] m\n"
                     "fluids[0].fill[0].block.max = [0, 0.5, 0.5] m\n"
                     "fluids[1].fill[0].block.min = [0, 0, -0.5] m\n"
                     "fluids[1].fill[0].block.max = [0.5, 0.5, 0.5] m\nview.kind = volume\nview.past = 1\n");
}

static void broken_settings(hid_t file)
{
    replace_settings(file, "fluids[0].name = \nview.radius = many\nfluids[0].fill = [[[\n= =\n = ");
}

static void remove_settings(hid_t file)
{
    assert_true(H5Adelete(file, "settings") >= 0);
}

static void settings_that_are_no_scene(void **state)
{
    (void)state;
    Notes notes = {.count = 0};
    Recorded recorded;
    edit(older_settings);
    open_recorded(&recorded, "a.h5part", &notes);
    assert_string_equal(recorded.scene.view.kind, "volume");
    assert_string_equal(notes.line[0], "a.h5part: 2 of its settings are not known to this slosh, such as "
                                       "'solver.gone'; left out");
    recorded_close(&recorded);
    notes.count = 0;
    edit(remove_settings);
    open_recorded(&recorded, "a.h5part", &notes);
    assert_string_equal(notes.line[0],
                        "a.h5part: says nothing of its settings; shown without solids, and with "
                        "the view's defaults");
    assert_int_equal(recorded.scene.world.fluid_count, 2);
    assert_true(recorded.scene.world.box_size[1] == 1 && recorded.scene.world.solid_count == 0);
    recorded_close(&recorded);
    notes.count = 0;
    edit(broken_settings);
    open_recorded(&recorded, "a.h5part", &notes);
    assert_contains(notes.line[0], "a.h5part: its settings are no scene of this slosh: ");
    recorded_close(&recorded);
}

static void a_file_that_grows(void **state)
{
    (void)state;
    Error error = {{0}};
    Recorded recorded;
    StateCopy still = {.capacity = 0};
    const Scene scene = tank_scene(NULL);
    SnapshotWriter *file = snapshot_create("a.h5part", &scene, &error);
    must(file, &error);
    append(file, 4, 0);
    open_recorded(&recorded, "a.h5part", NULL);
    for (int k = 1; k < 300; k++) { /* the directory grows too */
        append(file, 4 + (size_t)k, 0.1 * k);
        if (k % 50)
            continue;
        must(recorded_follow(&recorded, &error), &error);
        assert_int_equal(recorded.steps, k + 1);
        assert_true(recorded.last == 0.1 * k);
        must(recorded_read(&recorded, (size_t)k, 0, &still, &error), &error);
        assert_int_equal(still.state.count, 4 + k);
    }
    snapshot_close(file);
    must(recorded_follow(&recorded, &error), &error);
    must(recorded_follow(&recorded, &error), &error);
    assert_int_equal(recorded.steps, 300);
    write_file("b.h5part", (const size_t[]){1}, 1, 0.1);
    assert_int_equal(rename("b.h5part", "a.h5part"), 0);
    assert_false(recorded_follow(&recorded, &error));
    assert_string_equal(error.message, "a.h5part: is another file now; open it anew");
    unlink("a.h5part");
    assert_false(recorded_follow(&recorded, &error));
    must(recorded_read(&recorded, 299, 0, &still, &error), &error); /* the already open file */
    state_copy_free(&still);
    recorded_close(&recorded);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, folder_setup, folder_teardown)
    const struct CMUnitTest tests[] = {
        TEST(states_are_those_that_were_written),
        TEST(the_newest_step_at_or_before_a_time),
        TEST(each_scene_comes_back),
        TEST(settings_of_the_view_alone),
        TEST(what_is_missing_is_told),
        TEST(births_that_no_column_tells),
        TEST(spoilt_particles_are_left_out),
        TEST(a_hostile_size_asks_for_no_memory),
        TEST(what_is_no_file_of_snapshots),
        TEST(steps_that_are_not_whole),
        TEST(settings_that_are_no_scene),
        TEST(a_file_that_grows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
