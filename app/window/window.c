#define _GNU_SOURCE /* POLLRDHUP, RTLD_DEFAULT */
#include "app/window/window.h"

#include "sim/world.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <dlfcn.h>
#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EVENTS_MAX = 256 };

struct Window {
    GLFWwindow *glfw;
    int first, count;
    WindowEvent events[EVENTS_MAX]; /* a ring */
    int place[4];                   /* x, y, width, height before full screen, in screen coordinates */
    bool full;
    double mouse[2]; /* position of the last move, screen coordinates */
    bool mouse_known;
    WindowClaimed *claimed; /* NULL: no device is claimed */
    void *claimer;
    char renderer[256];
    int connection; /* file descriptor of the display; -1: unknown */
    bool gone;      /* the display is gone */
    void (*when_gone)(void *user);
    void *of_gone;
    pthread_t thread; /* the main thread */
};

static char last_reason[256];

static void on_error(int code, const char *text)
{
    (void)code;
    snprintf(last_reason, sizeof last_reason, "%s", text);
}

/* Adds an event. A full queue drops repeating events in favour of events that must not be lost: releases,
   closing. */
static void append(Window *window, const WindowEvent *event)
{
    const bool repeats = event->repeated || event->kind == WINDOW_TEXT || event->kind == WINDOW_WHEEL;
    if (repeats && window->count > EVENTS_MAX / 2)
        return;
    if (window->count == EVENTS_MAX) /* unread for long: the oldest events are stale */
        window->first = (window->first + 1) % EVENTS_MAX, window->count--;
    WindowEvent *place = &window->events[(window->first + window->count++) % EVENTS_MAX];
    *place = *event;
    place->when_ms = wall_ms();
}

/* Pixels per screen coordinate: more than 1 on some systems with dense displays. */
static double density(GLFWwindow *glfw)
{
    int width, height, pixels, lines;
    glfwGetWindowSize(glfw, &width, &height);
    glfwGetFramebufferSize(glfw, &pixels, &lines);
    return width > 0 ? (double)pixels / width : 1;
}

static void on_key(GLFWwindow *glfw, int key, int scancode, int action, int modifiers)
{
    const char *label = glfwGetKeyName(key, scancode);
    WindowEvent event = {.kind = WINDOW_KEY,
                         .key = key,
                         .modifiers = modifiers,
                         .down = action != GLFW_RELEASE,
                         .repeated = action == GLFW_REPEAT};
    snprintf(event.label, sizeof event.label, "%s", label ? label : "");
    append(glfwGetWindowUserPointer(glfw), &event);
}

static void on_text(GLFWwindow *glfw, unsigned codepoint)
{
    append(glfwGetWindowUserPointer(glfw), &(WindowEvent){.kind = WINDOW_TEXT, .codepoint = codepoint});
}

/* Uses the mouse position at the press: glfwGetCursorPos gives the present position, long after the press
   when a picture is slow. */
static void on_button(GLFWwindow *glfw, int button, int action, int modifiers)
{
    Window *window = glfwGetWindowUserPointer(glfw);
    const double scale = density(glfw);
    double at[2] = {window->mouse[0], window->mouse[1]};
    if (!window->mouse_known)
        glfwGetCursorPos(glfw, &at[0], &at[1]);
    append(window, &(WindowEvent){.kind = WINDOW_BUTTON,
                                  .button = button,
                                  .modifiers = modifiers,
                                  .down = action == GLFW_PRESS,
                                  .x = at[0] * scale,
                                  .y = at[1] * scale});
}

/* Merges moves, as a mouse may report a thousand positions per second: the last is enough. */
static void on_move(GLFWwindow *glfw, double x, double y)
{
    Window *window = glfwGetWindowUserPointer(glfw);
    const double scale = density(glfw);
    window->mouse[0] = x, window->mouse[1] = y;
    window->mouse_known = true;
    WindowEvent *last = &window->events[(window->first + window->count + EVENTS_MAX - 1) % EVENTS_MAX];
    if (window->count > 0 && last->kind == WINDOW_MOVE)
        last->x = x * scale, last->y = y * scale;
    else
        append(window, &(WindowEvent){.kind = WINDOW_MOVE, .x = x * scale, .y = y * scale});
}

