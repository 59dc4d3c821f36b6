/* The outline of the hand's target: equals the box's rest pose, and vanishes on arrival. */
#include "tests/tolerance.h"

#include "app/input/input.h"

#include <string.h>

static const double size[3] = {0.4, 0.3, 0.2};

static BoxTarget target_of(double x, double y, double z, double degrees)
{
    const double half = degrees * M_PI / 360;
    return (BoxTarget){{x, y, z}, {0.6 * sin(half), 0, 0.8 * sin(half), cos(half)}};
}

/* Where the filter carries the box, on top of a motion of the scene. */
static void the_box_comes_to_the_outline(void **state)
{
    (void)state;
    const Motion shake = {.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.05, .frequency = 1.3};
    const BoxLimits limits = box_limits_default();
    const BoxTarget target = target_of(0.5, 0.1, -0.3, 70);
    BoxFilter filter = box_filter_at_rest();
    BoxState goal, box;
    double before = INFINITY;
    bool shown = false;
    for (int i = 0; i <= 3000; i++) {
        const double time = 1e-3 * i;
        box_state_at(&shake, 1, size[1], time, &box);
        box_filter_apply(&filter, size[1], &box);
        outline_pose(&shake, 1, size[1], time, &target, &goal);
        const double apart = outline_distance(&box, &goal, size);
        if (apart > before + 1e-3)
            fail_msg("the box leaves the outline at %g s", time);
        shown = outline_is_needed(shown, i == 0, apart);
        if (i == 0)
            assert_true(shown);
        before = apart;
        box_filter_step(&filter, &target, &limits, 1e-3);
    }
    assert_false(shown);
    check_near(before, 0, 1e-6, "what is left");
}

static void a_box_that_keeps_up_has_none(void **state)
{
    (void)state;
    assert_false(outline_is_needed(false, false, 3));
    assert_false(outline_is_needed(false, true, 0.01)); /* as good as there */
    assert_true(outline_is_needed(true, false, 0.01));  /* and until arrival */
}

static void a_turn_moves_the_corners(void **state)
{
    (void)state;
    const BoxTarget home = target_of(0, 0, 0, 0), turned = {.orientation = {0, 1, 0, 0}};
    BoxState a, b;
    outline_pose(NULL, 0, size[1], 0, &home, &a);
    outline_pose(NULL, 0, size[1], 0, &turned, &b);
    check_near(outline_distance(&a, &b, size), hypot(0.4, 0.2) / 0.4, 1e-9, "half a turn");
}

/* Twelve edges, each along one axis, all different, with the floor at y = 0. */
static void edges_are_the_boxs(void **state)
{
    (void)state;
    double middle[OUTLINE_EDGES][3];
    for (int i = 0; i < OUTLINE_EDGES; i++) {
        double a[3], b[3];
        outline_edge(size, i, a, b);
        for (int k = 0; k < 3; k++) {
            check_near(b[k] - a[k], k == i / 4 ? size[k] : 0, 1e-12, "an edge");
            check_near(fabs(a[k] - (k == 1 ? size[1] / 2 : 0)), size[k] / 2, 1e-12, "a corner");
            middle[i][k] = (a[k] + b[k]) / 2;
        }
        for (int j = 0; j < i; j++)
            assert_memory_not_equal(middle[i], middle[j], sizeof middle[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_box_comes_to_the_outline), cmocka_unit_test(a_box_that_keeps_up_has_none),
        cmocka_unit_test(a_turn_moves_the_corners), cmocka_unit_test(edges_are_the_boxs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
