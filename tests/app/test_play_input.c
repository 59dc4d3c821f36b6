/* From events to window actions, without a window: order, box-only moves, held keys. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "app/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <stdio.h>
#include <string.h>

enum { HEIGHT = 400 };

static RequestQueue asks;
static PlayInput input;

static int begin(void **state)
{
    (void)state;
    memset(&asks, 0, sizeof asks);
    input_begin(&input);
    return 0;
}

static void take(WindowEvent event)
{
    input_event(&input, &event, HEIGHT, &asks);
}

static WindowEvent key(int number, bool down)
{
    return (WindowEvent){.kind = WINDOW_KEY, .key = number, .down = down};
}

static WindowEvent held_key(int number)
{
    return (WindowEvent){.kind = WINDOW_KEY, .key = number, .down = true, .repeated = true};
}

static WindowEvent button(int number, int modifiers, bool down)
{
    return (WindowEvent){.kind = WINDOW_BUTTON,
                         .button = number,
                         .modifiers = modifiers,
                         .down = down,
                         .x = 100,
                         .y = 100,
                         .when_ms = 7};
}

static WindowEvent move(double x, double y)
{
    return (WindowEvent){.kind = WINDOW_MOVE, .x = x, .y = y, .when_ms = 8};
}

static Request next(RequestKind kind)
{
    Request ask;
    assert_true(request_next(&asks, &ask));
    assert_int_equal(ask.kind, kind);
    return ask;
}

static void no_more(void)
{
    Request ask;
    assert_false(request_next(&asks, &ask));
}

/* A file dropped between two keys waits, and is opened between the two actions. */
static void what_is_asked_waits_in_its_order(void **state)
{
    (void)state;
    WindowEvent drop = {.kind = WINDOW_DROP};
    snprintf(drop.path, sizeof drop.path, "dropped.yaml");
    take(key(GLFW_KEY_S, true));
    take(drop);
    take(key(GLFW_KEY_C, true));
    take(key(GLFW_KEY_C, false));
    take((WindowEvent){.kind = WINDOW_CLOSE});
    assert_int_equal(asks.count, 4);
    assert_ptr_equal(next(REQUEST_ACTION).action, &action_next_scalar);
    assert_string_equal(next(REQUEST_OPEN_SCENE).text, "dropped.yaml");
    assert_ptr_equal(next(REQUEST_ACTION).action, &action_next_colormap);
    assert_ptr_equal(next(REQUEST_ACTION).action, &action_quit);
    no_more();
}

static void camera_moves_add_up_until_another_comes(void **state)
{
    (void)state;
    take(button(GLFW_MOUSE_BUTTON_LEFT, 0, true));
    take(move(110, 100));
    take(move(120, 60));
    take(key(GLFW_KEY_C, true));
    take(move(140, 60));
    next(REQUEST_GRAB_CAMERA);
    const Request first = next(REQUEST_ACTION);
    assert_ptr_equal(next(REQUEST_ACTION).action, &action_next_colormap);
    const Request second = next(REQUEST_ACTION);
    assert_true(first.action == &action_orbit && second.action == &action_orbit);
    assert_true(first.amount[0] > 0 && first.amount[0] == second.amount[0]);
    assert_true(first.amount[1] == 2 * second.amount[0] && second.amount[1] == 0);
    no_more();
}

static void a_full_queue_keeps_what_it_has_and_counts_the_rest(void **state)
{
    (void)state;
    for (int round = 0; round < 3; round++) { /* round the ring */
        for (int i = 0; i < REQUESTS_MAX + 5; i++)
            request_add_action(&asks, i == 0 ? &action_pause : &action_step);
        assert_int_equal(asks.count, REQUESTS_MAX);
        assert_int_equal(requests_lost(&asks), 5);
        assert_int_equal(requests_lost(&asks), 0); /* a single message */
        assert_ptr_equal(next(REQUEST_ACTION).action, &action_pause);
        for (int i = 1; i < REQUESTS_MAX; i++)
            assert_ptr_equal(next(REQUEST_ACTION).action, &action_step);
        no_more();
        request_add_action(&asks, &action_step);
        next(REQUEST_ACTION);
    }
}

static bool only_holds(WindowEvent event)
{
    return input_only_holds(&input, &event);
}

/* Events allowed in the middle of a picture cause no action. */
static void what_only_holds_asks_for_nothing(void **state)
{
    (void)state;
    assert_true(only_holds(move(1, 1)) && only_holds(key(GLFW_KEY_LEFT, true)));
    assert_true(only_holds(key(GLFW_KEY_S, false)) && only_holds(held_key(GLFW_KEY_S)));
    assert_false(only_holds(key(GLFW_KEY_S, true)) || only_holds(held_key(GLFW_KEY_PERIOD)));
    for (int kind = WINDOW_TEXT; kind <= WINDOW_CLOSE; kind++)
        assert_true(kind == WINDOW_MOVE || !only_holds((WindowEvent){.kind = (WindowEventKind)kind}));
    take(button(GLFW_MOUSE_BUTTON_LEFT, GLFW_MOD_SHIFT, true));
    assert_true(only_holds(move(2, 2)) && input_holds_box(&input));
    take(move(2, 2));
    take(key(GLFW_KEY_LEFT, true));
    no_more();
    take(button(GLFW_MOUSE_BUTTON_LEFT, GLFW_MOD_SHIFT, false));
    take(button(GLFW_MOUSE_BUTTON_RIGHT, 0, true));
    no_more(); /* it may be a click */
    assert_true(input_busy(&input));
    assert_false(only_holds(move(3, 3)));
}

