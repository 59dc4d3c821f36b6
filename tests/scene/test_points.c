/* Curves by control points: values, syntax in a scene, and errors. */
#include "tests/scene/scene_text.h"

#include "app/scene/scene.h"
#include "sim/base/base.h"

#include <math.h>
#include <stdlib.h>

static Scene scene;
static Error error;

/* By the weights of the two neighbours, from the high end on. */
static double by_hand(const ControlPoints *points, double x)
{
    const int last = points->count - 1;
    if (x <= points->x[0])
        return points->y[0];
    for (int k = last; k > 0; k--)
        if (x > points->x[k - 1]) {
            const double width = points->x[k] - points->x[k - 1];
            const double share = fmin((x - points->x[k - 1]) / width, 1);
            return (1 - share) * points->y[k - 1] + share * points->y[k];
        }
    return points->y[0];
}

static void lines_go_through_their_points(void **state)
{
    (void)state;
    const ControlPoints points = {4, {0.1, 0.25, 0.3, 0.9}, {0.2, 1, 0, 3}};
    for (int k = 0; k < points.count; k++)
        assert_true(control_points_at(&points, points.x[k]) == points.y[k]);
    for (double x = -0.5; x < 1.5; x += 0.001)
        assert_true(fabs(control_points_at(&points, x) - by_hand(&points, x)) < 1e-14);
    assert_true(control_points_at(&points, -INFINITY) == 0.2 && control_points_at(&points, INFINITY) == 3);
    assert_true(control_points_at(&points, (double)NAN) == 3); /* as the high end */
    assert_true(control_points_most(&points) == 3 && control_points_least(&points) == 0);
}

static void presets_are_curves(void **state)
{
    (void)state;
    assert_true(control_points_are_straight(&control_presets[0].points));
    for (const ControlPreset *preset = control_presets; preset->name; preset++) {
        const ControlPoints *points = &preset->points;
        assert_true(points->count >= 1 && points->count <= CONTROL_POINTS_MAX);
        for (int k = 0; k < points->count; k++)
            assert_true(points->y[k] >= 0 && points->y[k] <= 1 &&
                        (k == 0 ? points->x[k] >= 0 : points->x[k] > points->x[k - 1]) && points->x[k] <= 1);
    }
}

static void points_are_edited(void **state)
{
    (void)state;
    ControlPoints points = control_points_straight();
    assert_int_equal(control_points_add(&points, 0.5, 0.9), 1);
    assert_int_equal(control_points_add(&points, 0.2, 0.3), 1);
    assert_int_equal(control_points_add(&points, 0.2 + CONTROL_POINTS_GAP / 2, 0.3), -1); /* too near */
    assert_int_equal(control_points_add(&points, 1.5, 0.3), -1);
    const ControlPoints four = {4, {0, 0.2, 0.5, 1}, {0, 0.3, 0.9, 1}};
    assert_true(control_points_equal(&points, &four));
    control_points_move(&points, 1, 0.7, 0.1); /* as far as its neighbour */
    assert_true(points.x[1] == 0.5 - CONTROL_POINTS_GAP && points.y[1] == 0.1);
    control_points_move(&points, 0, -3, 0.4);
    assert_true(points.x[0] == 0 && points.y[0] == 0.4);
    assert_true(control_points_remove(&points, 1) && points.count == 3 && points.x[1] == 0.5);
    while (points.count < CONTROL_POINTS_MAX)
        assert_true(control_points_add(&points, 0.5 + 0.05 * points.count, 1) > 0);
    assert_int_equal(control_points_add(&points, 0.01, 1), -1);
    while (points.count > 1)
        assert_true(control_points_remove(&points, 0));
    assert_false(control_points_remove(&points, 0));
}

#define VIEW LEAST "view:\n"

static void a_scene_has_curves(void **state)
{
    (void)state;
    static const char text[] =
        VIEW "  color_curve: [[0, 1], [1, 0]]\n"
             "  opacity: {by: pressure, range: [0, 2000], curve: [[0, 0.1], [0.5, 1], [1, 0.25]]}\n"
             "  size: {by: speed, curve: ends}\n";
    if (!parse_text(text, NULL, &scene, &error))
        fail_msg("%s", error.message);
    const ViewDef *view = &scene.view;
    assert_int_equal(scalar_of_curve(&view->opacity), SCALAR_PRESSURE);
    assert_int_equal(scalar_of_curve(&view->size), SCALAR_SPEED);
    assert_true(!view->opacity.range_auto && view->opacity.range[1] == 2000 && view->size.range_auto);
    assert_int_equal(view->opacity.curve.count, 3);
    assert_true(view->opacity.curve.x[1] == 0.5 && view->opacity.curve.y[2] == 0.25);
    char *print = scene_print_text(&scene);
    assert_non_null(strstr(print, "\nview.color_curve = falling\n")); /* points that have a name */
    assert_non_null(strstr(print, "\nview.opacity.by = pressure\n"));
    assert_non_null(strstr(print, "\nview.opacity.curve = [[0, 0.1], [0.5, 1], [1, 0.25]]\n"));
    assert_non_null(strstr(print, "\nview.size.curve = ends\n"));
    free(print);
}