static void on_wheel(GLFWwindow *glfw, double x, double y)
{
    append(glfwGetWindowUserPointer(glfw), &(WindowEvent){.kind = WINDOW_WHEEL, .x = x, .y = y});
}

static void on_focus(GLFWwindow *glfw, int focused)
{
    append(glfwGetWindowUserPointer(glfw), &(WindowEvent){.kind = WINDOW_FOCUS, .down = focused});
}

static void on_resize(GLFWwindow *glfw, int width, int height)
{
    (void)width, (void)height;
    append(glfwGetWindowUserPointer(glfw), &(WindowEvent){.kind = WINDOW_RESIZE});
}

static void on_scale(GLFWwindow *glfw, float x, float y)
{
    (void)x, (void)y;
    on_resize(glfw, 0, 0);
}

static void on_expose(GLFWwindow *glfw)
{
    append(glfwGetWindowUserPointer(glfw), &(WindowEvent){.kind = WINDOW_EXPOSE});
}

static void on_drop(GLFWwindow *glfw, int count, const char *paths[])
{
    WindowEvent event = {.kind = WINDOW_DROP};
    if (count < 1)
        return;
    snprintf(event.path, sizeof event.path, "%s", paths[0]);
    append(glfwGetWindowUserPointer(glfw), &event);
}

static void on_close(GLFWwindow *glfw)
{
    append(glfwGetWindowUserPointer(glfw), &(WindowEvent){.kind = WINDOW_CLOSE});
}

static void listen(Window *window)
{
    GLFWwindow *glfw = window->glfw;
    glfwSetWindowUserPointer(glfw, window);
    glfwSetKeyCallback(glfw, on_key);
    glfwSetCharCallback(glfw, on_text);
    glfwSetMouseButtonCallback(glfw, on_button);
    glfwSetCursorPosCallback(glfw, on_move);
    glfwSetScrollCallback(glfw, on_wheel);
    glfwSetWindowFocusCallback(glfw, on_focus);
    glfwSetFramebufferSizeCallback(glfw, on_resize);
    glfwSetWindowContentScaleCallback(glfw, on_scale);
    glfwSetWindowRefreshCallback(glfw, on_expose);
    glfwSetDropCallback(glfw, on_drop);
    glfwSetWindowCloseCallback(glfw, on_close);
}

static GLFWwindow *open_with(int api, const char *title, int width, int height)
{
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, api);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0); /* pictures have a depth buffer of their own */
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "slosh");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "slosh");
    return glfwCreateWindow(width, height, title, NULL, NULL);
}

/* ---- connection to the display ---- */

/* Looked up by name, as GLFW is built for X11 or for Wayland. */
typedef void *GetDisplay(void);
typedef int GetNumber(void *display);
typedef int OnError(void *display);
typedef void OnExit(void *display, void *user);

/* Replaces the library's own error message. */
static int say_nothing(void *display)
{
    (void)display;
    return 0;
}

/* Called instead of exit(1). */
static void on_gone(void *display, void *of_window)
{
    Window *window = of_window;
    (void)display;
    window->gone = true;
    if (window->when_gone && pthread_equal(pthread_self(), window->thread))
        window->when_gone(window->of_gone);
}

