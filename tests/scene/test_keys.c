/* The table of keys: every row's range holds on both sides, and all products of the table agree. */
#include "tests/scene/scene_text.h"

#include "app/base/program.h"
#include "app/scene/scene.h"
#include "render/views/pbsr/pbsr.h"
#include "sim/gpu/gl.h"
#include "sim/step/method.h"

#include <math.h>
#include <stdlib.h>

#define MESH SLOSH_SOURCE_DIR "/scenes/meshes/rabbit.obj"

/* Every mapping, variant and list of the table, so that --set can reach every key. */
static const char everything[] =
    "box: {size: [1, 1, 1]}\n"
    "particles: {spacing: 0.1}\n"
    "fluids:\n"
    "  - fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.5, 0.5]}}]\n"
    "  - fill: [{ball: {centre: [0, 0.8, 0], radius: 0.2}}]\n"
    "  - viscosity: [[0, 50], [2.5, 40], [6, 0.1]]\n"
    "    fill: [{cylinder: {centre: [0.3, 0.7, 0], radius: 0.1, height: 0.3}}]\n"
    "  - emit:\n"
    "      - disk: {centre: [0, 0.5, 0], direction: [0, 1, 0], radius: 0.1}\n"
    "        speed: 1\n"
    "  - fill: [{mesh: {file: " MESH ", centre: [-0.2, 0.74, 0.3], scale: 0.5}}]\n"
    "motion:\n"
    "  - shake: {axis: [1, 0, 0], amplitude: 0.1, frequency: 1}\n"
    "  - rock: {axis: [1, 0, 0], angle: 1, frequency: 1}\n"
    "  - turn: {axis: [1, 0, 0], angle: 1, duration: 1}\n"
    "  - spin: {axis: [1, 0, 0], rate: 1}\n"
    "  - accelerate: {axis: [1, 0, 0], acceleration: 1}\n"
    "  - path: {axis: [1, 0, 0], way: 1}\n"
    "  - tilt: {axis: [1, 0, 0], angle: [[0, 0], [1, 20]]}\n"
    "drains:\n"
    "  - block: {min: [0, 0, 0], max: [0.1, 0.1, 0.1]}\n"
    "  - ball: {centre: [0, 0, 0], radius: 0.1}\n"
    "solids:\n"
    "  - sphere: {centre: [0.4, 0.9, 0.4], radius: 0.1}\n"
    "    motion:\n"
    "      - shake: {axis: [1, 0, 0], amplitude: 0.1, frequency: 1}\n"
    "      - rock: {axis: [1, 0, 0], angle: 1, frequency: 1}\n"
    "      - turn: {axis: [1, 0, 0], angle: 1, duration: 1}\n"
    "      - spin: {axis: [1, 0, 0], rate: 1}\n"
    "      - accelerate: {axis: [1, 0, 0], acceleration: 1}\n"
    "      - path: {axis: [1, 0, 0], way: [[0, 0], [1, 0.5]]}\n"
    "      - tilt: {axis: [1, 0, 0], angle: 1}\n"
    "  - box: {centre: [0.4, 0.9, 0.4], size: [0.2, 0.2, 0.2]}\n"
    "  - cylinder: {centre: [0.4, 0.9, 0.4], radius: 0.1, height: 0.2}\n"
    "  - bowl: {centre: [0.4, 0.9, 0.4], radius: 0.1}\n"
    "  - mesh: {file: " MESH ", centre: [0.4, 0.9, 0.4], scale: 0.4}\n"
    "probes:\n"
    "  - {name: a, point: {at: [0, 0, 0]}}\n"
    "  - {name: b, height: {at: [0, 0, 0]}}\n"
    "  - {name: c, line: {from: [0, 0, 0], to: [0, 1, 0]}}\n"
    "  - {name: d, plane: {at: [0, 1, 0], along: [1, 0, 0], across: [0, 0, 1]}}\n"
    "view:\n"
    "  camera: {from: [3, 3, 3], to: [0, 0, 0]}\n"
    "  camera_path: [{time: 1, from: [3, 3, 3], to: [0, 0, 0]}]\n"
    "  pbsr:\n"
    "    layers:\n"
    "      - motion:\n"
    "          - shake: {axis: [1, 0, 0], amplitude: 0.1, frequency: 1}\n"
    "          - rock: {axis: [1, 0, 0], angle: 1, frequency: 1}\n"
    "          - turn: {axis: [1, 0, 0], angle: 1, duration: 1}\n"
    "          - spin: {axis: [1, 0, 0], rate: 1}\n"
    "          - accelerate: {axis: [1, 0, 0], acceleration: 1}\n"
    "          - path: {axis: [1, 0, 0], way: 1}\n"
    "          - tilt: {axis: [1, 0, 0], angle: 1}\n";

