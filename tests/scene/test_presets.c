/* --preset: settings that a preset changes in a scene, the chosen fluid, and the messages. */
#include "app/scene/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char TEXT[] = "box: {size: [0.4, 0.3, 0.4]}\n"
                           "particles: {spacing: 0.02, support: 2.6}\n"
                           "fluids:\n"
                           "  - {name: light, fill: [{block: {min: [-0.2, 0, -0.2], max: [0, 0.1, 0.2]}}]}\n"
                           "  - {name: oil, fill: [{block: {min: [0, 0, -0.2], max: [0.2, 0.1, 0.2]}}]}\n"
                           "solver: {method: mueller, sound_speed: 11, step: {dt: 0.001, substeps: 3}}\n";

static Scene scene;
static Notes notes;
static Error error;

static bool parse(const char *first, const char *second)
{
    SceneSettings settings = {.count = second ? 2 : 1, .set = {first, second}};
    *error.message = 0;
    return scene_parse("a.yaml", TEXT, strlen(TEXT), &settings, &scene, &notes, &error);
}

static void test_fluids(void **state)
{
    (void)state;
    assert_true(parse("preset=honey", NULL));
    assert_true(scene.world.fluids[0].density == 1420 && scene.world.fluids[0].viscosity == 10);
    assert_string_equal(scene.world.fluids[0].name, "honey");
    assert_true(scene.world.fluids[1].density == 1000);
    assert_non_null(strstr(notes.line[0], "fluids[0], light: density 1420, viscosity 10"));
    assert_non_null(strstr(notes.line[0], "1 other stays: --preset honey:FLUID"));
    assert_true(parse("preset=lava:oil", NULL) && scene.world.fluids[1].density == 2700);
    assert_true(parse("preset=lava:1", NULL) && scene.world.fluids[1].density == 2700);
    assert_true(parse("preset=oil:light", NULL)); /* the second fluid has the name */
    assert_string_equal(scene.world.fluids[0].name, "light");
    assert_true(parse("fluids[0].density=1500", "preset=honey") && scene.world.fluids[0].density == 1500);
    assert_true(parse("preset=honey", "preset=lava:1") && scene.world.fluids[0].density == 1420 &&
                scene.world.fluids[1].density == 2700);
}

static void test_questions(void **state)
{
    (void)state;
    assert_true(parse("preset=accurate", NULL));
    assert_string_equal(scene.world.method, "wcsph");
    assert_string_equal(scene.preset, "accurate");
    assert_true(scene.world.support == 3.5 || scene.world.support == 2.6);
    assert_true(scene.world.step_mode == STEP_CFL && scene.world.sound_speed != 11);
    assert_true(parse("preset=fast", NULL));
    assert_true(scene.world.substeps == 1 && scene.world.dt > 0.016);
    assert_true(parse("preset=fast", "solver.step.dt=0.01") && scene.world.dt == 0.01);
}

static void test_wrong(void **state)
{
    (void)state;
    static const char *const rows[][2] = {
        {"preset=hony", "did you mean 'honey'"}, {"preset=", "there is no such preset; use water, oil"},
        {"preset=honey:", "no such fluid"},      {"preset=honey:2", "no such fluid"},
        {"preset=honey:-1", "no such fluid"},    {"preset=fast:0", "leave :0 out"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_false(parse(rows[i][0], NULL));
        if (!strstr(error.message, rows[i][1]))
            fail_msg("%s: %s", rows[i][0], error.message);
    }
}

/* Each row's keys are there, and its source is named. */
static void test_rows(void **state)
{
    (void)state;
    for (const Preset *preset = preset_list; preset->name; preset++) {
        char setting[64];
        snprintf(setting, sizeof setting, "preset=%s", preset->name);
        assert_true(*preset->help && *preset->source);
        if (!parse(setting, NULL))
            fail_msg("%s", error.message);
        for (int i = 0; preset->drops[i]; i++)
            assert_non_null(scene_key_find(preset->drops[i]));
        assert_true(preset_sets(preset->name,
                                preset->kind == PRESET_FLUID ? "fluids[0].density=1" : "solver.step.dt=1"));
        assert_false(preset_sets(preset->name, "fluids[1].density=1"));
        assert_false(preset_sets(preset->name, "gravity=1"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fluids), cmocka_unit_test(test_questions),
                                       cmocka_unit_test(test_wrong), cmocka_unit_test(test_rows)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
