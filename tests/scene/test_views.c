/* Pictures in panels: each entry of views is `view` with the entry's settings. */
#include "tests/scene/scene_text.h"

#include "app/scene/scene.h"
#include "render/overlays/trails/trails.h"
#include "render/views/slice/slice.h"

#include <stdlib.h>

#define VIEW                                                                                                 \
    "view: {kind: slice, color_by: pressure, range: [0, 9], slice: {normal: [1, 0, 0], isolines: 3}}\n"
#define VIEWS                                                                                                \
    VIEW "views:\n"                                                                                          \
         "  - {}\n"                                                                                          \
         "  - {kind: spheres, color_by: speed}\n"                                                            \
         "  - {slice: {isolines: 5}, range: [1, 2]}\n"                                                       \
         "  - {color_by: density, range: [3, 4], camera: {from: [3, 2, 1], to: [0, 0, 0]}}\n"

static Scene scene;

static void entries_are_view_but_for_what_they_say(void **state)
{
    (void)state;
    Error error = {{0}};
    if (!parse_text(LEAST VIEWS, NULL, &scene, &error))
        fail_msg("%s", error.message);
    assert_int_equal(scene_view_count(&scene), 4);
    assert_memory_equal(&scene.views[0], &scene.view, sizeof scene.view);
    const ViewDef *one = scene_view(&scene, 1), *two = scene_view(&scene, 2), *three = scene_view(&scene, 3);
    assert_string_equal(one->kind, "spheres");
    assert_true(one->range_auto); /* the range of view is of its scalar */
    assert_true(slice_def(one)->isolines == 3);
    assert_true(slice_def(two)->isolines == 5 && slice_def(two)->normal[0] == 1);
    assert_true(!two->range_auto && two->range[0] == 1 && two->camera_auto);
    assert_true(!three->range_auto && three->range[1] == 4);
    assert_true(!three->camera_auto && three->camera.from[1] == 2);
    assert_true(scene.view.camera_auto);
    assert_true(parse_text(LEAST VIEW, NULL, &scene, &error));
    assert_int_equal(scene_view_count(&scene), 1);
    assert_ptr_equal(scene_view(&scene, 0), &scene.view);
}

/* So are those of opacity and size. */
static void ranges_are_of_their_scalars(void **state)
{
    (void)state;
    Error error = {{0}};
    const char *text =
        LEAST "view: {opacity: {by: pressure, range: [0, 9]}, size: {by: density, range: symmetric}}\n"
              "views: [{}, {opacity: {by: speed}}, {opacity: {by: speed, range: [1, 2]}}]\n";
    assert_true(parse_text(text, NULL, &scene, &error));
    const ViewDef *one = scene_view(&scene, 0);
    assert_true(!one->opacity.range_auto && one->opacity.range[1] == 9);
    assert_true(one->size.range_auto && one->size.range_symmetric);
    assert_true(scene_view(&scene, 1)->opacity.range_auto);
    assert_true(!scene_view(&scene, 2)->opacity.range_auto && scene_view(&scene, 2)->opacity.range[1] == 2);
    assert_true(scene_set_live(&scene, "views[0].opacity.by=vorticity", NULL, &error));
    assert_true(one->opacity.range_auto && !scene.view.opacity.range_auto);
    assert_true(parse_set(text, "view.opacity.by=id", &scene, &error));
    assert_true(scene.view.opacity.range_auto && one->opacity.range_auto);
}

static void settings_reach_them(void **state)
{
    (void)state;
    Error error = {{0}};
    assert_true(parse_set(LEAST VIEWS, "views[2].slice.isolines=7", &scene, &error));
    assert_true(slice_def(&scene.views[2])->isolines == 7 && slice_def(&scene.view)->isolines == 3);
    assert_true(parse_set(LEAST VIEWS, "view.color_by=speed", &scene, &error)); /* a range is of one scalar */
    assert_true(scene.view.range_auto && scene.views[0].range_auto && !scene.views[2].range_auto);
    assert_true(parse_set(LEAST VIEW, "views=[{}, {kind: spheres}]", &scene, &error));
    assert_int_equal(scene.view_count, 2);
    assert_string_equal(scene.views[1].kind, "spheres");
    assert_string_equal(scene_key_find("views[3].slice.normal")->path, "view.slice.normal");
    assert_null(scene_key_find("views[3]"));
    assert_null(scene_key_find("views[3].nosuch"));
    assert_null(scene_key_find("views.kind"));
}