static void replace(char *path, const char *pattern, const char *with)
{
    char *at = strstr(path, pattern);
    if (!at)
        return;
    memmove(at + strlen(with), at + strlen(pattern), strlen(at + strlen(pattern)) + 1);
    for (; *with; with++)
        *at++ = *with;
}

/* "fluids[].fill[].ball.radius" -> "fluids[1].fill[0].ball.radius" in the scene above. */
static void path_in_scene(const char *row, char path[128])
{
    snprintf(path, 128, "%s", row);
    replace(path, "fluids[].fill[].ball", "fluids[1].fill[0].ball");
    replace(path, "fluids[].fill[].cylinder", "fluids[2].fill[0].cylinder");
    replace(path, "fluids[].fill[].mesh", "fluids[4].fill[0].mesh");
    replace(path, "fluids[].fill[]", "fluids[0].fill[0]");
    replace(path, "fluids[].emit[]", "fluids[3].emit[0]");
    replace(path, "drains[].block", "drains[0].block");
    replace(path, "drains[].ball", "drains[1].ball");
    replace(path, "fluids[]", "fluids[0]");
    for (int kind = 0; kind < SOLID_KIND_COUNT; kind++) {
        char pattern[32], with[32];
        snprintf(pattern, sizeof pattern, "solids[].%s.", solid_name((SolidKind)kind));
        snprintf(with, sizeof with, "solids[%d].%s.", kind, solid_name((SolidKind)kind));
        replace(path, pattern, with);
    }
    replace(path, "solids[].", "solids[0].");
    replace(path, "probes[].height", "probes[1].height");
    replace(path, "probes[].line", "probes[2].line");
    replace(path, "probes[].plane", "probes[3].plane");
    replace(path, "probes[].", "probes[0].");
    replace(path, "layers[].", "layers[0].");
    replace(path, "camera_path[].", "camera_path[0].");
    for (int kind = 0; kind < MOTION_KIND_COUNT; kind++) {
        char pattern[32], with[32];
        snprintf(pattern, sizeof pattern, "motion[].%s.", motion_name((MotionKind)kind));
        snprintf(with, sizeof with, "motion[%d].%s.", kind, motion_name((MotionKind)kind));
        replace(path, pattern, with);
    }
}

static int components(const Key *key)
{
    return key->type == KEY_VEC3 || key->type == KEY_COLOR ? 3 : key->type == KEY_RANGE ? 2 : 1;
}

static bool is_bounded_number(const Key *key)
{
    return key->type == KEY_NUMBER || key->type == KEY_CURVE || key->type == KEY_INTEGER ||
           key->type == KEY_VEC3 || key->type == KEY_COLOR || key->type == KEY_RANGE;
}

