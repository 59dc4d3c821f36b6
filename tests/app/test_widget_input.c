/* Events faster than pictures: each change is seen by a widget, in order, where it happened. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "app/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string.h>

static WidgetInput input;

static int begin(void **state)
{
    (void)state;
    memset(&input, 0, sizeof input);
    return 0;
}

static void move(double x, double y)
{
    widget_input_add(&input, &(WindowEvent){.kind = WINDOW_MOVE, .x = x, .y = y});
}

static void button(bool down, double x, double y)
{
    widget_input_add(&input, &(WindowEvent){.kind = WINDOW_BUTTON, .down = down, .x = x, .y = y});
}

static void key(int number, bool down)
{
    widget_input_add(&input, &(WindowEvent){.kind = WINDOW_KEY, .key = number, .down = down});
}

static void type(const char *text)
{
    for (; *text; text++)
        widget_input_add(&input, &(WindowEvent){.kind = WINDOW_TEXT, .codepoint = (unsigned)*text});
}

/* The next picture has the left button so, at that place. */
static void expect(bool down, float x, float y)
{
    widget_input_next(&input);
    assert_int_equal(input.now.button[0], down);
    assert_float_equal(input.now.mouse[0], x, 0);
    assert_float_equal(input.now.mouse[1], y, 0);
}

static void two_clicks_in_one_picture(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        button(true, 10, 20 + i);
        button(false, 10, 20 + i);
    }
    expect(true, 10, 20);
    expect(false, 10, 20);
    expect(true, 10, 21);
    assert_int_equal(input.count, 1);
    expect(false, 10, 21);
    assert_int_equal(input.count, 0);
    expect(false, 10, 21);
}

static void a_move_to_the_same_place_takes_no_picture(void **state)
{
    (void)state;
    button(true, 7, 7);
    move(7, 7);
    button(false, 7, 7);
    expect(true, 7, 7);
    expect(false, 7, 7);
    assert_int_equal(input.count, 0);
}

static void a_drag_in_one_picture(void **state)
{
    (void)state;
    move(1, 1);
    move(5, 5);
    button(true, 5, 5);
    move(6, 5);
    move(30, 5);
    button(false, 30, 5);
    move(90, 90);
    expect(true, 5, 5);
    expect(true, 30, 5);
    expect(false, 30, 5);
    expect(false, 90, 90);
}

static void letters_and_keys_keep_their_order(void **state)
{
    (void)state;
    type("12");
    key(GLFW_KEY_BACKSPACE, true);
    key(GLFW_KEY_BACKSPACE, false);
    type("3");
    key(GLFW_KEY_ENTER, true);
    widget_input_next(&input);
    assert_string_equal(input.now.text, "12");
    assert_int_equal(input.now.keys, 0);
    widget_input_next(&input);
    assert_string_equal(input.now.text, "");
    assert_int_equal(input.now.keys, UI_KEY_BACKSPACE);
    widget_input_next(&input);
    assert_int_equal(input.now.keys, 0);
    assert_string_equal(input.now.text, "");
    widget_input_next(&input);
    assert_string_equal(input.now.text, "3");
    widget_input_next(&input);
    assert_int_equal(input.now.keys, UI_KEY_ENTER);
    assert_int_equal(input.count, 0);
}

static void a_held_modifier_comes_with_its_key(void **state)
{
    (void)state;
    key(GLFW_KEY_LEFT_CONTROL, true);
    key(GLFW_KEY_A, true);
    widget_input_next(&input);
    assert_int_equal(input.now.keys, UI_KEY_CTRL | UI_KEY_A);
}

static void the_wheel_turns_once(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++)
        widget_input_add(&input, &(WindowEvent){.kind = WINDOW_WHEEL, .y = 1});
    widget_input_next(&input);
    assert_float_equal(input.now.wheel, 3, 0);
    widget_input_next(&input);
    assert_float_equal(input.now.wheel, 0, 0);
}

static void a_full_queue_forgets_no_release(void **state)
{
    (void)state;
    button(true, 1, 1);
    button(false, 1, 1);
    for (int i = 0; i < WIDGET_EVENTS_MAX; i++)
        widget_input_add(&input, &(WindowEvent){.kind = WINDOW_WHEEL, .y = 1});
    assert_int_equal(input.count, WIDGET_EVENTS_MAX);
    expect(false, 1, 1);
}

static void hidden_widgets_know_what_is_held(void **state)
{
    (void)state;
    button(true, 3, 4);
    type("x");
    widget_input_skip(&input);
    assert_int_equal(input.count, 0);
    assert_true(input.now.button[0]);
    assert_string_equal(input.now.text, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(two_clicks_in_one_picture, begin),
        cmocka_unit_test_setup(a_move_to_the_same_place_takes_no_picture, begin),
        cmocka_unit_test_setup(a_drag_in_one_picture, begin),
        cmocka_unit_test_setup(letters_and_keys_keep_their_order, begin),
        cmocka_unit_test_setup(a_held_modifier_comes_with_its_key, begin),
        cmocka_unit_test_setup(the_wheel_turns_once, begin),
        cmocka_unit_test_setup(a_full_queue_forgets_no_release, begin),
        cmocka_unit_test_setup(hidden_widgets_know_what_is_held, begin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
