#include "app/window/shake.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <math.h>

static const double EVENT_MS = 8, SWING_HZ = 1.3, HEAVE_HZ = 0.7;

bool window_shake_next(WindowShake *script, double now_ms, int width, int height, WindowEvent *event)
{
    if (script->began_ms == 0)
        script->began_ms = now_ms;
    const double due = script->began_ms + EVENT_MS * (double)script->events;
    const double t = 1e-3 * (due - script->began_ms);
    if (due > now_ms)
        return false;
    *event = (WindowEvent){.kind = script->events == 0 ? WINDOW_BUTTON : WINDOW_MOVE,
                           .when_ms = due,
                           .down = true,
                           .button = GLFW_MOUSE_BUTTON_LEFT,
                           .modifiers = GLFW_MOD_SHIFT,
                           .x = width * (0.5 + 0.25 * sin(2 * M_PI * SWING_HZ * t)),
                           .y = height * (0.5 + 0.15 * sin(2 * M_PI * HEAVE_HZ * t))};
    script->events++;
    return true;
}
