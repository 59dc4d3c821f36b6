/* In what two scenes differ: settings by which the one becomes the other, to the same bits. */
#include "app/scene/scene.h"
#include "sim/flow/flow.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

static const char TEXT[] = "box: {size: [0.4, 0.3, 0.4]}\n"
                           "particles: {spacing: 0.02}\n"
                           "fluids: [{fill: [{block: {min: [-0.2, 0, -0.2], max: [0, 0.1, 0.2]}}]}]\n"
                           "solids: [{sphere: {centre: [0.1, 0.1, 0], radius: 0.05}}]\n"
                           "views: [{kind: splat}, {kind: slice}]\n";

static void parse(const char *text, SceneSettings *settings, Scene *out)
{
    Error error = {{0}};
    if (!scene_parse("a.yaml", text, strlen(text), settings, out, NULL, &error))
        fail_msg("%s", error.message);
}

static Scene *scenes(int count)
{
    Scene *scene = calloc((size_t)count, sizeof *scene);
    assert_non_null(scene);
    return scene;
}

/* A set difference is found again, and gives the same scene. */
static void test_there_and_back(void **state)
{
    (void)state;
    Scene *scene = scenes(3);
    SceneSettings set = {.count = 0}, found;
    Error error = {{0}};
    SceneDifference differ, rest;
    static const char *const settings[] = {"title=\"one: two\"",
                                           "fluids[0].viscosity=0.1",
                                           "fluids[0].color=[0.2, 0.4, 0.6]",
                                           "gravity=[0, -3.3, 0.1]",
                                           "solver.step.dt=0.0033333333333333335",
                                           "probes=[{name: all, force: {}}]",
                                           "view.camera.from=[0.1, 0.2, 0.3]",
                                           "view.camera.to=[0, 0.1234567890123, 0]",
                                           "views[0].range=[0, 2]",
                                           "views[2].kind=spheres"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++)
        set.set[set.count++] = settings[i];
    parse(TEXT, NULL, &scene[0]);
    parse(TEXT, &set, &scene[1]);
    scene_difference(&scene[0], &scene[1], &differ);
    assert_true(differ.world);
    assert_true(setting_list_settings(&differ.settings, &found, &error));
    assert_true(found.count >= set.count);
    parse(TEXT, &found, &scene[2]);
    scene_difference(&scene[1], &scene[2], &rest);
    assert_int_equal(rest.settings.count, 0);
    assert_memory_equal(&scene[1].world, &scene[2].world, sizeof scene[1].world);
    setting_list_free(&differ.settings);
    setting_list_free(&rest.settings);
    free(scene);
}

static void differ_by(const char *setting, SceneDifference *differ)
{
    Scene *scene = scenes(2);
    SceneSettings set = {.count = 1, .set = {setting}};
    parse(TEXT, NULL, &scene[0]);
    parse(TEXT, &set, &scene[1]);
    scene_difference(&scene[0], &scene[1], differ);
    free(scene);
}