static void live_settings_reach_them(void **state)
{
    (void)state;
    Error error = {{0}};
    bool of_world = true;
    assert_true(parse_text(LEAST VIEWS, NULL, &scene, &error));
    assert_true(scene_set_live(&scene, "views[2].color_by=speed", &of_world, &error) && !of_world);
    assert_int_equal(scene.views[2].color_by, SCALAR_SPEED);
    assert_true(scene.views[2].range_auto && scene.view.color_by == SCALAR_PRESSURE);
    assert_false(scene_set_live(&scene, "views[4].kind=volume", &of_world, &error));
    assert_non_null(strstr(error.message, "the scene has no views[4]; use at most views[3]"));
    assert_false(scene_set_live(&scene, "views[1].camera.from=[1, 1, 1]", &of_world, &error));
    assert_non_null(strstr(error.message, "the camera is automatic"));
    assert_true(scene_set_live(&scene, "views[3].camera.from=[1, 1, 1]", &of_world, &error));
    assert_true(scene.views[3].camera.from[0] == 1);
}

static void what_is_wrong_has_its_place(void **state)
{
    (void)state;
    assert_refused(LEAST "views: [{kind: spheres}, {kond: splat}]\n",
                   "scene.yaml:7:27: unknown key 'kond'; did you mean 'kind'?");
    assert_refused(LEAST "views: [{kind: blob}]\n", "scene.yaml:7:16: views[0].kind cannot be 'blob'");
    assert_refused(LEAST "views: [{}, {range: [2, 1]}]\n",
                   "scene.yaml:7:21: the range's low (2) is not below");
    assert_refused(LEAST "views: [{}, {size: {by: speed, range: [2, 1]}}]\n",
                   "scene.yaml:7:39: the range's low (2) is not below");
    assert_refused(LEAST "views: [{slice: {normal: [0, 0, 0]}, kind: slice}]\n",
                   "scene.yaml:7:26: a normal of length 0");
    assert_refused(LEAST "view: {trails: {show: true, ids: abc}}\n",
                   "scene.yaml:7:34: \"abc\" is no list of at most 16 ids");
    assert_refused(LEAST "view: {trails: {show: true, ids: [3, -4]}}\n",
                   "scene.yaml:7:34: \"3 -4\" is no list of at most 16 ids; [3, 17, 250] is one");
    assert_refused(LEAST "view: {trails: {ids: [3, [4]]}}\n",
                   "scene.yaml:7:26: view.trails.ids must be a list of words, not a list");
    assert_refused(LEAST "view: {trails: {ids: []}}\n", "scene.yaml:7:22: view.trails.ids has no entry");
    assert_refused(LEAST "view: {kind: [splat, slice]}\n", "scene.yaml:7:14: view.kind");
    assert_refused(LEAST "view: {glyphs: {show: true, at: plane, plane_normal: [0, 0, 0]}}\n",
                   "scene.yaml:7:54: a normal of length 0");
    assert_refused(LEAST "views: [{camera: {from: [1, 1, 1]}}]\n",
                   "scene.yaml:7:18: views[0].camera.to is missing");
    assert_refused(LEAST "views: [{}, {}, {}, {}, {}]\n",
                   "scene.yaml:7:8: views has 5 entries; it must have 0 to 4");
    assert_refused(LEAST "views: {kind: slice}\n", "scene.yaml:7:8: views must be a list");
}

