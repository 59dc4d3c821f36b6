/* Keys changed during a simulation. */
#include "tests/scene/scene_text.h"

#include "render/views/pbsr/pbsr.h"
#include "render/views/splat/splat.h"
#include "render/views/volume/volume.h"

#include "app/scene/scene.h"
#include "sim/base/base.h"
#include "sim/state.h"

#include <math.h>

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

/* Refused with the message, without a change. */
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
    assert_true(scene.world.acceleration); /* once kept, always kept */
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
    assert_true(scene.view.range_auto); /* the range was of the previous scalar */
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

/* The table's claims hold: each key's own value can be set, or is refused. */
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

/* True if the row's member belongs to the world and can change in place: a new backend is a new world. */
static bool is_of_world(const Key *key)
{
    const Key *list = key_list(key);
    const size_t at = key->offset + (list ? key_list_at(list, 0) : 0), world = offsetof(Scene, world);
    return at >= world && at < world + sizeof(WorldDef) && strcmp(key->path, "solver.backend") != 0;
}

/* Keys marked as live are taken over by world_change, and are in the saved state. */
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
        char value[256], loaded[256];
        if (!(keys[i].flags & KEY_LIVE) || keys[i].flags & KEY_IDLE)
            continue;
        const size_t at = list ? key_list_at(list, 0) : 0;
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

/* The words equal the words for the same setting at the start. */
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
        "view.splat.weights=w3",
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

/* Smaller, by hand, than at the start of the fluids. */
static void in_a_smaller_box(void **state)
{
    (void)state;
    scene.world.box_size[0] = 0.9;
    assert_true(set("gravity=[0, -3, 1.5]"));
    assert_true(scene.world.gravity[1] == -3);
}

enum { VALUES_MAX = 24 };

/* Values of a key, good and bad: within its bounds, at them, beyond them, not finite. */
static int numbers_of(const Key *key, double numbers[VALUES_MAX])
{
    const bool bounded = key->max > key->min;
    const double least = bounded ? key->min : -1, most = bounded ? key->max : 1;
    const double all[] = {least,
                          most,
                          0.5 * (least + most),
                          nextafter(least, -INFINITY),
                          nextafter(most, INFINITY),
                          0,
                          -1,
                          0.1,
                          1.0 / 3,
                          1e9,
                          NAN,
                          INFINITY};
    memcpy(numbers, all, sizeof all);
    return sizeof all / sizeof *all;
}

/* The next value of the key, of several; false after the last. `now`: the scene has it. */
static bool value_of(const Key *key, const Scene *now, int index, SettingValue *value)
{
    double numbers[VALUES_MAX];
    const int count = numbers_of(key, numbers);
    const double number = numbers[index % count], other = numbers[(index * 5 + 1) % count];
    const char *name = key->type == KEY_CHOICE ? key_choice(key, index) : NULL;
    *value = (SettingValue){.key = key, .element = strstr(key->path, "[]") ? 1 : 0};
    switch (key->type) {
    case KEY_NUMBER:
    case KEY_CURVE:
        value->number[0] = number;
        return index < count;
    case KEY_INTEGER:
        value->whole = isfinite(number) && fabs(number) < 2e9 ? (int)number : -7;
        return index < count;
    case KEY_BOOLEAN:
        value->on = index;
        return index < 2;
    case KEY_CHOICE:
        if (key->flags & KEY_INDEX)
            value->whole = index;
        else if (name)
            snprintf(value->name, sizeof value->name, "%s", name);
        return name != NULL;
    case KEY_VEC3:
        value->number[index % 3] = number;
        value->number[(index + 1) % 3] = other;
        return index < 3 * count;
    case KEY_COLOR:
        for (int k = 0; k < 3; k++)
            if (key->flags & KEY_SINGLE)
                value->single[k] = (float)srgb_to_linear((index + 3 * k) % 11 / 10.0);
            else
                value->number[k] = srgb_to_linear((index + 3 * k) % 11 / 10.0);
        return index < 11;
    case KEY_RANGE:
        memcpy(value->range.ends, (const char *)now + key->offset, sizeof value->range.ends);
        value->range.automatic[0] = index < 2;
        value->range.automatic[1] = index == 1;
        for (int k = 0; k < 2 && index >= 2; k++)
            value->range.ends[k] = k == index % 2 ? number : other;
        return index < 2 * count;
    case KEY_POINTS:
        value->points = (ControlPoints){.count = index % 3 + 1, .x = {0, 0.5, index < 6 ? 1 : 0.25}};
        for (int k = 0; k < 3; k++)
            value->points.y[k] = index % 2 ? number : 0.25 * k;
        return index < 2 * count;
    default:
        return false;
    }
}

static bool same_bytes(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

/* A value does what its text does: the same scene, bit by bit, or the same words; and it can be set back. */
static void a_value_is_as_its_text(void **state)
{
    (void)state;
    static Scene by_text, by_value;
    int count, taken = 0, refused = 0, seen = 0;
    const Key *keys = scene_keys(&count);
    pbsr_def(&scene.view)->layer_count = 2;
    for (int i = 0; i < count; i++) {
        SettingValue value;
        for (int k = 0; keys[i].flags & KEY_LIVE && value_of(&keys[i], &scene, k, &value); k++) {
            char text[SETTING_TEXT_SIZE];
            Error words = {{0}}, other = {{0}};
            SettingBefore before;
            bool world = false, also = false;
            memcpy(&by_text, &scene, sizeof scene);
            memcpy(&by_value, &scene, sizeof scene);
            setting_value_text(&value, text);
            const bool ok = scene_set_live(&by_text, text, &world, &words);
            if (scene_set_value(&by_value, &value, &before, &also, &other) != ok ||
                (!ok && strcmp(words.message, other.message) != 0) || world != also)
                fail_msg("%s: text %d '%s', value '%s'", text, ok, words.message, other.message);
            if (!same_bytes(&by_text, &by_value, sizeof scene))
                fail_msg("%s: not the same scene", text);
            *(ok ? &taken : &refused) += 1;
            if (ok)
                scene_set_back(&by_value, &value, &before);
            if (!same_bytes(&scene, &by_value, sizeof scene))
                fail_msg("%s: not as before", text);
            seen += k == 0;
        }
    }
    assert_true(seen > 120 && taken > 400 && refused > 400);
}

static void values_of_a_plane_and_of_a_set_camera(void **state)
{
    static const char plane[] = "box: {size: [1, 1]}\nparticles: {spacing: 0.1}\n"
                                "fluids:\n  - fill: [{block: {min: [-0.5, 0], max: [0, 0.5]}}]\n"
                                "  - fill: [{block: {min: [0, 0], max: [0.5, 0.5]}}]\n";
    assert_true(parse_text(plane, NULL, &scene, &error));
    a_value_is_as_its_text(state);
    assert_int_equal(setup(state), 0);
    scene.world.box_size[0] = 0.9; /* by hand: the fluids' fills are outside */
    a_value_is_as_its_text(state);
    scene.world.acceleration = true;
    snprintf(scene.view.kind, sizeof scene.view.kind, "spheres");
    a_value_is_as_its_text(state);
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
        cmocka_unit_test_setup(a_value_is_as_its_text, setup),
        cmocka_unit_test_setup(values_of_a_plane_and_of_a_set_camera, setup),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
