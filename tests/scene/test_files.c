/* Scene files on disk: shipped scenes, search paths, and invalid files. */
#include "tests/scene/scene_text.h"
#include "tests/scratch.h"

#include "app/scene/scene.h"
#include "render/frame/frame.h"
#include "render/frame/passes.h"
#include "sim/flow/flow.h"
#include "sim/gpu/gl.h"
#include "sim/start/start.h"
#include "sim/step/constants.h"
#include "sim/step/method.h"

#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static Scene scene;
static Error error;
static char folder[SCRATCH_SIZE];

static int make_folder(void **state)
{
    (void)state;
    scratch_folder(folder);
    return 0;
}

static bool load(const char *name, size_t particles)
{
    SceneSettings settings = {.particles = particles};
    return scene_load(name, &settings, &scene, NULL, &error);
}

/* Calls `visit` with the name of every shipped scene, without ".yaml"; returns how many there are. */
static int each_scene(void (*visit)(const char *name))
{
    DIR *scenes = opendir(SLOSH_SOURCE_DIR "/scenes");
    assert_non_null(scenes);
    int count = 0;
    for (struct dirent *entry; (entry = readdir(scenes));) {
        char name[64];
        const size_t length = strlen(entry->d_name);
        if (length < 6 || length >= sizeof name || strcmp(entry->d_name + length - 5, ".yaml") != 0)
            continue;
        memcpy(name, entry->d_name, length - 5);
        name[length - 5] = 0;
        visit(name);
        count++;
    }
    closedir(scenes);
    return count;
}

/* True if all corners of the box are in the picture, and none is below the legend. */
static bool shows_the_box(const Scene *of, int width, int height)
{
    const double *size = of->world.box_size, edge = 0.01;
    const CoveredParts legend = legend_room(&of->view, &of->world, width, height);
    const ViewDef seen = camera_at(&of->view, 0);
    BoxState box;
    Camera camera;
    box_state_at(of->world.motions, of->world.motion_count, size[1], 0, &box);
    camera_make(&seen, size, &box, (double)width / height, (CoveredParts){0}, &camera);
    for (int i = 0; i < 8; i++) {
        const double corner[3] = {size[0] * ((i & 1) - 0.5), size[1] * (i >> 1 & 1),
                                  size[2] * ((i >> 2) - 0.5)};
        double at[3], pixel[2], depth;
        box_to_world(&box, corner, NULL, at, NULL);
        if (!camera_project(&camera, at, width, height, pixel, &depth) || pixel[0] < edge * width ||
            pixel[0] > (1 - edge) * width || pixel[1] < edge * height || pixel[1] > (1 - edge) * height ||
            (pixel[0] > (1 - legend.right) * width && pixel[1] < legend.top * height))
            return false;
    }
    return true;
}

static int own_cameras;

static void check_camera(const char *name)
{
    if (!load(name, 0))
        fail_msg("%s", error.message);
    own_cameras += !scene.view.camera_auto;
    if (!scene.view.camera_auto && !shows_the_box(&scene, 1280, 720))
        fail_msg("%s cuts off the box, or its legend covers a corner", name);
}

/* Cameras of papers/ show parts, as the papers' figures. */
static void cameras_show_the_whole_box(void **state)
{
    (void)state;
    each_scene(check_camera);
    assert_true(own_cameras > 10);
}

static void check_scene(const char *name)
{
    if (!load(name, 0))
        fail_msg("%s", error.message);
    size_t count = seed_count(&scene.world, scene.world.spacing);
    if (count == 0) /* limit of the emitters' filling */
        count = (size_t)scene.world.most;
    assert_true(count >= 1000 && count <= 30000);
    assert_true(*scene.title);
    /* A substep must not let sound and the fastest flow (a third of sound) cross much more than half of
       h. Without a bound by sound, pressure bounds the step in deep fluid. In mode cfl the step is
       automatic. */
    const double h = scene.world.support * scene.world.spacing,
                 substep = scene.world.dt / scene.world.substeps;
    if (method_find(scene.world.method)->incompressible) {
        if (scene.world.step_mode == STEP_FIXED && substep > step_pressure(&scene.world))
            fail_msg("%s: the step is too long", name);
    } else if (scene.world.step_mode == STEP_FIXED && substep * scene.world.sound_speed * 4 / 3 > h)
        fail_msg("%s: the substep is too long for its sound_speed", name);
}

static void every_shipped_scene_loads(void **state)
{
    (void)state;
    assert_true(each_scene(check_scene) >= 4);
}

