/* Scenes with long lists: read, simulated, saved and read again. */
#include "app/scene/scene.h"
#include "sim/world.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { FILLS = 200, MOTIONS = 50, PROBES = 40, KEYFRAMES = 30 };

static void parse(const char *text, Scene *out)
{
    Error error = {{0}};
    if (!scene_parse("many.yaml", text, strlen(text), NULL, out, NULL, &error))
        fail_msg("%s", error.message);
}

/* Discs in rows, in a box that rocks in many ways; the caller frees the text. */
static char *many(void)
{
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    fprintf(file, "box: {size: [4, 2]}\nparticles: {spacing: 0.05}\nfluids:\n  - fill:\n");
    for (int i = 0; i < FILLS; i++)
        fprintf(file, "      - ball: {centre: [%g, %g], radius: 0.04}\n", -1.9 + 0.2 * (i % 20),
                0.1 + 0.15 * (i / 20));
    fprintf(file, "motion:\n");
    for (int i = 0; i < MOTIONS; i++)
        fprintf(file, "  - shake: {axis: [1, 0, 0], amplitude: %g, frequency: 1}\n", 1e-4 * (i + 1));
    fprintf(file, "solids:\n  - sphere: {centre: [0, 1.8, 0], radius: 0.1}\n    motion:\n");
    for (int i = 0; i < MOTIONS; i++)
        fprintf(file, "      - rock: {axis: [0, 0, 1], angle: %d, frequency: 1}\n", i);
    fprintf(file, "probes:\n");
    for (int i = 0; i < PROBES; i++)
        fprintf(file, "  - {name: p%d, height: {at: [%g, 0, 0]}}\n", i, -1.9 + 0.09 * i);
    fprintf(file, "view:\n  camera_path:\n");
    for (int i = 0; i < KEYFRAMES; i++)
        fprintf(file, "    - {time: %d, from: [0, 1, 5], to: [%g, 1, 0]}\n", i, 0.01 * i);
    fclose(file);
    return text;
}

static char *saved(const Scene *scene, const char *text)
{
    const SceneSource source = {.scene = scene, .path = "many.yaml", .text = text, .size = strlen(text)};
    SceneSaved out;
    Error error = {{0}};
    char *again = scene_save_text(&source, "again.yaml", &out, &error);
    if (!again)
        fail_msg("%s", error.message);
    setting_list_free(&out.changed);
    return again;
}

/* A list has no place in a scene: a copy of a scene has the same lists, for as long as the program runs. */
static void what_is_long_is_kept(void **state)
{
    (void)state;
    static Scene scene, again;
    Error error = {{0}};
    char *text = many();
    parse(text, &scene);
    const FluidDef *fluid = &scene.world.fluids[0];
    assert_int_equal(fluid->fill_count, FILLS);
    assert_int_equal(scene.world.motion_count, MOTIONS);
    assert_int_equal(scene.world.solids[0].motion_count, MOTIONS);
    assert_true(fluid->fills[FILLS - 1].radius == 0.04 && fluid->fills[21].centre[1] == 0.25);
    assert_true(scene.world.motions[MOTIONS - 1].amplitude == 0.005);
    assert_int_equal(scene.probes.count, PROBES);
    assert_string_equal(scene.probes.probe[PROBES - 1].name, "p39");
    parse(text, &again);
    assert_ptr_equal(again.world.fluids[0].fills, fluid->fills); /* equal lists once */
    World *world = world_create(&scene.world, &error);
    if (!world || !world_step(world, NULL, &error))
        fail_msg("%s", error.message);
    WorldInfo info;
    world_info(world, &info);
    assert_true(info.count >= FILLS);
    world_destroy(world);
    free(text);
}

/* An unchanged scene is saved as its text; with a fill and a motion more it is read again as it was. */
static void what_is_long_is_saved(void **state)
{
    (void)state;
    static Scene scene, changed, again;
    char *text = many();
    parse(text, &scene);
    char *same = saved(&scene, text);
    parse(same, &again);
    char *twice = saved(&again, same);
    assert_string_equal(same, twice);
    changed = scene;
    Fill fills[FILLS + 1];
    Motion motions[MOTIONS + 1];
    memcpy(fills, scene.world.fluids[0].fills, FILLS * sizeof *fills);
    memcpy(motions, scene.world.motions, MOTIONS * sizeof *motions);
    fills[FILLS] = fills[0];
    fills[FILLS].centre[0] = 0.1234567890123;
    motions[MOTIONS] = motions[0];
    changed.world.fluids[0].fills = fills;
    changed.world.motions = motions;
    changed.world.fluids[0].fill_count = FILLS + 1;
    changed.world.motion_count = MOTIONS + 1;
    char *more = saved(&changed, text);
    parse(more, &again);
    assert_int_equal(again.world.motion_count, MOTIONS + 1);
    assert_int_equal(again.world.fluids[0].fill_count, FILLS + 1);
    assert_true(again.world.fluids[0].fills[FILLS].centre[0] == fills[FILLS].centre[0]);
    assert_int_equal(scene.world.fluids[0].fill_count, FILLS);
    free(text);
    free(same);
    free(twice);
    free(more);
}

/* The bound of a list is told with the place. */
static void too_long_is_told(void **state)
{
    (void)state;
    static Scene scene;
    Error error = {{0}};
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    fprintf(file, "box: {size: [1, 1]}\nparticles: {spacing: 0.1}\n"
                  "fluids: [{fill: [{block: {min: [-0.5, 0], max: [0, 0.5]}}]}]\nmotion: [");
    for (int i = 0; i <= MOTIONS_MAX; i++)
        fputs("{spin: {axis: [0, 0, 1], rate: 1}}, ", file);
    fputs("]\n", file);
    fclose(file);
    assert_false(scene_parse("many.yaml", text, size, NULL, &scene, NULL, &error));
    assert_string_equal(error.message, "many.yaml:4:9: motion has 1001 entries; it must have 0 to 1000");
    free(text);
}

/* A def has one owner of each list: nothing of the scene that a world or a copy shares can be changed. */
static void lists_are_short_in_a_scene(void **state)
{
    (void)state;
    assert_true(sizeof(Scene) < 36 * 1024);
    assert_true(sizeof(WorldDef) < 16 * 1024);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_long_is_kept),
        cmocka_unit_test(what_is_long_is_saved),
        cmocka_unit_test(too_long_is_told),
        cmocka_unit_test(lists_are_short_in_a_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
