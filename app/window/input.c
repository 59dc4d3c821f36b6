#include "app/window/window.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

/* True if both may be done as one request with the sum of their amounts. */
static bool add_up(const Request *a, const Request *b)
{
    return a->kind == b->kind &&
           (a->kind == REQUEST_STEER_CAMERA ||
            (a->kind == REQUEST_ACTION && a->action == b->action && a->action->flags & ACTION_ADDS_UP));
}

void request_add(RequestQueue *queue, const Request *request)
{
    Request *last = &queue->requests[(queue->first + queue->count + REQUESTS_MAX - 1) % REQUESTS_MAX];
    if (queue->count > 0 && add_up(last, request)) {
        for (int k = 0; k < 3; k++)
            last->amount[k] += request->amount[k];
        return;
    }
    if (queue->count < REQUESTS_MAX)
        queue->requests[(queue->first + queue->count++) % REQUESTS_MAX] = *request;
    else
        queue->lost++;
}

int requests_lost(RequestQueue *queue)
{
    const int lost = queue->lost;
    queue->lost = 0;
    return lost;
}

void request_add_action(RequestQueue *queue, const UserAction *action)
{
    request_add(queue, &(Request){.kind = REQUEST_ACTION, .action = action});
}

void request_add_settings(RequestQueue *queue, const ViewSetting *settings, int count)
{
    for (int i = 0; i < count; i++) {
        Request request = {.kind = REQUEST_SETTING};
        snprintf(request.text, sizeof request.text, "%s", settings[i].text);
        request_add(queue, &request);
    }
}

bool request_next(RequestQueue *queue, Request *request)
{
    if (queue->count == 0)
        return false;
    *request = queue->requests[queue->first];
    queue->first = (queue->first + 1) % REQUESTS_MAX;
    queue->count--;
    return true;
}

static const double CLICK_REACH = 3;      /* pixels */
static const double DRAG_TURN = 2 * M_PI; /* radians of a drag over the picture's height */

void input_begin(PlayInput *input)
{
    *input = (PlayInput){.drag = NULL, .touching = input->touching};
}

static void hand_event(PlayInput *input, const WindowEvent *event)
{
    if (input->hand_event_ms == 0)
        input->hand_event_ms = event->when_ms;
}

/* While touching, Shift and Ctrl still move the box. */
static const UserAction *touch_of(int button, int modifiers)
{
    if (button == GLFW_MOUSE_BUTTON_RIGHT)
        return &action_pull;
    const bool bare = !(modifiers & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL));
    return button == GLFW_MOUSE_BUTTON_LEFT && bare ? &action_stir : NULL;
}

static const UserAction *drag_of(const PlayInput *input, int button, int modifiers)
{
    const UserAction *touch = input->touching ? touch_of(button, modifiers) : NULL;
    if (touch)
        return touch;
    if (button == GLFW_MOUSE_BUTTON_RIGHT || button == GLFW_MOUSE_BUTTON_MIDDLE)
        return &action_pan;
    if (button != GLFW_MOUSE_BUTTON_LEFT)
        return NULL;
    if (modifiers & GLFW_MOD_SHIFT && modifiers & GLFW_MOD_CONTROL)
        return &action_tilt_gravity;
    return modifiers & GLFW_MOD_SHIFT     ? &action_move_box
           : modifiers & GLFW_MOD_CONTROL ? &action_turn_box
                                          : &action_orbit;
}

enum { TRIGGER = -1 }; /* used as a mouse button's number */

void input_press(PlayInput *input, double press)
{
    static const double STEPS = 16; /* avoids new commands for a trembling finger */
    const double by = round(STEPS * fmin(fabs(press), 1)) / STEPS;
    const bool has = input_touches(input) && input->drag_button == TRIGGER;
    if (!has && (!input->touching || input->drag || !(by > 0)))
        return;
    input->drag = by > 0 ? (press > 0 ? &action_stir : &action_pull) : NULL;
    input->drag_button = TRIGGER;
    input->pressed = by;
}