/* Fluid poured by emitters, in a scene without fills: layers of the disk, if emission ends. */
static void check_poured(const char *name)
{
    bool endless = false;
    double count = 0;
    for (int f = 0; f < scene.world.fluid_count; f++)
        for (int i = 0; i < scene.world.fluids[f].emit_count; i++)
            endless = endless || scene.world.fluids[f].emits[i].duration == 0;
    assert_true(load(name, 5000) != endless);
    if (endless) {
        assert_non_null(strstr(error.message, "its emitters have no `duration`"));
        return;
    }
    for (int f = 0; f < scene.world.fluid_count; f++)
        for (int i = 0; i < scene.world.fluids[f].emit_count; i++) {
            const Emit *emit = &scene.world.fluids[f].emits[i];
            count += M_PI * emit->radius * emit->radius * emit->speed * emit->duration /
                     pow(scene.world.spacing, 3);
        }
    assert_true(fabs(count / 5000 - 1) < 0.02);
}

/* Scenes with fills, or with pouring for some time. */
static void check_particles(const char *name)
{
    if (load(name, 0) && seed_count(&scene.world, scene.world.spacing) == 0) {
        check_poured(name);
        return;
    }
    static const size_t wanted[] = {1000, 8192, 20000, 100000, 400000};
    /* most time goes into the last two: a scene of blocks, a scene with a solid */
    const bool all = strcmp(name, "box_slosh") == 0 || strcmp(name, "pillar") == 0;
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted - (all ? 0 : 2); i++) {
        if (!load(name, wanted[i]))
            fail_msg("%s", error.message);
        const double count = (double)seed_count(&scene.world, scene.world.spacing);
        const double coarse = scene.world.solid_count > 0 ? 0.08 : 0.06; /* solids take whole layers away */
        const double miss = fabs(count / (double)wanted[i] - 1), allowed = wanted[i] < 5000 ? coarse : 0.025;
        if (miss > allowed)
            fail_msg("%s: --particles %zu gives %g", name, wanted[i], count);
    }
}

static void particles_come_near_in_every_scene(void **state)
{
    (void)state;
    assert_true(each_scene(check_particles) >= 4);
}

static void scenes_are_found_beside_the_sources(void **state)
{
    (void)state;
    char here[1024];
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(chdir(folder), 0);
    const bool found = load("box_slosh", 0) && load("box_slosh.yaml", 0) &&
                       load("scenes/box_slosh.yaml", 0) && load("scenes/box_slosh", 0);
    assert_int_equal(chdir(here), 0);
    if (!found)
        fail_msg("%s", error.message);
    assert_string_equal(scene.path, SLOSH_SOURCE_DIR "/scenes/box_slosh.yaml");
}

static void a_file_here_goes_first(void **state)
{
    (void)state;
    char path[SCRATCH_PATH];
    snprintf(path, sizeof path, "%s/mine.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(LEAST "title: Mine\n", file);
    fclose(file);
    const bool loaded = load(path, 0);
    unlink(path);
    assert_true(loaded);
    assert_string_equal(scene.title, "Mine");
    assert_string_equal(scene.path, path);
}

static void what_is_no_file_is_refused(void **state)
{
    (void)state;
    setenv("XDG_CONFIG_HOME", folder, 1);
    assert_false(load("no_such_scene", 0));
    char said[512];
    snprintf(said, sizeof said,
             "no_such_scene: no such file, neither here nor in %s/scenes nor in %s/slosh; name a scene file",
             SLOSH_SOURCE_DIR, folder);
    assert_string_equal(error.message, said);
    unsetenv("XDG_CONFIG_HOME");
    assert_false(load("/no/such.yaml", 0));
    assert_string_equal(error.message, "/no/such.yaml: no such file; name a scene file");
    assert_false(load(folder, 0));
    assert_non_null(strstr(error.message, ": a directory; name a scene file in it"));
    assert_false(load("", 0));
    assert_non_null(strstr(error.message, "the scene's name is empty"));
    assert_false(load("/dev/zero", 0));
    assert_string_equal(error.message, "/dev/zero: larger than 1 MiB; a scene file is a page of YAML");
    assert_false(load("/dev/null", 0));
    assert_non_null(strstr(error.message, "/dev/null:1:1: the scene is empty"));
}

static void an_unreadable_file_is_refused(void **state)
{
    (void)state;
    if (geteuid() == 0) {
        print_message("skipped: root may read every file\n");
        skip();
    }
    char path[SCRATCH_PATH];
    snprintf(path, sizeof path, "%s/locked.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fclose(file);
    chmod(path, 0);
    const bool loaded = load(path, 0);
    unlink(path);
    assert_false(loaded);
    assert_non_null(strstr(error.message, "cannot be opened (Permission denied)"));
}

int main(void)
{
    backends_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shipped_scene_loads),
        cmocka_unit_test(cameras_show_the_whole_box),
        cmocka_unit_test(particles_come_near_in_every_scene),
        cmocka_unit_test(scenes_are_found_beside_the_sources),
        cmocka_unit_test(a_file_here_goes_first),
        cmocka_unit_test(what_is_no_file_is_refused),
        cmocka_unit_test(an_unreadable_file_is_refused),
    };
    return cmocka_run_group_tests(tests, make_folder, NULL);
}