/* Whether the loader finds `value`, as the component `k` of the key, out of its range. */
static bool out_of_range(const Key *key, int k, double value)
{
    char path[128], setting[512], phrase[1024];
    path_in_scene(key->path, path);
    int used = snprintf(setting, sizeof setting, "%s=%s", path, components(key) > 1 ? "[" : "");
    for (int i = 0; i < components(key); i++)
        used += snprintf(setting + used, sizeof setting - (size_t)used, "%s%.17g", i ? ", " : "",
                         i == k ? value : key->max);
    if (components(key) > 1)
        snprintf(setting + used, sizeof setting - (size_t)used, "]");

    static Scene scene;
    Error error;
    snprintf(phrase, sizeof phrase, "--set %s: %s must be ", setting, path);
    return !parse_set(everything, setting, &scene, &error) &&
           strncmp(error.message, phrase, strlen(phrase)) == 0;
}

static void check_bounds(const Key *key, int k)
{
    const bool whole = key->type == KEY_INTEGER, open = key->flags & KEY_OPEN_LOW;
    const double below = whole ? key->min - 1 : nextafter(key->min, -INFINITY);
    const double above = whole ? key->max + 1 : nextafter(key->max, INFINITY);
    if (!out_of_range(key, k, below) || !out_of_range(key, k, above))
        fail_msg("%s takes a value just outside %g to %g", key->path, key->min, key->max);
    if (out_of_range(key, k, key->min) != open || out_of_range(key, k, key->max))
        fail_msg("%s: the ends of %g to %g are not as the table says", key->path, key->min, key->max);
    if (open && out_of_range(key, k, nextafter(key->min, INFINITY)))
        fail_msg("%s refuses what is just above %g", key->path, key->min);
}

static void every_range_holds_on_both_sides(void **state)
{
    (void)state;
    int count, bounded = 0;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        if (!is_bounded_number(&keys[i]))
            continue;
        assert_true(keys[i].min < keys[i].max);
        bounded++;
        for (int k = 0; k < components(&keys[i]); k++)
            check_bounds(&keys[i], k);
    }
    assert_true(bounded > 30);
}

static void every_list_has_its_bounds(void **state)
{
    (void)state;
    char text[4096] = "box: {size: [1, 1, 1]}\nparticles: {spacing: 0.1}\nfluids:\n";
    static Scene scene;
    Error error;
    for (int f = 0; f <= FLUIDS_MAX; f++) {
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used,
                 "  - fill: [{block: {min: [-0.5, %g, -0.5], max: [0.5, %g, 0.5]}}]\n", 0.1 * f,
                 0.1 * (f + 1));
        const bool fits = f < FLUIDS_MAX;
        if (parse_text(text, NULL, &scene, &error) != fits)
            fail_msg("%d fluids: %s", f + 1, error.message);
    }
    assert_non_null(strstr(error.message, "fluids has 9 entries; it must have 1 to 8"));
}

/* By a scene of either method, of the backend with a scalar of its own, or by a recorded run. */
static bool is_taken(const char *setting, Scene *scene, Error *error)
{
    for (int i = 0; method_list()[i]; i++) {
        char method[64];
        snprintf(method, sizeof method, "solver.method=%s", method_list()[i]->name);
        SceneSettings settings = {.count = 3, .set = {method, "solver.viscosity=implicit", setting}};
        if (parse_text(everything, &settings, scene, error))
            return true;
    }
    SceneSettings settings = {.count = 2, .set = {"solver.backend=fragment", setting}},
                  recorded = {.count = 1, .set = {setting}, .recorded = true};
    return parse_text(everything, &settings, scene, error) || parse_text(everything, &recorded, scene, error);
}