bool input_touches(const PlayInput *input)
{
    return input->drag && input->drag->drag == DRAG_TOUCHES;
}

/* True for drags that act only between two pictures. */
static bool drags_slowly(const PlayInput *input)
{
    return input->drag && (input->drag->drag == DRAG_HEIGHTS || input->drag->drag == DRAG_RADIANS);
}

static void on_button(PlayInput *input, const WindowEvent *event, RequestQueue *requests)
{
    if (!event->down && event->button == input->drag_button) { /* never for a trigger */
        if (input->drag == &action_pan && !input->grabbed && event->button == GLFW_MOUSE_BUTTON_RIGHT)
            request_add_action(requests, &action_trail);
        input->drag = NULL;
    }
    if (!event->down || input->drag)
        return;
    input->drag = drag_of(input, event->button, event->modifiers);
    input->drag_button = event->button;
    input->pressed = 1;
    memcpy(input->mouse, (double[]){event->x, event->y}, sizeof input->mouse);
    input->grabbed = input->drag == &action_orbit;
    if (input->grabbed)
        request_add(requests, &(Request){.kind = REQUEST_GRAB_CAMERA});
    if (input_touches(input))
        hand_event(input, event);
}

/* A right click becomes a drag once the mouse has moved away. */
static bool is_still_a_click(PlayInput *input, const WindowEvent *event, RequestQueue *requests)
{
    if (input->drag != &action_pan || input->grabbed)
        return false;
    if (hypot(event->x - input->mouse[0], event->y - input->mouse[1]) < CLICK_REACH)
        return true;
    input->grabbed = true;
    request_add(requests, &(Request){.kind = REQUEST_GRAB_CAMERA});
    return false;
}

static void on_move(PlayInput *input, const WindowEvent *event, int height, RequestQueue *requests)
{
    if (is_still_a_click(input, event, requests))
        return;
    const double right = event->x - input->mouse[0], up = input->mouse[1] - event->y;
    const double per_height = 1.0 / fmax(height, 1);
    const double turn[2] = {DRAG_TURN * right * per_height, DRAG_TURN * up * per_height};
    Request request = {.kind = REQUEST_ACTION, .action = input->drag, .amount = {turn[0], turn[1]}};
    memcpy(input->mouse, (double[]){event->x, event->y}, sizeof input->mouse);
    switch (input->drag ? input->drag->drag : DRAG_NONE) {
    case DRAG_HEIGHTS:
        request.amount[0] = right * per_height;
        request.amount[1] = up * per_height;
        request_add(requests, &request);
        break;
    case DRAG_RADIANS:
        request_add(requests, &request);
        break;
    case DRAG_MOVES:
        input->move_drag[0] += right;
        input->move_drag[1] += up;
        hand_event(input, event);
        break;
    case DRAG_TURNS:
        input->turn_drag[0] += turn[0];
        input->turn_drag[1] += turn[1];
        hand_event(input, event);
        break;
    case DRAG_TOUCHES:
        hand_event(input, event);
        break;
    case DRAG_NONE:
        break;
    }
}

static bool is_held_key(int number)
{
    const HeldKey *key;
    for (int i = 0; (key = user_action_held_key(i)); i++)
        if (key->key == number)
            return true;
    return false;
}

static const UserAction *action_of(const WindowEvent *event)
{
    const UserAction *action = event->down ? user_action_of_key(event->key, event->modifiers) : NULL;
    const bool once = action && !(action->flags & ACTION_REPEATS);
    return event->repeated && once ? NULL : action;
}

static void on_key(PlayInput *input, const WindowEvent *event, RequestQueue *requests)
{
    if (event->key < 0 || event->key >= INPUT_KEYS)
        return;
    input->down[event->key] = event->down;
    if (is_held_key(event->key) && !event->repeated)
        hand_event(input, event);
    const UserAction *action = action_of(event);
    if (action)
        request_add(requests, &(Request){.kind = REQUEST_ACTION, .action = action, .held = event->repeated});
}

