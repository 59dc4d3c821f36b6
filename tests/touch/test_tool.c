/* The touch tool: where the finger is under the mouse, when it is sent, and how a recording writes it. */
#include "tests/sim/fixture.h"

#include "app/input/input.h"
#include "app/run/recording/recording.h"

static const double ahead[3] = {0, 0, -1};

static SightRay ray_at(double x, double y)
{
    return (SightRay){{x, y, 5}, {0, 0, -1}};
}

static bool asks(TouchTool *tool, Finger *finger)
{
    const TouchDef def = touch_def_default();
    return touch_tool_finger(tool, &def, 0.1, finger);
}

/* In the plane that faces the camera through the place of the press. */
static void it_keeps_the_depth_of_the_press(void **state)
{
    (void)state;
    TouchTool tool = {.on = true};
    Finger finger;
    touch_tool_press(&tool, FINGER_PULL, (double[3]){0.1, 0.2, 0.7});
    const SightRay ray = ray_at(0.4, 0.5), beside = {{0, 0, 5}, {1, 0, 0}};
    assert_true(touch_tool_move(&tool, &ray, ahead, 3));
    assert_true(asks(&tool, &finger) && finger.way == (double)FINGER_PULL);
    assert_true(fabs(finger.at[0] - 0.4) < 1e-12 && fabs(finger.at[1] - 0.5) < 1e-12 &&
                fabs(finger.at[2] - 0.7) < 1e-12 && fabs(finger.radius - 0.5) < 1e-12);
    assert_false(touch_tool_move(&tool, &beside, ahead, 3)); /* stays in place */
    assert_false(asks(&tool, &finger));
    assert_true(touch_tool_move(&tool, &ray, ahead, 2) && tool.at[2] == 0);
}

static void it_is_sent_when_it_changes(void **state)
{
    (void)state;
    TouchTool tool = {.on = true};
    Finger finger;
    assert_false(asks(&tool, &finger));
    touch_tool_press(&tool, FINGER_STIR, (double[3]){0, 0, 0});
    assert_true(asks(&tool, &finger));
    assert_false(asks(&tool, &finger));
    touch_tool_reset(&tool); /* a new start, under the same drag */
    assert_true(asks(&tool, &finger) && finger.way == (double)FINGER_STIR);
    touch_tool_release(&tool, false);
    assert_true(asks(&tool, &finger) && finger.way == (double)FINGER_NONE);
    assert_false(asks(&tool, &finger));
}

/* A drag during a time jump ends silently: an end command would cut off the future. */
static void a_jump_ends_it(void **state)
{
    (void)state;
    TouchTool tool = {.on = true};
    Finger finger;
    touch_tool_press(&tool, FINGER_STIR, (double[3]){0, 0, 0});
    assert_true(asks(&tool, &finger));
    touch_tool_travel(&tool, 3, false);
    assert_false(asks(&tool, &finger));
    touch_tool_release(&tool, true);
    assert_false(asks(&tool, &finger));
    touch_tool_travel(&tool, 3, false);
    touch_tool_press(&tool, FINGER_STIR, (double[3]){0, 0, 0});
    assert_true(asks(&tool, &finger));
    touch_tool_travel(&tool, 4, false);
    touch_tool_release(&tool, false); /* no later states: the end is sent, whoever lifted the finger */
    assert_true(asks(&tool, &finger) && finger.way == (double)FINGER_NONE);
    touch_tool_travel(&tool, 4, true);
    touch_tool_press(&tool, FINGER_STIR, (double[3]){0, 0, 0});
    touch_tool_travel(&tool, 5, false); /* by a command of the session that the press has ended */
    assert_true(asks(&tool, &finger) && finger.way == (double)FINGER_STIR);
}

