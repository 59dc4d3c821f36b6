#include "app/play/input.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double CLICK_REACH = 3;      /* pixels */
static const double DRAG_TURN = 2 * M_PI; /* radians of a drag over the picture's height */

void input_begin(Input *input)
{
    *input = (Input){.drag = PLAY_NONE, .touching = input->touching};
}

static void hand_event(Input *input, const WindowEvent *event)
{
    if (input->hand_event_ms == 0)
        input->hand_event_ms = event->when_ms;
}

/* While touching, Shift and Ctrl still move the box. */
static PlayCommand touch_of(int button, int modifiers)
{
    if (button == GLFW_MOUSE_BUTTON_RIGHT)
        return PLAY_TOUCH_OTHER;
    const bool bare = !(modifiers & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL));
    return button == GLFW_MOUSE_BUTTON_LEFT && bare ? PLAY_TOUCH_DRAG : PLAY_NONE;
}

static PlayCommand drag_of(const Input *input, int button, int modifiers)
{
    const PlayCommand touch = input->touching ? touch_of(button, modifiers) : PLAY_NONE;
    if (touch != PLAY_NONE)
        return touch;
    if (button == GLFW_MOUSE_BUTTON_RIGHT || button == GLFW_MOUSE_BUTTON_MIDDLE)
        return PLAY_PAN;
    if (button != GLFW_MOUSE_BUTTON_LEFT)
        return PLAY_NONE;
    if (modifiers & GLFW_MOD_SHIFT && modifiers & GLFW_MOD_CONTROL)
        return PLAY_GRAVITY_DRAG;
    return modifiers & GLFW_MOD_SHIFT     ? PLAY_MOVE_DRAG
           : modifiers & GLFW_MOD_CONTROL ? PLAY_TURN_DRAG
                                          : PLAY_ORBIT;
}

enum { TRIGGER = -1 }; /* used as a mouse button's number */

void input_press(Input *input, double press)
{
    static const double STEPS = 16; /* avoids new commands for a trembling finger */
    const double by = round(STEPS * fmin(fabs(press), 1)) / STEPS;
    const bool has = input_touches(input) && input->drag_button == TRIGGER;
    if (!has && (!input->touching || input->drag != PLAY_NONE || !(by > 0)))
        return;
    input->drag = by > 0 ? (press > 0 ? PLAY_TOUCH_DRAG : PLAY_TOUCH_OTHER) : PLAY_NONE;
    input->drag_button = TRIGGER;
    input->pressed = by;
}

bool input_touches(const Input *input)
{
    return input->drag == PLAY_TOUCH_DRAG || input->drag == PLAY_TOUCH_OTHER;
}

/* True for drags that act only between two pictures. */
static bool drags_slowly(const Input *input)
{
    return input->drag == PLAY_PAN || input->drag == PLAY_ORBIT || input->drag == PLAY_GRAVITY_DRAG;
}

static void on_button(Input *input, const WindowEvent *event, AskQueue *asks)
{
    if (!event->down && event->button == input->drag_button) { /* never for a trigger */
        if (input->drag == PLAY_PAN && !input->grabbed && event->button == GLFW_MOUSE_BUTTON_RIGHT)
            ask_command(asks, PLAY_TRAIL);
        input->drag = PLAY_NONE;
    }
    if (!event->down || input->drag != PLAY_NONE)
        return;
    input->drag = drag_of(input, event->button, event->modifiers);
    input->drag_button = event->button;
    input->pressed = 1;
    memcpy(input->mouse, (double[]){event->x, event->y}, sizeof input->mouse);
    input->grabbed = input->drag == PLAY_ORBIT;
    if (input->grabbed)
        ask_add(asks, &(Ask){.kind = ASK_GRAB});
    if (input_touches(input))
        hand_event(input, event);
}

/* A right click becomes a drag once the mouse has moved away. */
static bool is_still_a_click(Input *input, const WindowEvent *event, AskQueue *asks)
{
    if (input->drag != PLAY_PAN || input->grabbed)
        return false;
    if (hypot(event->x - input->mouse[0], event->y - input->mouse[1]) < CLICK_REACH)
        return true;
    input->grabbed = true;
    ask_add(asks, &(Ask){.kind = ASK_GRAB});
    return false;
}

