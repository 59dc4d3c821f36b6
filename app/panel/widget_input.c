#include "app/panel/widget_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string.h>

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
typedef struct Taken {
    bool button[3], place, text;
    unsigned keys;
} Taken;

static unsigned ui_key(const WindowEvent *event)
{
    for (size_t i = 0; i < sizeof editing_keys / sizeof *editing_keys; i++)
        if (editing_keys[i].glfw == event->key)
            return editing_keys[i].ui;
    return 0;
}

static bool any_button(const Taken *taken)
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
static bool must_wait(const UiInput *now, const Taken *taken, const WindowEvent *event)
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

static void take_key(UiInput *now, const WindowEvent *event, Taken *taken)
{
    const unsigned key = ui_key(event);
    now->keys = event->down ? now->keys | key : now->keys & ~key;
    taken->keys |= key;
}

static void take_button(UiInput *now, const WindowEvent *event, Taken *taken)
{
    now->mouse[0] = (float)event->x;
    now->mouse[1] = (float)event->y;
    if (!is_button(event))
        return;
    now->button[event->button] = event->down;
    taken->button[event->button] = true;
}

static void take_text(UiInput *now, const WindowEvent *event, Taken *taken)
{
    const size_t used = strlen(now->text);
    if (event->codepoint >= 128 || used + 1 >= sizeof now->text)
        return;
    now->text[used] = (char)event->codepoint;
    now->text[used + 1] = 0;
    taken->text = true;
}

static void take(UiInput *now, const WindowEvent *event, Taken *taken)
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

static void take_first(WidgetInput *input, Taken *taken)
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
        take_first(input, &(Taken){.text = false});
    *at(input, input->count++) = *event;
}

static void forget(UiInput *now)
{
    now->wheel = 0;
    memset(now->text, 0, sizeof now->text);
}

void widget_input_next(WidgetInput *input)
{
    Taken taken = {.text = false};
    forget(&input->now);
    while (input->count > 0 && !must_wait(&input->now, &taken, at(input, 0)))
        take_first(input, &taken);
}

void widget_input_skip(WidgetInput *input)
{
    while (input->count > 0)
        take_first(input, &(Taken){.text = false});
    forget(&input->now);
}