bool input_holds_box(const PlayInput *input)
{
    const ActionDrag drag = input->drag ? input->drag->drag : DRAG_NONE;
    bool holds = drag == DRAG_MOVES || drag == DRAG_TURNS;
    const HeldKey *key;
    for (int i = 0; (key = user_action_held_key(i)); i++)
        holds |= input->down[key->key];
    return holds;
}

bool input_busy(const PlayInput *input)
{
    return input->drag || input_holds_box(input);
}

/* Losing the focus releases all keys and drags. */
static void on_focus(PlayInput *input, const WindowEvent *event, RequestQueue *requests)
{
    if (event->down)
        return;
    if (input_holds_box(input))
        request_add(requests, &(Request){.kind = REQUEST_STOP_BOX});
    memset(input->down, 0, sizeof input->down);
    memset(input->move_drag, 0, sizeof input->move_drag);
    memset(input->turn_drag, 0, sizeof input->turn_drag);
    input->drag = NULL;
}

static void on_drop(const WindowEvent *event, RequestQueue *requests)
{
    Request request = {.kind = REQUEST_OPEN_SCENE};
    snprintf(request.text, sizeof request.text, "%s", event->path);
    request_add(requests, &request);
}

static int modifiers_of(const bool *down)
{
    const bool shift = down[GLFW_KEY_LEFT_SHIFT] || down[GLFW_KEY_RIGHT_SHIFT];
    const bool control = down[GLFW_KEY_LEFT_CONTROL] || down[GLFW_KEY_RIGHT_CONTROL];
    return (shift ? GLFW_MOD_SHIFT : 0) | (control ? GLFW_MOD_CONTROL : 0);
}

/* Some systems report a sideways wheel while Shift is down. */
static void on_wheel(const PlayInput *input, const WindowEvent *event, RequestQueue *requests)
{
    const bool shift = modifiers_of(input->down) & GLFW_MOD_SHIFT;
    const double notches = event->y != 0 ? event->y : event->x;
    Request request = {.kind = REQUEST_ACTION, .action = &action_zoom, .amount = {event->y}};
    if (input->touching) {
        request.action = shift ? &action_touch_strength : &action_touch_size;
        request.amount[0] = notches;
    }
    request_add(requests, &request);
}

void input_event(PlayInput *input, const WindowEvent *event, int height, RequestQueue *requests)
{
    switch (event->kind) {
    case WINDOW_KEY:
        on_key(input, event, requests);
        break;
    case WINDOW_BUTTON:
        on_button(input, event, requests);
        break;
    case WINDOW_MOVE:
        on_move(input, event, height, requests);
        break;
    case WINDOW_WHEEL:
        on_wheel(input, event, requests);
        break;
    case WINDOW_FOCUS:
        on_focus(input, event, requests);
        break;
    case WINDOW_DROP:
        on_drop(event, requests);
        break;
    case WINDOW_CLOSE:
        request_add_action(requests, &action_quit);
        break;
    case WINDOW_RESIZE:
    case WINDOW_EXPOSE:
    case WINDOW_TEXT:
        break;
    }
}

bool input_only_holds(const PlayInput *input, const WindowEvent *event)
{
    if (event->kind == WINDOW_MOVE)
        return !drags_slowly(input);
    return event->kind == WINDOW_KEY && !action_of(event);
}

static void add_drags(PlayInput *input, double metres, HandInput *hand)
{
    for (int k = 0; k < 2; k++) {
        hand->move_drag[k] = metres * input->move_drag[k];
        hand->turn_drag[k] = input->turn_drag[k];
        input->move_drag[k] = input->turn_drag[k] = 0;
    }
}