static void on_move(Input *input, const WindowEvent *event, int height, AskQueue *asks)
{
    if (is_still_a_click(input, event, asks))
        return;
    const double right = event->x - input->mouse[0], up = input->mouse[1] - event->y;
    const double per_height = 1.0 / fmax(height, 1);
    const double turn[2] = {DRAG_TURN * right * per_height, DRAG_TURN * up * per_height};
    memcpy(input->mouse, (double[]){event->x, event->y}, sizeof input->mouse);
    switch (input->drag) {
    case PLAY_ORBIT:
        ask_add(asks, &(Ask){.kind = ASK_TURN, .amount = {turn[0], turn[1]}});
        break;
    case PLAY_PAN:
        ask_add(asks, &(Ask){.kind = ASK_PAN, .amount = {right * per_height, up * per_height}});
        break;
    case PLAY_GRAVITY_DRAG:
        ask_add(asks, &(Ask){.kind = ASK_GRAVITY, .amount = {turn[0], turn[1]}});
        break;
    case PLAY_MOVE_DRAG:
        input->move_drag[0] += right;
        input->move_drag[1] += up;
        hand_event(input, event);
        break;
    case PLAY_TURN_DRAG:
        input->turn_drag[0] += turn[0];
        input->turn_drag[1] += turn[1];
        hand_event(input, event);
        break;
    case PLAY_TOUCH_DRAG:
    case PLAY_TOUCH_OTHER:
        hand_event(input, event);
        break;
    default:
        break;
    }
}

static bool is_held_key(int key)
{
    for (const PlayHeldKey *held = play_held_keys; held->key; held++)
        if (held->key == key)
            return true;
    return false;
}

static PlayCommand command_of(const WindowEvent *event)
{
    const PlayCommand command = event->down ? play_command_of_key(event->key, event->modifiers) : PLAY_NONE;
    const bool once = command != PLAY_NONE && !(play_command_rows[command].flags & PLAY_REPEATS);
    return event->repeated && once ? PLAY_NONE : command;
}

static void on_key(Input *input, const WindowEvent *event, AskQueue *asks)
{
    if (event->key < 0 || event->key >= INPUT_KEYS)
        return;
    input->down[event->key] = event->down;
    if (is_held_key(event->key) && !event->repeated)
        hand_event(input, event);
    const PlayCommand command = command_of(event);
    if (command != PLAY_NONE)
        ask_add(asks, &(Ask){.kind = ASK_COMMAND, .command = command, .held = event->repeated});
}

bool input_holds_box(const Input *input)
{
    bool holds = input->drag == PLAY_MOVE_DRAG || input->drag == PLAY_TURN_DRAG;
    for (const PlayHeldKey *held = play_held_keys; held->key; held++)
        holds |= input->down[held->key];
    return holds;
}

bool input_busy(const Input *input)
{
    return input->drag != PLAY_NONE || input_holds_box(input);
}

/* Losing the focus releases all keys and drags. */
static void on_focus(Input *input, const WindowEvent *event, AskQueue *asks)
{
    if (event->down)
        return;
    if (input_holds_box(input))
        ask_add(asks, &(Ask){.kind = ASK_LET_GO});
    memset(input->down, 0, sizeof input->down);
    memset(input->move_drag, 0, sizeof input->move_drag);
    memset(input->turn_drag, 0, sizeof input->turn_drag);
    input->drag = PLAY_NONE;
}

static void on_drop(const WindowEvent *event, AskQueue *asks)
{
    Ask ask = {.kind = ASK_OPEN};
    snprintf(ask.text, sizeof ask.text, "%s", event->path);
    ask_add(asks, &ask);
}