static void every_name_of_a_choice_is_taken(void **state)
{
    (void)state;
    int count, choices = 0;
    const Key *keys = scene_keys(&count);
    static Scene scene;
    Error error;
    for (int i = 0; i < count; i++)
        for (int c = 0; key_choice(&keys[i], c); c++) {
            const bool list = keys[i].type == KEY_NAMES;
            char path[128], setting[256], text[128], name[64];
            path_in_scene(keys[i].path, path);
            snprintf(name, sizeof name, list ? "[%s]" : "%s", key_choice(&keys[i], c));
            snprintf(setting, sizeof setting, "%s=%s", path, name);
            if (!parse_set(everything, setting, &scene, &error) && !is_taken(setting, &scene, &error))
                fail_msg("%s", error.message);
            void *const owner = strncmp(path, "solids", 6) == 0   ? (void *)&scene.world.solids[0]
                                : strncmp(path, "fluids", 6) == 0 ? (void *)&scene.world.fluids[0]
                                : strncmp(path, "probes", 6) == 0 ? (void *)&scene.probes.probe[0]
                                : strstr(path, "layers[0]")       ? (void *)&pbsr_def(&scene.view)->layers[0]
                                                                  : &scene;
            key_value_text(&keys[i], owner, text, sizeof text);
            assert_string_equal(text, name);
            choices++;
        }
    assert_true(choices > 10);
}

static void every_row_is_whole(void **state)
{
    (void)state;
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        assert_true(*keys[i].help && keys[i].unit);
        assert_ptr_equal(scene_key_find(keys[i].path), &keys[i]); /* no path stands there twice */
    }
    assert_string_equal(scene_key_find("fluids[0].fill[12].ball.radius")->path,
                        "fluids[].fill[].ball.radius");
    assert_null(scene_key_find("fluids[0].radius"));
    assert_null(scene_key_find("fluids"
                               "[0]"));
}

/* The settings of a scene, printed and set again on a bare one, give the same print. */
static void what_is_printed_can_be_set(void **state)
{
    (void)state;
    static Scene scene;
    Error error;
    char *first = NULL, *line = NULL;
    size_t size = 0, room = 0;
    assert_true(parse_text(everything, NULL, &scene, &error));
    FILE *file = open_memstream(&first, &size);
    scene_print(&scene, file);
    fclose(file);
    assert_non_null(strstr(first, "particles.spacing = 0.1 m\n"));
    assert_non_null(strstr(first, "motion[3].spin.rate = 1 rad/s\n"));
    assert_non_null(strstr(first, "fluids[1].fill[0].ball.centre = [0, 0.8, 0] m\n"));
    assert_non_null(strstr(first, "fluids[2].viscosity = [[0, 50], [2.5, 40], [6, 0.1]] Pa s\n"));
    assert_null(strstr(first, "fluids[1].fill[0].block"));

    file = fmemopen(first, size, "r");
    int lines = 0;
    while (getline(&line, &room, file) > 0) {
        char *equals = strstr(line, " = "), setting[256];
        assert_non_null(equals);
        *equals = 0;
        const Key *key = scene_key_find(line);
        assert_non_null(key);
        char *value = equals + 3;
        value[strcspn(value, "\n")] = 0;
        if (*key->unit)
            value[strlen(value) - strlen(key->unit) - 1] = 0;
        snprintf(setting, sizeof setting, "%s=%s", line, value);
        if (!parse_set(everything, setting, &scene, &error))
            fail_msg("%s", error.message);
        lines++;
    }
    fclose(file);
    assert_true(lines > 50);
    free(line);
    free(first);
}

static void nearest_names(void **state)
{
    (void)state;
    assert_int_equal(edit_distance("viscocity", "viscosity"), 1);
    assert_int_equal(edit_distance("tmie", "time"), 1); /* a swap is one slip */
    assert_int_equal(edit_distance("", "abc"), 3);
    Suggestion near = suggest_for("sped");
    suggest_offer(&near, "density");
    assert_null(near.best);
    suggest_offer(&near, "speed");
    suggest_offer(&near, "spend");
    assert_string_equal(near.best, "speed");
}

int main(void)
{
    backends_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_range_holds_on_both_sides), cmocka_unit_test(every_list_has_its_bounds),
        cmocka_unit_test(every_name_of_a_choice_is_taken), cmocka_unit_test(every_row_is_whole),
        cmocka_unit_test(what_is_printed_can_be_set),      cmocka_unit_test(nearest_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