static void find_connection(Window *window)
{
    GetDisplay *x11 = (GetDisplay *)dlsym(RTLD_DEFAULT, "glfwGetX11Display");
    GetDisplay *wayland = (GetDisplay *)dlsym(RTLD_DEFAULT, "glfwGetWaylandDisplay");
    void *display = x11 ? x11() : wayland ? wayland() : NULL;
    GetNumber *number = (GetNumber *)dlsym(RTLD_DEFAULT, x11 ? "XConnectionNumber" : "wl_display_get_fd");
    void (*set_error)(OnError *) = (void (*)(OnError *))dlsym(RTLD_DEFAULT, "XSetIOErrorHandler");
    void (*set_exit)(void *, OnExit *, void *) =
        (void (*)(void *, OnExit *, void *))dlsym(RTLD_DEFAULT, "XSetIOErrorExitHandler");
    window->thread = pthread_self();
    window->connection = display && number ? number(display) : -1;
    if (x11 && display && set_error && set_exit) {
        set_error(say_nothing);
        set_exit(display, on_gone, window);
    }
}

bool window_gone(Window *window)
{
    struct pollfd on = {.fd = window->connection, .events = POLLRDHUP};
    window->gone |= poll(&on, 1, 0) > 0;
    return window->gone;
}

int window_connection(const Window *window)
{
    return window->connection;
}

void window_when_gone(Window *window, void (*gone)(void *user), void *user)
{
    window->when_gone = gone;
    window->of_gone = user;
}

static bool open_window(Window *window, const char *title, int width, int height, Error *error)
{
    window->glfw = open_with(GLFW_EGL_CONTEXT_API, title, width, height);
    if (!window->glfw)
        window->glfw = open_with(GLFW_NATIVE_CONTEXT_API, title, width, height);
    if (!window->glfw)
        return error_set(
            error, "no window with OpenGL 4.5: %s; `slosh render SCENE -o OUT.mp4` draws without a window",
            last_reason);
    listen(window);
    find_connection(window);
    glfwMakeContextCurrent(window->glfw);
    glfwSwapInterval(1);
    snprintf(window->renderer, sizeof window->renderer, "%s", (const char *)glGetString(GL_RENDERER));
    return true;
}

Window *window_create(const char *title, int width, int height, Error *error)
{
    Window *window = calloc(1, sizeof *window);
    if (!window) {
        error_set(error, "no memory for the window");
        return NULL;
    }
    window->connection = -1;
    glfwSetErrorCallback(on_error);
    if (!glfwInit())
        error_set(error, "no display for a window: %s; `slosh render SCENE -o OUT.mp4` needs none",
                  last_reason);
    else if (open_window(window, title, width, height, error))
        return window;
    window_destroy(window);
    return NULL;
}

void window_destroy(Window *window)
{
    if (!window)
        return;
    if (window->glfw)
        glfwDestroyWindow(window->glfw);
    glfwTerminate();
    free(window);
}

bool window_peek(const Window *window, WindowEvent *event)
{
    if (window->count == 0)
        return false;
    *event = window->events[window->first];
    return true;
}

bool window_next(Window *window, WindowEvent *event)
{
    if (!window_peek(window, event))
        return false;
    window->first = (window->first + 1) % EVENTS_MAX;
    window->count--;
    return true;
}

void window_poll(Window *window)
{
    if (!window_gone(window))
        glfwPollEvents();
}

void window_wait(Window *window, double seconds)
{
    if (!window_gone(window))
        glfwWaitEventsTimeout(seconds);
    else
        poll(NULL, 0, (int)(1000 * seconds));
}

void window_wake(void)
{
    glfwPostEmptyEvent();
}

void window_present(Window *window)
{
    if (!window_gone(window)) /* a software driver would retry without end */
        glfwSwapBuffers(window->glfw);
}

void window_hide(Window *window)
{
    if (window_gone(window))
        return;
    glfwHideWindow(window->glfw);
    glfwPollEvents();
}

void window_title(Window *window, const char *title)
{
    if (window_gone(window))
        return;
    glfwSetWindowTitle(window->glfw, title);
}