static void the_ring_shows_the_ball(void **state)
{
    (void)state;
    const TouchDef def = touch_def_default();
    const TouchTool tool = {.at = {1, 2, 3}};
    static const double looks[][3] = {{0, 0, -1}, {0, -1, 0}, {0.6, -0.8, 0}};
    for (int i = 0; i < 3; i++) {
        const Handle ring = touch_tool_outline(&tool, &def, 0.1, looks[i]);
        for (int part = 0; part < HANDLE_RING_PARTS; part += 7) {
            double corner[3], r2 = 0, along = 0;
            handle_ring(&ring, part, corner);
            for (int k = 0; k < 3; k++) {
                r2 += pow(corner[k] - tool.at[k], 2);
                along += (corner[k] - tool.at[k]) * looks[i][k];
            }
            assert_true(fabs(sqrt(r2) - 0.5) < 1e-9 && fabs(along) < 1e-9);
        }
    }
}

static void the_wheel_keeps_bounds(void **state)
{
    (void)state;
    assert_true(fabs(touch_tool_notches(4, 5, 1, 100) - 8) < 0.1 && touch_tool_notches(4, -50, 1, 100) == 1 &&
                touch_tool_notches(4, 500, 1, 100) == 100 && touch_tool_notches(4, 0, 1, 100) == 4);
    for (int way = FINGER_STIR; way < FINGER_WAYS; way++) {
        assert_true(touch_tool_other((FingerWay)way) != (FingerWay)way);
        assert_int_equal(finger_way_find(finger_way_name((FingerWay)way)), way);
    }
    assert_int_equal(finger_way_find("none"), FINGER_NONE);
    assert_int_equal(finger_way_find("poke"), FINGER_WAYS);
}

static const char *parse(const char *line, Recording *out)
{
    static Error error;
    char text[512];
    snprintf(
        text, sizeof text,
        "slosh recording 1\nprogram 0.1\nscene a.yaml\ntext\n| box:\ncommands\n%s\nend 8 0123456789abcdef\n",
        line);
    return recording_parse("a.rec", text, strlen(text), out, &error) ? "" : error.message;
}

static void a_line_of_a_recording(void **state)
{
    (void)state;
    static const struct {
        const char *line, *message;
    } slips[] = {
        {"3 touch poke 0 0 0 1 1",
         "'poke 0 0 0 1 1' does not say what a finger does; none, stir, pull, push or pour"},
        {"3 touch stir 0 0 0 1", "number 5 of 5 is missing or not finite"},
        {"3 touch stir 0 0 0 1 1 1", "' 1' follows what the finger does; leave it out"},
        {"3 touch none 0", "' 0' follows what the finger does; leave it out"},
        {"3 touch stir 0 0 0 -1 1", "the radius of a finger must be above 0"},
        {"3 touch pour 0 0 0 1 1", "which fluid is poured must stand behind its speed"},
        {"3 touch pour 0 0 0 1 1 8", "which fluid is poured must stand behind its speed"},
    };
    Recording out;
    assert_string_equal(
        parse("3 touch push 0.5 -1e-3 +2 0x1p-1 .25\n4 touch none\n5 touch pour 0 0 0 1 2 3", &out), "");
    assert_true(out.count == 3 && out.commands[2].finger.way == (double)FINGER_POUR + 3 &&
                out.commands[0].finger.way == (double)FINGER_PUSH && out.commands[0].finger.at[1] == -1e-3 &&
                out.commands[0].finger.radius == 0.5 && out.commands[0].finger.strength == 0.25 &&
                out.commands[1].finger.way == (double)FINGER_NONE);
    recording_destroy(&out);
    for (size_t i = 0; i < sizeof slips / sizeof *slips; i++) {
        const char *message = parse(slips[i].line, &out);
        if (!strstr(message, slips[i].message) || !strstr(message, "a.rec:7: "))
            fail_msg("%s: %s", slips[i].line, message);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_keeps_the_depth_of_the_press),
        cmocka_unit_test(it_is_sent_when_it_changes),
        cmocka_unit_test(a_jump_ends_it),
        cmocka_unit_test(the_ring_shows_the_ball),
        cmocka_unit_test(the_wheel_keeps_bounds),
        cmocka_unit_test(a_line_of_a_recording),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