static void what_has_no_effect_is_said(void **state)
{
    (void)state;
    Error error = {{0}};
    static Notes notes;
    SceneSettings settings = {.count = 1,
                              .set = {"views=[{kind: slice, slice: {isolines: 2}}, {slice: {isolines: 3}}]"}};
    assert_true(scene_parse("scene.yaml", LEAST, strlen(LEAST), &settings, &scene, &notes, &error));
    assert_int_equal(notes.count, 1);
    assert_non_null(
        strstr(notes.line[0], ": views[1].slice.isolines has no effect; it needs views[1].kind: slice"));
    settings.set[0] = "views=[{opacity: {curve: falling}}, {kind: slice, size: {by: speed}}]";
    assert_true(scene_parse("scene.yaml", LEAST, strlen(LEAST), &settings, &scene, &notes, &error));
    assert_int_equal(notes.count, 2);
    assert_non_null(strstr(
        notes.line[0], ": views[0].opacity.curve has no effect; it needs a scalar (views[0].opacity.by)"));
    assert_non_null(
        strstr(notes.line[1], ": views[1].size.by has no effect; it needs views[1].kind: spheres"));
}

static void entries_have_sources(void **state)
{
    (void)state;
    Error error = {{0}};
    const char *text =
        LEAST "views: [{}, {set: {solver: {step: {dt: 0.001}}, gravity: [0, -3, 0], title: \"a: b\"}}, "
              "{file: a run.h5part}]\n";
    if (!parse_text(text, NULL, &scene, &error))
        fail_msg("%s", error.message);
    assert_string_equal(scene.views[1].set, "solver.step.dt=0.001\ngravity=[0, -3, 0]\ntitle=\"a: b\"");
    assert_string_equal(scene.views[2].file, "a run.h5part");
    char *shown = scene_print_text(&scene);
    assert_non_null(strstr(shown, "\nviews[1].set = {\"solver.step.dt\": 0.001, \"gravity\": [0, -3, 0], "
                                  "\"title\": \"a: b\"}\n"));
    free(shown);
    assert_true(parse_set(LEAST, "views=[{}, {set: {\"fluids[0].density\": 900}}]", &scene, &error));
    assert_string_equal(scene.views[1].set, "fluids[0].density=900");
    assert_true(parse_set(LEAST, "view.trails.ids=[3, 17,250]", &scene, &error));
    assert_string_equal(trails_def(&scene.view)->ids, "3 17 250");
#define EIGHT "2147483647, 2147483647, 2147483647, 2147483647, 2147483647, 2147483647, 2147483647, 2147483647"
    uint32_t ids[TRAILS_LISTED_MAX];
    assert_true(parse_set(LEAST, "view.trails.ids=[" EIGHT ", " EIGHT "]", &scene, &error));
    assert_int_equal(trails_listed_ids(trails_def(&scene.view), ids), TRAILS_LISTED_MAX);
    assert_false(parse_set(LEAST, "view.trails.ids=[" EIGHT ", " EIGHT ", 1]", &scene, &error));
    assert_non_null(strstr(error.message, "view.trails.ids is too long; use at most 175 bytes"));
    assert_true(parse_set(LEAST, "views=[{}, {time: 0.25}]", &scene, &error));
    assert_true(scene.views[0].time < 0 && scene.views[1].time == 0.25);
    assert_false(parse_set(LEAST, "views=[{time: -2}]", &scene, &error));
    assert_false(parse_set(LEAST, "view.color_by=lost", &scene, &error));
    assert_non_null(strstr(error.message, "lost"));
    assert_false(parse_set(LEAST, "view.set={gravity: 3}", &scene, &error));
    assert_non_null(strstr(error.message, "view.set is for entries of views"));
    assert_false(parse_text(LEAST "views: [{file: a.h5part}]\n", NULL, &scene, &error));
    assert_non_null(strstr(error.message, "leave it out of one, which shows the scene"));
}

