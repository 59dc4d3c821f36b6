/* Keys of a scene that change while its simulation runs. */
#include "tests/scene/scene_text.h"

#include "render/views/pbsr/pbsr.h"
#include "render/views/splat/splat.h"
#include "render/views/volume/volume.h"

#include "app/scene/keys.h"
#include "app/scene/scene.h"
#include "slosh/state.h"

#define TWO_FLUIDS                                                                                           \
    "box: {size: [1, 1, 1]}\n"                                                                               \
    "particles: {spacing: 0.1}\n"                                                                            \
    "fluids:\n"                                                                                              \
    "  - fill: [{block: {min: [-0.5, 0, -0.5], max: [0, 0.5, 0.5]}}]\n"                                      \
    "  - fill: [{block: {min: [0, 0, -0.5], max: [0.5, 0.5, 0.5]}}]\n"                                       \
    "view: {range: [1, 2], camera: {from: [0, 1, 3], to: [0, 0, 0]}}\n"

static Scene scene;
static Error error;

static int setup(void **state)
{
    (void)state;
    return parse_text(TWO_FLUIDS, NULL, &scene, &error) ? 0 : -1;
}

static bool set(const char *setting)
{
    bool concerns_world = false;
    if (!scene_set_live(&scene, setting, &concerns_world, &error))
        fail_msg("%s", error.message);
    return concerns_world;
}

/* Refused with that message, and nothing has changed. */
static void refuse(const char *setting, const char *message)
{
    static Scene before;
    char expected[sizeof error.message];
    bool concerns_world = true;
    memcpy(&before, &scene, sizeof scene);
    snprintf(expected, sizeof expected, "--set %s: %s", setting, message);
    if (scene_set_live(&scene, setting, &concerns_world, &error))
        fail_msg("%s: accepted", setting);
    if (strncmp(error.message, expected, strlen(expected)) != 0)
        fail_msg("expected '%s'\n     got '%s'", expected, error.message);
    assert_memory_equal(&before, &scene, sizeof scene);
    assert_true(concerns_world);
}

static void each_type_reaches_its_field(void **state)
{
    (void)state;
    assert_true(set("gravity=[0, -3, 1.5]"));
    assert_true(scene.world.gravity[1] == -3 && scene.world.gravity[2] == 1.5);
    assert_true(set("fluids[1].viscosity=0.2"));
    assert_true(scene.world.fluids[0].viscosity == 0 && scene.world.fluids[1].viscosity == 0.2);
    assert_true(set("fluids[1].viscosity=[[0, 5], [2, 1]]"));
    assert_true(scene.world.fluids[1].viscosity_table.rows == 2 && scene.world.fluids[1].viscosity == 5);
    assert_true(set("fluids[1].viscosity=0.2") && scene.world.fluids[1].viscosity_table.rows == 0);
    assert_true(set("solver.step.substeps=7"));
    assert_int_equal(scene.world.substeps, 7);
    assert_true(set("solver.negative_pressure=true") && scene.world.negative_pressure);
    assert_true(set("hand.turn_speed=90") && scene.world.limits.turn_speed_deg == 90);
    assert_false(set("solver.step.realtime=false") || scene.realtime);
    assert_false(set("solver.acceleration=true") || set("solver.acceleration=false"));
    assert_true(scene.world.acceleration); /* once kept they stay */
    assert_false(set("title='two: words'"));
    assert_string_equal(scene.title, "two: words");
    assert_false(set("view.range=auto"));
    assert_true(scene.view.range_auto);
    assert_false(set("view.range=[-1, 5]"));
    assert_true(!scene.view.range_auto && scene.view.range[0] == -1 && scene.view.range[1] == 5);
    char same[64];
    snprintf(same, sizeof same, "view.color_by=%s", scalar_name(view_color_by(&scene.view)));
    assert_false(set(same));
    assert_false(scene.view.range_auto);
    assert_false(set("view.color_by=pressure"));
    assert_int_equal(scene.view.color_by, SCALAR_PRESSURE);
    assert_true(scene.view.range_auto); /* the range was the other one's */
    assert_false(set("view.splat.weights=w1") || set("view.splat.eps=0.25"));
    assert_true(splat_def(&scene.view)->weights == SPLAT_W1 && splat_def(&scene.view)->eps == 0.25);
    assert_false(set("view.splat.shape=ellipsoid") || set("view.splat.drops=false"));
    assert_true(splat_def(&scene.view)->shape == SPLAT_ELLIPSOID && !splat_def(&scene.view)->drops);
    assert_false(set("view.splat.level=0.15"));
    assert_true(splat_def(&scene.view)->level == 0.15);
    assert_false(set("view.splat.filter=narrow_range") || set("view.splat.filter_size=6"));
    assert_true(splat_def(&scene.view)->filter == SPLAT_NARROW_RANGE &&
                splat_def(&scene.view)->filter_size == 6);
    assert_true(!set("view.splat.antialias=false") && !splat_def(&scene.view)->antialias);
    assert_false(set("view.volume.method=planes") || set("view.volume.cells=96"));
    assert_true(volume_def(&scene.view)->method == VOLUME_PLANES && volume_def(&scene.view)->cells == 96);
    assert_false(set("view.camera.from=[1, 2, 3]"));
    assert_true(scene.view.camera.from[2] == 3 && !scene.view.camera_auto);
    assert_true(scene_set_live(&scene, "view.legend=false", NULL, &error) && !scene.view.legend);
}