/* Printed curves are readable, at the start and during a run; a range belongs to a scalar. */
static void curves_are_set(void **state)
{
    (void)state;
    char text[256];
    const char *setting = "view.size.curve=[[0, 2.5], [0.125, 0.75], [0.3, 0], [0.875, 5]]";
    assert_true(parse_set(LEAST, setting, &scene, &error));
    key_value_text(scene_key_find("view.size.curve"), &scene, text, sizeof text);
    assert_string_equal(text, strchr(setting, '=') + 1);
    assert_true(parse_text(LEAST, NULL, &scene, &error));
    assert_true(scene_set_live(&scene, setting, NULL, &error));
    assert_int_equal(scene.view.size.curve.count, 4);
    assert_true(scene_set_live(&scene, "view.size.curve=middle", NULL, &error));
    assert_true(control_points_equal(&scene.view.size.curve, &control_presets[2].points));
    assert_false(scene_set_live(&scene, "view.size.curve=[[0, 6]]", NULL, &error));
    assert_non_null(strstr(error.message, "view.size.curve must be 0 to 5, not 6"));

    assert_true(parse_set(VIEW "  opacity: {by: speed, range: [0, 2]}\n", "view.opacity.by=pressure", &scene,
                          &error));
    assert_true(scene.view.opacity.range_auto);
    assert_true(parse_text(VIEW "  size: {by: speed, range: [0, 2]}\n", NULL, &scene, &error));
    assert_false(scene.view.size.range_auto);
    assert_true(scene_set_live(&scene, "view.size.by=density", NULL, &error) && scene.view.size.range_auto);
    assert_true(parse_text(VIEW "  size: {by: speed, range: [0, 2]}\n", NULL, &scene, &error));
    assert_true(scene_set_live(&scene, "view.color_by=density", NULL, &error));
    assert_false(scene.view.size.range_auto);
}

static void wrong_curves_are_refused(void **state)
{
    (void)state;
#define CURVE_REFUSED(value, message)                                                                        \
    assert_refused(VIEW "  opacity:\n    curve: " value "\n", "scene.yaml:" message)
    CURVE_REFUSED("[[0.5, 0], [0.4, 1]]",
                  "9:24: view.opacity.curve: places in the range must ascend; 0.4 stands after 0.5");
    CURVE_REFUSED("[[0.5, 0], [0.5, 1]]",
                  "9:24: view.opacity.curve: places in the range must ascend; 0.5 stands after 0.5");
    CURVE_REFUSED("[[0, 0], [1.5, 1]]",
                  "9:22: view.opacity.curve: places in the range must be 0 to 1, not 1.5");
    CURVE_REFUSED("[[-0.1, 0]]", "9:14: view.opacity.curve: places in the range must be 0 to 1, not -0.1");
    CURVE_REFUSED("[[.nan, 0]]", "9:14: view.opacity.curve: places in the range must be 0 to 1, not .nan");
    CURVE_REFUSED("[[0, 0], [1, 1.01]]", "9:25: view.opacity.curve must be 0 to 1, not 1.01");
    CURVE_REFUSED("[[0, .nan]]", "9:17: view.opacity.curve must be a finite number, not .nan");
    CURVE_REFUSED("[[0, x]]", "9:17: view.opacity.curve must be a name or rows");
    CURVE_REFUSED("[[0, 0, 0]]", "9:13: view.opacity.curve must be a name or rows");
    CURVE_REFUSED("[0, 1]", "9:13: view.opacity.curve must be a name or rows");
    CURVE_REFUSED("{a: 1}", "9:12: view.opacity.curve must be a name or rows");
    CURVE_REFUSED("[]", "9:12: view.opacity.curve has 0 rows; a curve must have 1 to 8");
    CURVE_REFUSED("[[0, 0], [0.1, 0], [0.2, 0], [0.3, 0], [0.4, 0], [0.5, 0], [0.6, 0], [0.7, 0], [0.8, 0]]",
                  "9:12: view.opacity.curve has 9 rows; a curve must have 1 to 8");
    CURVE_REFUSED("risin", "9:12: view.opacity.curve cannot have 'risin'; did you mean 'rising'?");
    assert_refused(VIEW "  size: {by: speed, range: [2, 1]}\n",
                   "scene.yaml:8:28: the range's low (2) is not below its high (1)");
}

/* A curve without a scalar has no effect. */
static void a_curve_alone_is_told(void **state)
{
    (void)state;
    Notes notes = {.count = 0};
    static const char text[] = VIEW "  size: {curve: ends}\n  color_curve: ends\n";
    assert_true(parse_text(text, NULL, &scene, &error));
    assert_true(scene_parse("scene.yaml", text, strlen(text),
                            &(SceneSettings){.count = 1, .set = {"view.size.curve=ends"}}, &scene, &notes,
                            &error));
    assert_int_equal(notes.count, 1);
    assert_non_null(strstr(notes.line[0], "view.size.curve has no effect; it needs a scalar (view.size.by)"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_go_through_their_points),
        cmocka_unit_test(presets_are_curves),
        cmocka_unit_test(points_are_edited),
        cmocka_unit_test(a_scene_has_curves),
        cmocka_unit_test(curves_are_set),
        cmocka_unit_test(wrong_curves_are_refused),
        cmocka_unit_test(a_curve_alone_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