static void add_keys(const PlayInput *input, HandInput *hand)
{
    const int modifiers = modifiers_of(input->down);
    const HeldKey *key;
    for (int i = 0; (key = user_action_held_key(i)); i++)
        if (input->down[key->key] && key->modifiers == modifiers)
            *(double *)(void *)((char *)hand + key->rate) += INPUT_KEY_RATE * key->sign;
}

/* GLFW's y axis of a stick points down. */
static void add_gamepad(PlayInput *input, const WindowGamepad *pad, HandInput *hand, RequestQueue *requests)
{
    double left[2], right[2];
    hand_stick(pad->left, left);
    hand_stick(pad->right, right);
    hand->move_offset[0] += left[0];
    hand->move_offset[2] -= left[1];
    if (!input->touching) { /* otherwise the right stick moves the finger: app/window/hand_input.c */
        hand->tilt_offset[0] += right[0];
        hand->tilt_offset[1] -= right[1];
    }
    const unsigned pressed = pad->buttons & ~input->pad_buttons;
    for (int button = 0; button <= GLFW_GAMEPAD_BUTTON_LAST; button++) {
        const UserAction *action = pressed >> button & 1 ? user_action_of_gamepad(button) : NULL;
        if (action)
            request_add_action(requests, action);
    }
}

double input_fill_hand(PlayInput *input, const WindowGamepad *pad, double metres, HandInput *hand,
                       RequestQueue *requests)
{
    const double event_ms = input->hand_event_ms;
    add_drags(input, metres, hand);
    add_keys(input, hand);
    if (pad)
        add_gamepad(input, pad, hand, requests);
    input->pad_buttons = pad ? pad->buttons : 0;
    input->hand_event_ms = 0;
    return event_ms;
}

typedef struct EditingKey {
    int glfw;
    unsigned ui;
} EditingKey;

static const EditingKey editing_keys[] = {
    {GLFW_KEY_ENTER, UI_KEY_ENTER},
    {GLFW_KEY_KP_ENTER, UI_KEY_ENTER},
    {GLFW_KEY_ESCAPE, UI_KEY_ESCAPE},
    {GLFW_KEY_BACKSPACE, UI_KEY_BACKSPACE},
    {GLFW_KEY_DELETE, UI_KEY_DELETE},
    {GLFW_KEY_LEFT, UI_KEY_LEFT},
    {GLFW_KEY_RIGHT, UI_KEY_RIGHT},
    {GLFW_KEY_HOME, UI_KEY_HOME},
    {GLFW_KEY_END, UI_KEY_END},
    {GLFW_KEY_TAB, UI_KEY_TAB},
    {GLFW_KEY_A, UI_KEY_A},
    {GLFW_KEY_C, UI_KEY_C},
    {GLFW_KEY_V, UI_KEY_V},
    {GLFW_KEY_X, UI_KEY_X},
    {GLFW_KEY_LEFT_CONTROL, UI_KEY_CTRL},
    {GLFW_KEY_RIGHT_CONTROL, UI_KEY_CTRL},
    {GLFW_KEY_LEFT_SHIFT, UI_KEY_SHIFT},
    {GLFW_KEY_RIGHT_SHIFT, UI_KEY_SHIFT},
};

/* Input already taken for the picture. */
typedef struct EventKeys {
    bool button[3], place, text;
    unsigned keys;
} EventKeys;

static unsigned ui_key(const WindowEvent *event)
{
    for (size_t i = 0; i < sizeof editing_keys / sizeof *editing_keys; i++)
        if (editing_keys[i].glfw == event->key)
            return editing_keys[i].ui;
    return 0;
}

static bool any_button(const EventKeys *taken)
{
    return taken->button[0] || taken->button[1] || taken->button[2];
}

static bool is_button(const WindowEvent *event)
{
    return event->button >= 0 && event->button < 3;
}

static bool moves(const UiInput *now, const WindowEvent *event)
{
    return now->mouse[0] != (float)event->x || now->mouse[1] != (float)event->y;
}