static void a_fluids_colour_is_its_own(void **state)
{
    (void)state;
    const float other = scene.world.fluids[0].color[0];
    assert_false(set("fluids[1].color=[1, 0, 1]"));
    assert_true(scene.world.fluids[1].color[0] == 1 && scene.world.fluids[1].color[1] == 0);
    assert_true(scene.world.fluids[0].color[0] == other);
}

/* A path of the row, with the second element of each list. */
static void path_of(const Key *key, char path[128])
{
    char *to = path;
    for (const char *from = key->path; *from; from++) {
        *to++ = *from;
        if (*from == '[')
            *to++ = '1';
    }
    *to = 0;
}

/* What the table says of a key holds: its own value can be set, or it is refused. */
static void the_table_says_which(void **state)
{
    (void)state;
    int count, live = 0;
    const Key *keys = scene_keys(&count);
    pbsr_def(&scene.view)->layer_count = 2; /* a second element, as there is of fluids */
    for (int i = 0; i < count; i++) {
        char path[128], value[256], setting[512], refusal[256];
        path_of(&keys[i], path);
        if (keys[i].flags & KEY_LIVE) {
            const Key *list = key_list(&keys[i]);
            key_value_text(&keys[i], (char *)&scene + (list ? key_list_at(list, 1) : 0), value, sizeof value);
            snprintf(setting, sizeof setting, "%s=%s", path, *value ? value : "words");
            const bool drawn = strncmp(path, "view.", 5) == 0 || strcmp(path, "title") == 0 ||
                               strstr(path, ".color") || strcmp(path, "solver.step.realtime") == 0 ||
                               strcmp(path, "solver.acceleration") == 0 || strncmp(path, "touch.", 6) == 0;
            assert_int_equal(set(setting), !drawn);
            live++;
        } else if (!strchr(path, '[') || strncmp(path, "fluids", 6) == 0) {
            snprintf(setting, sizeof setting, "%s=1", path);
            snprintf(refusal, sizeof refusal, "%s cannot change while the simulation runs; ", path);
            if (!strstr(path, "fill[") && !strstr(path, "emit["))
                refuse(setting, refusal);
        }
    }
    assert_true(live > 20);
}

/* Whether the row's member is of the world, and the world's to change: another backend is another world. */
static bool is_of_world(const Key *key)
{
    const Key *list = key_list(key);
    const size_t at = key->offset + (list ? key_list_at(list, 0) : 0), world = offsetof(Scene, world);
    return at >= world && at < world + sizeof(WorldDef) && strcmp(key->path, "solver.backend") != 0;
}

/* What the table says may change is what world_change takes over, and has its place in the saved state. */
static void live_keys_of_the_world_are_saved(void **state)
{
    (void)state;
    static Scene other;
    double numbers[LIVE_NUMBERS];
    int count, seen = 0;
    const Key *keys = scene_keys(&count);
    set("solver.negative_pressure=true");
    set("fluids[0].viscosity=[[0, 5], [2, 1]]");
    other = (Scene){.world.fluid_count = 2};
    live_save(&scene.world, numbers);
    live_load(numbers, &other.world);
    for (int i = 0; i < count; i++) {
        const Key *list = key_list(&keys[i]);
        const size_t at = list ? key_list_at(list, 0) : 0;
        char value[256], loaded[256];
        if (!(keys[i].flags & KEY_LIVE) || keys[i].flags & KEY_IDLE)
            continue;
        assert_true(list || !strstr(keys[i].path, "[]")); /* no list within a list */
        if (!is_of_world(&keys[i]))
            continue;
        key_value_text(&keys[i], (char *)&scene + at, value, sizeof value);
        key_value_text(&keys[i], (char *)&other + at, loaded, sizeof loaded);
        assert_string_equal(loaded, value);
        seen++;
    }
    assert_int_equal(seen, 13);
    assert_int_equal(live_count(), LIVE_NUMBERS);
}

