/* Pictures beside each other: each entry of views is view but for what it says. */
#include "tests/scene/scene_text.h"

#include "app/scene/keys.h"
#include "app/scene/live.h"
#include "render/slice/slice_def.h"

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

static void print_says_what_differs(void **state)
{
    (void)state;
    Error error = {{0}};
    assert_true(parse_text(LEAST VIEWS, NULL, &scene, &error));
    char *text = scene_print_text(&scene);
    assert_non_null(strstr(text, "\nview.slice.isolines = 3\n"));
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
        cmocka_unit_test(print_says_what_differs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