static void test_kinds(void **state)
{
    (void)state;
    static const struct {
        const char *setting, *whole;
        bool world, dead;
    } rows[] = {
        {"gravity=[0, -1, 0]", "", true, false},
        {"view.kind=splat", "", false, false},
        {"particles.spacing=0.025", "", true, true},
        {"solver.threads=2", "", false, true},
        {"metrics=[front]", "", false, false},
        {"solids=[]", "", true, true},
        {"solids[0].slip=none", "", true, true},
        {"views=[]", "", false, false},
        {"solids[1].sphere={centre: [0, 0.1, 0], radius: 0.02}",
         "solids=[{sphere: {centre: [0.1, 0.1, 0], radius: 0.05}}, {sphere: {centre: [0, 0.1, 0], radius: 0.02}}]",
         true, true},
        {"solids[0]={box: {centre: [0, 0.1, 0], size: [0.1, 0.1, 0.1]}, density: 500}",
         "solids=[{box: {centre: [0, 0.1, 0], size: [0.1, 0.1, 0.1]}, density: 500}]", true, true},
        {"view.camera_path[0]={time: 1, from: [0, 1, 1], to: [0, 0, 0]}",
         "view.camera_path=[{time: 1, from: [0, 1, 1], to: [0, 0, 0]}]", false, false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        SceneDifference differ;
        differ_by(rows[i].setting, &differ);
        if (*rows[i].whole) /* of a key of the view each of `views` says it too */
            assert_string_equal(differ.settings.set[0], rows[i].whole);
        if (differ.world != rows[i].world || differ.dead != rows[i].dead)
            fail_msg("%s: world %d, dead %d", rows[i].setting, differ.world, differ.dead);
        setting_list_free(&differ.settings);
    }
}

/* A solid moved and turned by hand follows the same path as a solid of the scene; for a ball and solids
   of revolution the path and the axis count. */
static void test_settle(void **state)
{
    (void)state;
    static const Motion motions[] = {
        {.kind = MOTION_ROCK, .axis = {1, 2, 0}, .angle_deg = 40, .frequency = 1},
        {.kind = MOTION_SHAKE, .axis = {0, 1, 1}, .amplitude = 0.1, .frequency = 2},
        {.kind = MOTION_SPIN, .axis = {0, 0, 1}, .rate = 3}};
    static const double at[3] = {0.1, -0.2, 0.3}, turn[4] = {0.1, 0.7, -0.3, 0.2}, up[3] = {0, 1, 0};
    static const Emit emits[2];
    static const Fill drain;
    WorldDef def = {.solid_count = SOLID_KIND_COUNT, .fluid_count = 1, .drain_count = 1, .drains = &drain};
    Error error;
    def.fluids[0].emit_count = 2;
    def.fluids[0].emits = emits;
    for (int k = 0; k < SOLID_KIND_COUNT; k++) {
        def.solids[k] =
            (SolidDef){.kind = k, .centre = {0.4, 0.5, 0.6}, .axis = {1, 0.5, -2}, .angle_deg = 70};
        def.solids[k].motion_count = 3;
        def.solids[k].motions = motions;
        assert_true(solid_hand_move(&def.solids[k].hand, at, turn, -100, 10, 10, 3));
    }
    WorldDef after = def;
    assert_true(world_def_apply_moves(&after, 1ULL << gate_of_emitter(0, 1), &error));
    assert_ptr_equal(def.fluids[0].emits, emits); /* a list is replaced, not changed */
    assert_true(flow_closed_gates(&after) == 1ULL << gate_of_emitter(0, 1));
    for (int k = 0; k < SOLID_KIND_COUNT; k++)
        for (int t = 0; t < 4; t++) {
            const bool round = k == SOLID_CYLINDER || k == SOLID_BOWL;
            BoxState was, is;
            double a[3], b[3];
            assert_false(after.solids[k].hand.moved);
            solid_pose(&def.solids[k], 0.3 * t, &was);
            solid_pose(&after.solids[k], 0.3 * t, &is);
            quat_rotate(was.orientation, round ? up : at, a);
            quat_rotate(is.orientation, round ? up : at, b);
            for (int i = 0; i < 3; i++)
                if (!(fabs(was.position[i] - is.position[i]) < 1e-9) ||
                    !(fabs(was.velocity[i] - is.velocity[i]) < 1e-9) ||
                    (k != SOLID_SPHERE && !(fabs(a[i] - b[i]) < 1e-9)))
                    fail_msg("%s at %g s: %g m off along %d, turned by %g", solid_name(k), 0.3 * t,
                             is.position[i] - was.position[i], i, b[i] - a[i]);
        }
}

/* Settings of an element go into the file's list of further elements; settings of a second list stay. */
static void test_within(void **state)
{
    (void)state;
    SettingList mine = {.count = 0}, file = {.count = 0};
    static const char *const settings[] = {"solids[0].box.centre=[0, 1, 0]", "solids_like[0].a=1",
                                           "drains[0].shut=true", "gravity=[0, 0, 0]"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++)
        setting_list_add(&mine, settings[i]);
    setting_list_add(&file, "solids=[{sphere: {radius: 0.1}}]");
    setting_list_add(&file, "drains[0].shut=false");
    setting_list_remove_within(&mine, &file);
    assert_int_equal(mine.count, 3);
    assert_string_equal(mine.set[0], settings[1]);
    setting_list_free(&mine);
    setting_list_free(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_there_and_back), cmocka_unit_test(test_kinds),
                                       cmocka_unit_test(test_settle), cmocka_unit_test(test_within)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