/* The words are those that the same setting gets at the start. */
static void messages_are_those_of_set(void **state)
{
    static const char *const settings[] = {
        "gravity=[0, -3]",
        "gravity=[0, -3, x]",
        "gravity=[0, 2000, 0]",
        "gravity=",
        "gravity=[0, .nan, 0]",
        "gravity=[0, 1",
        "fluids[1].viscosity=-1",
        "fluids[1].viscosity=[[1, 2], [0, 2]]",
        "fluids[1].viscosity=[]",
        "fluids[0].color=[2, 0, 0]",
        "view.kind=sphere",
        "view.color_by=presure",
        "view.range=[2, 1]",
        "view.range=[1, 1]",
        "view.legend=1",
        "view.splat.eps=0",
        "view.splat.weights=w2",
        "view.splat.level=1.5",
        "view.splat.filter=bilateral",
        "view.splat.filter_iterations=0",
        "view.volume.cells=3",
        "view.volume.method=cubes",
        "solver.step.dt=0",
        "solver.sound_speed=a",
        "view.radius=11",
        "title=",
        "title=*a",
        "nothing",
        "=3",
        "a..b=3",
        "solver.step.substeps=1.5",
        "hand.response=1e9",
        "fluids[0]viscosity=1",
    };
    (void)state;
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        static Scene other;
        Error wanted;
        char message[sizeof wanted.message + 8];
        if (parse_set(TWO_FLUIDS, settings[i], &other, &wanted))
            fail_msg("--set %s: accepted", settings[i]);
        snprintf(message, sizeof message, "--set %s: ", settings[i]);
        assert_memory_equal(wanted.message, message, strlen(message));
        refuse(settings[i], wanted.message + strlen(message));
    }
}

static void paths_must_name_one_key(void **state)
{
    (void)state;
    refuse("gravty=[0, 1, 0]", "unknown key 'gravty'; did you mean 'gravity'?");
    refuse("nonsense.key=1", "unknown key 'nonsense.key'; `slosh info SCENE` lists the keys");
    refuse("fluids[2].viscosity=1", "the scene has no fluids[2]; use at most fluids[1]");
    refuse("fluids[3].viscosity=1", "[3] is beyond the list's end");
    refuse("fluids[].viscosity=1", "'[]' is no index");
    refuse("gravity[1]=1", "[1] is beyond the list's end");
    refuse("gravity[0]=1", "unknown key 'gravity[0]'");
    refuse("view.camera={from: [0, 0, 1], to: [0, 0, 0]}", "view.camera cannot change");
}

static void values_must_fit_each_other(void **state)
{
    (void)state;
    refuse("view.camera.from=[0, 0, 0]", "the camera stands where it looks; move `from` or `to`");
    refuse("view.range=[3, 3]", "the range's low (3) is not below its high (3); swap or move them");
}

static void an_automatic_camera_has_no_keys(void **state)
{
    (void)state;
    scene.view.camera_auto = true;
    refuse("view.camera.fov=30", "the camera is automatic; ");
}

/* Which a hand has made smaller than what the fluids began with. */
static void in_a_smaller_box(void **state)
{
    (void)state;
    scene.world.box_size[0] = 0.9;
    assert_true(set("gravity=[0, -3, 1.5]"));
    assert_true(scene.world.gravity[1] == -3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_type_reaches_its_field, setup),
        cmocka_unit_test_setup(a_fluids_colour_is_its_own, setup),
        cmocka_unit_test_setup(the_table_says_which, setup),
        cmocka_unit_test_setup(live_keys_of_the_world_are_saved, setup),
        cmocka_unit_test_setup(messages_are_those_of_set, setup),
        cmocka_unit_test_setup(paths_must_name_one_key, setup),
        cmocka_unit_test_setup(values_must_fit_each_other, setup),
        cmocka_unit_test_setup(an_automatic_camera_has_no_keys, setup),
        cmocka_unit_test_setup(in_a_smaller_box, setup),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