/* Keeps the order of letters and editing keys, and lets a slider reach its place before the release. */
static bool must_wait(const UiInput *now, const EventKeys *taken, const WindowEvent *event)
{
    const unsigned modifiers = UI_KEY_CTRL | UI_KEY_SHIFT;
    switch (event->kind) {
    case WINDOW_BUTTON:
        return is_button(event) && (taken->button[event->button] || (taken->place && !event->down));
    case WINDOW_MOVE:
        return any_button(taken) && moves(now, event);
    case WINDOW_WHEEL:
        return any_button(taken);
    case WINDOW_KEY:
        return (taken->keys | (taken->text ? ~modifiers : 0)) & ui_key(event);
    case WINDOW_TEXT:
        return taken->keys & ~modifiers;
    default:
        return false;
    }
}

static void take_key(UiInput *now, const WindowEvent *event, EventKeys *taken)
{
    const unsigned key = ui_key(event);
    now->keys = event->down ? now->keys | key : now->keys & ~key;
    taken->keys |= key;
}

static void take_button(UiInput *now, const WindowEvent *event, EventKeys *taken)
{
    now->mouse[0] = (float)event->x;
    now->mouse[1] = (float)event->y;
    if (!is_button(event))
        return;
    now->button[event->button] = event->down;
    taken->button[event->button] = true;
}

static void take_text(UiInput *now, const WindowEvent *event, EventKeys *taken)
{
    const size_t used = strlen(now->text);
    if (event->codepoint >= 128 || used + 1 >= sizeof now->text)
        return;
    now->text[used] = (char)event->codepoint;
    now->text[used + 1] = 0;
    taken->text = true;
}

static void take(UiInput *now, const WindowEvent *event, EventKeys *taken)
{
    switch (event->kind) {
    case WINDOW_BUTTON:
        take_button(now, event, taken);
        break;
    case WINDOW_MOVE:
        taken->place |= moves(now, event);
        now->mouse[0] = (float)event->x;
        now->mouse[1] = (float)event->y;
        break;
    case WINDOW_WHEEL:
        now->wheel += (float)event->y;
        break;
    case WINDOW_KEY:
        take_key(now, event, taken);
        break;
    case WINDOW_TEXT:
        take_text(now, event, taken);
        break;
    default:
        break;
    }
}

static WindowEvent *at(WidgetInput *input, int place)
{
    return &input->events[(input->first + place) % WIDGET_EVENTS_MAX];
}

static void take_first(WidgetInput *input, EventKeys *taken)
{
    take(&input->now, at(input, 0), taken);
    input->first = (input->first + 1) % WIDGET_EVENTS_MAX;
    input->count--;
}

static bool is_for_widgets(const WindowEvent *event)
{
    if (event->kind == WINDOW_KEY)
        return ui_key(event) && !event->repeated; /* widgets repeat held keys themselves */
    return event->kind == WINDOW_BUTTON || event->kind == WINDOW_MOVE || event->kind == WINDOW_WHEEL ||
           event->kind == WINDOW_TEXT;
}

void widget_input_add(WidgetInput *input, const WindowEvent *event)
{
    if (!is_for_widgets(event))
        return;
    if (event->kind == WINDOW_MOVE && input->count > 0 && at(input, input->count - 1)->kind == WINDOW_MOVE) {
        *at(input, input->count - 1) = *event;
        return;
    }
    if (input->count == WIDGET_EVENTS_MAX)
        take_first(input, &(EventKeys){.text = false});
    *at(input, input->count++) = *event;
}

static void forget(UiInput *now)
{
    now->wheel = 0;
    memset(now->text, 0, sizeof now->text);
}

void widget_input_next(WidgetInput *input)
{
    EventKeys taken = {.text = false};
    forget(&input->now);
    while (input->count > 0 && !must_wait(&input->now, &taken, at(input, 0)))
        take_first(input, &taken);
}

void widget_input_skip(WidgetInput *input)
{
    while (input->count > 0)
        take_first(input, &(EventKeys){.text = false});
    forget(&input->now);
}