/* The monitor that shows most of the window, in desktop pixels. */
static GLFWmonitor *display_of(const Window *window)
{
    int count, x, y, width, height, best_area = -1;
    GLFWmonitor **displays = glfwGetMonitors(&count), *best = NULL;
    glfwGetWindowPos(window->glfw, &x, &y);
    glfwGetWindowSize(window->glfw, &width, &height);
    for (int i = 0; i < count; i++) {
        int left, top;
        const GLFWvidmode *mode = glfwGetVideoMode(displays[i]);
        glfwGetMonitorPos(displays[i], &left, &top);
        if (!mode)
            continue;
        const double across = fmin(x + width, left + mode->width) - fmax(x, left);
        const double down = fmin(y + height, top + mode->height) - fmax(y, top);
        const int area = (int)(fmax(across, 0) * fmax(down, 0));
        if (area > best_area)
            best_area = area, best = displays[i];
    }
    return best;
}

void window_fullscreen(Window *window, bool full)
{
    GLFWmonitor *display = display_of(window);
    const GLFWvidmode *mode = display ? glfwGetVideoMode(display) : NULL;
    int *place = window->place;
    if (full == window->full || !mode || window_gone(window))
        return;
    if (full) {
        glfwGetWindowPos(window->glfw, &place[0], &place[1]);
        glfwGetWindowSize(window->glfw, &place[2], &place[3]);
        glfwSetWindowMonitor(window->glfw, display, 0, 0, mode->width, mode->height, mode->refreshRate);
    } else {
        glfwSetWindowMonitor(window->glfw, NULL, place[0], place[1], place[2], place[3], GLFW_DONT_CARE);
    }
    window->full = full;
}

bool window_is_fullscreen(const Window *window)
{
    return window->full;
}

void window_size(const Window *window, int *width, int *height)
{
    glfwGetFramebufferSize(window->glfw, width, height);
}

double window_scale(const Window *window)
{
    float x, y;
    glfwGetWindowContentScale(window->glfw, &x, &y);
    return fmin(fmax(x, 1), 4);
}

double window_refresh(const Window *window)
{
    GLFWmonitor *display = display_of(window);
    const GLFWvidmode *mode = display ? glfwGetVideoMode(display) : NULL;
    return mode && mode->refreshRate > 0 ? mode->refreshRate : 60;
}

const char *window_renderer(const Window *window)
{
    return window->renderer;
}

void window_leave_gamepads(Window *window, WindowClaimed *claimed, void *user)
{
    window->claimed = claimed;
    window->claimer = user;
}

/* Parses "03000000 4c05 0000 e60c 0000 11010000": bus, vendor, product and version, little-endian. */
bool window_guid_ids(const char *guid, uint16_t *vendor, uint16_t *product)
{
    unsigned v[2], p[2];
    if (!guid || strlen(guid) != 32 ||
        sscanf(guid, "%*8c%2x%2x0000%2x%2x0000", &v[0], &v[1], &p[0], &p[1]) != 4)
        return false;
    *vendor = (uint16_t)(v[0] | v[1] << 8);
    *product = (uint16_t)(p[0] | p[1] << 8);
    return *vendor != 0;
}

static bool is_claimed(const Window *window, int joystick)
{
    uint16_t vendor, product;
    return window->claimed && window_guid_ids(glfwGetJoystickGUID(joystick), &vendor, &product) &&
           window->claimed(window->claimer, vendor, product);
}

bool window_gamepad(const Window *window, WindowGamepad *gamepad)
{
    for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; joystick++) {
        GLFWgamepadstate state;
        if (!glfwGetGamepadState(joystick, &state) || is_claimed(window, joystick))
            continue;
        *gamepad = (WindowGamepad){
            .left = {state.axes[GLFW_GAMEPAD_AXIS_LEFT_X], state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]},
            .right = {state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X], state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]},
            .triggers = {0.5 + 0.5 * (double)state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER],
                         0.5 + 0.5 * (double)state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER]}};
        for (int i = 0; i <= GLFW_GAMEPAD_BUTTON_LAST; i++)
            gamepad->buttons |= state.buttons[i] == GLFW_PRESS ? 1U << i : 0;
        return true;
    }
    return false;
}

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