/* A click without movement requests a trail, a drag grabs the camera. */
static void a_right_click_is_no_drag(void **state)
{
    (void)state;
    for (int drag = 0; drag < 2; drag++) {
        take(button(GLFW_MOUSE_BUTTON_RIGHT, 0, true));
        take(move(101, 101));
        no_more();
        if (drag) {
            take(move(110, 100));
            next(REQUEST_GRAB_CAMERA);
            assert_ptr_equal(next(REQUEST_ACTION).action, &action_pan);
        }
        take(button(GLFW_MOUSE_BUTTON_RIGHT, 0, false));
        if (!drag)
            assert_ptr_equal(next(REQUEST_ACTION).action, &action_trail);
        no_more();
    }
}

/* A drag and a key move the box once each; a stick and a button of a gamepad do too. */
static void what_is_held_moves_the_box(void **state)
{
    (void)state;
    HandInput hand = {.dt = 0};
    WindowGamepad pad = {.left = {1, 0}, .buttons = 1U << GLFW_GAMEPAD_BUTTON_A};
    take(button(GLFW_MOUSE_BUTTON_LEFT, GLFW_MOD_SHIFT, true));
    take(move(130, 80));
    take(key(GLFW_KEY_RIGHT, true));
    assert_true(input_busy(&input));
    assert_true(input_fill_hand(&input, &pad, 0.5, &hand, &asks) == 8);
    assert_true(hand.move_drag[0] == 15 && hand.move_drag[1] == 10);
    assert_true(hand.move_rate[0] == INPUT_KEY_RATE && hand.move_offset[0] > 0.9);
    assert_ptr_equal(next(REQUEST_ACTION).action, &action_box_home);
    hand = (HandInput){.dt = 0};
    assert_true(input_fill_hand(&input, &pad, 0.5, &hand, &asks) == 0);
    assert_true(hand.move_drag[0] == 0 && hand.move_rate[0] == INPUT_KEY_RATE);
    no_more(); /* the button is still down */
}

/* While touching, the right stick is the finger's, and a trigger is as good as a button, unless the mouse has
   something. */
static void a_trigger_touches(void **state)
{
    (void)state;
    HandInput hand = {.dt = 0};
    const WindowGamepad pad = {.right = {1, 0}};
    input_press(&input, 1);
    assert_false(input_touches(&input)); /* not while the mouse turns the camera */
    input.touching = true;
    input_press(&input, 0.51);
    assert_true(input.drag == &action_stir && input.pressed == 0.5);
    input_press(&input, -1);
    assert_true(input.drag == &action_pull && input.pressed == 1);
    input_fill_hand(&input, &pad, 0.5, &hand, &asks);
    assert_true(hand.tilt_offset[0] == 0);
    input_press(&input, 0);
    assert_null(input.drag);
    take(button(GLFW_MOUSE_BUTTON_LEFT, 0, true));
    input_press(&input, -1);
    assert_true(input.drag == &action_stir && input.pressed == 1);
    input_press(&input, 0);
    assert_ptr_equal(input.drag, &action_stir);
    take(button(GLFW_MOUSE_BUTTON_LEFT, 0, false));
    input.touching = false;
    input_fill_hand(&input, &pad, 0.5, &hand, &asks);
    assert_true(hand.tilt_offset[0] > 0.9);
}

static void a_lost_focus_lets_go_once(void **state)
{
    (void)state;
    const WindowEvent lost = {.kind = WINDOW_FOCUS};
    take(lost);
    no_more(); /* no key was held */
    take(key(GLFW_KEY_UP, true));
    take(lost);
    take(lost);
    next(REQUEST_STOP_BOX);
    no_more();
    assert_false(input_busy(&input));
}

/* Repeating commands are marked: a held step key counts only if no step is waiting. */
static void a_held_key_says_so(void **state)
{
    (void)state;
    take(key(GLFW_KEY_PERIOD, true));
    take(held_key(GLFW_KEY_PERIOD));
    take(held_key(GLFW_KEY_R));
    assert_false(next(REQUEST_ACTION).held);
    assert_true(next(REQUEST_ACTION).held);
    no_more();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(what_is_asked_waits_in_its_order, begin),
        cmocka_unit_test_setup(camera_moves_add_up_until_another_comes, begin),
        cmocka_unit_test_setup(a_full_queue_keeps_what_it_has_and_counts_the_rest, begin),
        cmocka_unit_test_setup(what_only_holds_asks_for_nothing, begin),
        cmocka_unit_test_setup(a_right_click_is_no_drag, begin),
        cmocka_unit_test_setup(what_is_held_moves_the_box, begin),
        cmocka_unit_test_setup(a_trigger_touches, begin),
        cmocka_unit_test_setup(a_lost_focus_lets_go_once, begin),
        cmocka_unit_test_setup(a_held_key_says_so, begin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