/* The method decides the available scalars: each entry's own method only. */
static void each_is_judged_by_its_own_settings(void **state)
{
    (void)state;
    Error error = {{0}};
    const char *text =
        LEAST "solver: {method: dfsph}\nviews: [{color_by: kept_term}, "
              "{set: {solver.method: mueller}, color_by: kept_term}, {file: a.h5part, color_by: rate}]\n";
    SceneSettings mueller = {
        .count = 1, .set = {"solver.method=mueller"}, .compared_set = "solver.method=mueller"};
    if (!parse_text(text, NULL, &scene, &error))
        fail_msg("%s", error.message);
    assert_true(scene_set_live(&scene, "views[0].color_by=speed", NULL, &error));
    assert_false(parse_text(text, &mueller, &scene, &error));
    assert_non_null(strstr(error.message, "particles of this scene have no kept_term"));
    assert_refused(LEAST "views: [{color_by: kept_term}, {set: {solver.method: dfsph}}]\n",
                   "scene.yaml:7:20: particles of this scene have no kept_term");
    mueller.set[0] = mueller.compared_set = "solver.method=dfsph";
    if (!parse_text(LEAST "views: [{}, {set: {solver.method: dfsph}, color_by: kept_term}]\n", &mueller,
                    &scene, &error))
        fail_msg("%s", error.message);
}

/* A column of the world, if a view reads accelerations. */
static void accelerations_of_others_cost_the_scene_nothing(void **state)
{
    (void)state;
    Error error = {{0}};
    const char *text = LEAST "views: [{}, {file: a.h5part, color_by: acceleration_y}, "
                             "{set: {gravity: [0, -3, 0]}, color_by: acceleration}]\n";
    SceneSettings set = {.count = 1, .set = {"gravity=[0, -3, 0]"}, .compared_set = "gravity=[0, -3, 0]"};
    if (!parse_text(text, NULL, &scene, &error))
        fail_msg("%s", error.message);
    assert_false(scene.world.acceleration);
    assert_true(parse_text(text, &set, &scene, &error));
    assert_true(scene.world.acceleration);
    assert_true(parse_set(text, "views[0].color_by=acceleration", &scene, &error));
    assert_true(scene.world.acceleration);
}

static void a_setting_of_view_that_entries_have_themselves(void **state)
{
    (void)state;
    Error error = {{0}};
    Notes notes;
    SceneSettings settings = {.count = 2, .set = {"view.color_by=density", "view.colormap=gray"}};
    assert_true(scene_parse("a.yaml", LEAST VIEWS, strlen(LEAST VIEWS), &settings, &scene, &notes, &error));
    assert_true(notes_have(&notes, "view.color_by does not reach views[1], views[3], where it is said anew; "
                                   "views[N].color_by=... does"));
    for (int i = 0; i < notes.count; i++)
        assert_null(strstr(notes.line[i], "view.colormap does not"));
}

static void print_says_what_differs(void **state)
{
    (void)state;
    Error error = {{0}};
    assert_true(parse_text(LEAST VIEWS, NULL, &scene, &error));
    char *text = scene_print_text(&scene);
    assert_non_null(strstr(text, "\nview.slice.isolines = 3\n"));
    assert_non_null(strstr(text, "\nviews = [{}, {}, {}, {}]\n")); /* the first differs in nothing */
    assert_non_null(strstr(text, "\nviews[1].kind = spheres\n"));
    assert_non_null(strstr(text, "\nviews[2].slice.isolines = 5\n"));
    assert_non_null(strstr(text, "\nviews[3].camera.from = [3, 2, 1] m\n"));
    assert_null(strstr(text, "views[0]"));
    assert_null(strstr(text, "views[1].slice"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_are_view_but_for_what_they_say),
        cmocka_unit_test(ranges_are_of_their_scalars),
        cmocka_unit_test(settings_reach_them),
        cmocka_unit_test(live_settings_reach_them),
        cmocka_unit_test(what_is_wrong_has_its_place),
        cmocka_unit_test(what_has_no_effect_is_said),
        cmocka_unit_test(each_is_judged_by_its_own_settings),
        cmocka_unit_test(entries_have_sources),
        cmocka_unit_test(accelerations_of_others_cost_the_scene_nothing),
        cmocka_unit_test(a_setting_of_view_that_entries_have_themselves),
        cmocka_unit_test(print_says_what_differs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