static int modifiers_of(const bool *down)
{
    const bool shift = down[GLFW_KEY_LEFT_SHIFT] || down[GLFW_KEY_RIGHT_SHIFT];
    const bool control = down[GLFW_KEY_LEFT_CONTROL] || down[GLFW_KEY_RIGHT_CONTROL];
    return (shift ? GLFW_MOD_SHIFT : 0) | (control ? GLFW_MOD_CONTROL : 0);
}

/* Some systems report a sideways wheel while Shift is down. */
static void on_wheel(const Input *input, const WindowEvent *event, AskQueue *asks)
{
    const bool shift = modifiers_of(input->down) & GLFW_MOD_SHIFT;
    const double notches = event->y != 0 ? event->y : event->x;
    if (!input->touching)
        ask_add(asks, &(Ask){.kind = ASK_ZOOM, .amount = {event->y}});
    else
        ask_add(asks, &(Ask){.kind = ASK_TOUCH, .amount = {shift ? 0 : notches, shift ? notches : 0}});
}

void input_take(Input *input, const WindowEvent *event, int height, AskQueue *asks)
{
    switch (event->kind) {
    case WINDOW_KEY:
        on_key(input, event, asks);
        break;
    case WINDOW_BUTTON:
        on_button(input, event, asks);
        break;
    case WINDOW_MOVE:
        on_move(input, event, height, asks);
        break;
    case WINDOW_WHEEL:
        on_wheel(input, event, asks);
        break;
    case WINDOW_FOCUS:
        on_focus(input, event, asks);
        break;
    case WINDOW_DROP:
        on_drop(event, asks);
        break;
    case WINDOW_CLOSE:
        ask_add(asks, &(Ask){.kind = ASK_CLOSE});
        break;
    case WINDOW_RESIZE:
    case WINDOW_EXPOSE:
    case WINDOW_TEXT:
        break;
    }
}

bool input_only_holds(const Input *input, const WindowEvent *event)
{
    if (event->kind == WINDOW_MOVE)
        return !drags_slowly(input);
    return event->kind == WINDOW_KEY && command_of(event) == PLAY_NONE;
}

static void add_drags(Input *input, double metres, HandInput *hand)
{
    for (int k = 0; k < 2; k++) {
        hand->move_drag[k] = metres * input->move_drag[k];
        hand->turn_drag[k] = input->turn_drag[k];
        input->move_drag[k] = input->turn_drag[k] = 0;
    }
}

static void add_keys(const Input *input, HandInput *hand)
{
    const int modifiers = modifiers_of(input->down);
    for (const PlayHeldKey *held = play_held_keys; held->key; held++)
        if (input->down[held->key] && held->modifiers == modifiers)
            (held->command == PLAY_MOVE_KEYS ? hand->move_rate : hand->tilt_rate)[held->axis] += held->sign;
}

/* GLFW's y axis of a stick points down. */
static void add_gamepad(Input *input, const WindowGamepad *pad, HandInput *hand, AskQueue *asks)
{
    double left[2], right[2];
    hand_stick(pad->left, left);
    hand_stick(pad->right, right);
    hand->move_offset[0] += left[0];
    hand->move_offset[2] -= left[1];
    if (!input->touching) { /* otherwise the right stick moves the finger: app/play/hands.c */
        hand->tilt_offset[0] += right[0];
        hand->tilt_offset[1] -= right[1];
    }
    const unsigned pressed = pad->buttons & ~input->pad_buttons;
    for (int button = 0; button <= GLFW_GAMEPAD_BUTTON_LAST; button++) {
        const PlayCommand command = pressed >> button & 1 ? play_command_of_gamepad(button) : PLAY_NONE;
        if (command != PLAY_NONE)
            ask_command(asks, command);
    }
}

double input_hand(Input *input, const WindowGamepad *pad, double metres, HandInput *hand, AskQueue *asks)
{
    const double event_ms = input->hand_event_ms;
    add_drags(input, metres, hand);
    add_keys(input, hand);
    if (pad)
        add_gamepad(input, pad, hand, asks);
    input->pad_buttons = pad ? pad->buttons : 0;
    input->hand_event_ms = 0;
    return event_ms;
}
