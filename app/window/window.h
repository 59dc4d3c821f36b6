/* A window with an OpenGL 4.5 core context, by GLFW: an EGL context first, the system's own if there is none.

   There is one at a time; all functions belong to the main thread, but window_wake. Places are in pixels of
   the framebuffer from the left and the top, whatever the display's scale. */
#ifndef SLOSH_WINDOW_H
#define SLOSH_WINDOW_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Window Window;

typedef enum WindowEventKind {
    WINDOW_KEY,    /* key, modifiers, down; held keys repeat */
    WINDOW_TEXT,   /* codepoint */
    WINDOW_BUTTON, /* button, modifiers, down; x, y: where it was then */
    WINDOW_MOVE,   /* x, y */
    WINDOW_WHEEL,  /* y: notches away from the user */
    WINDOW_FOCUS,  /* down: whether the window has it now */
    WINDOW_RESIZE, /* or another display scale: ask for both */
    WINDOW_EXPOSE, /* what stood in the window is lost */
    WINDOW_DROP,   /* path */
    WINDOW_CLOSE   /* the user wants it closed */
} WindowEventKind;

typedef struct WindowEvent {
    WindowEventKind kind;
    double when_ms; /* wall time */
    bool down, repeated;
    int key, button, modifiers; /* as GLFW counts them */
    char label[8];              /* what the key types on the user's keyboard; "": nothing */
    unsigned codepoint;
    double x, y;
    char path[1024];
} WindowEvent;

/* NULL on failure: no display, no OpenGL 4.5; the message says what to run instead. The context is current.
 */
Window *window_create(const char *title, int width, int height, Error *error);
void window_destroy(Window *window); /* NULL is allowed */

/* The next event that the last window_poll or window_wait found; false when there is none left. */
bool window_next(Window *window, WindowEvent *event);
bool window_peek(const Window *window, WindowEvent *event); /* the same, and it stays the next one */
void window_poll(Window *window);
void window_wait(Window *window, double seconds); /* returns early for an event or window_wake */
void window_wake(void);                           /* from any thread */

void window_present(Window *window); /* shows what was drawn */

/* Whether the display is gone: its server has ended, or the line to it. From then on no function waits for
   it, but for those of OpenGL, and some may call `gone` of window_when_gone, which does not return. */
bool window_gone(Window *window);
int window_connection(const Window *window); /* its file descriptor; -1: not known */

/* What the display's library is to do where it notices first, in the midst of a function of the window, on
   the main thread; else it ends the program. NULL: nothing. */
void window_when_gone(Window *window, void (*gone)(void *user), void *user);
void window_hide(Window *window); /* at once; for the end */
void window_title(Window *window, const char *title);
void window_fullscreen(Window *window, bool full); /* on the display where most of it is, and back */
bool window_is_fullscreen(const Window *window);

void window_size(const Window *window, int *width, int *height); /* of the framebuffer; 0 when minimised */
double window_scale(const Window *window);                       /* of letters: 1 to 3 and more */
double window_refresh(const Window *window); /* pictures that the display shows in a second */
const char *window_renderer(const Window *window);

/* Gamepads of which `claimed` says so are left out: something else has them. */
typedef bool WindowClaimed(void *user, uint16_t vendor, uint16_t product);
void window_leave_gamepads(Window *window, WindowClaimed *claimed, void *user);

/* Vendor and product in a joystick's GUID as GLFW gives it, in SDL's layout; false where it has none. */
bool window_guid_ids(const char *guid, uint16_t *vendor, uint16_t *product);

/* The first gamepad: sticks -1..1 (right and down positive), pressed buttons as bits 1 <<
   GLFW_GAMEPAD_BUTTON_*. False without one. */
typedef struct WindowGamepad {
    double left[2], right[2];
    double triggers[2]; /* left, right: 0 .. 1 */
    unsigned buttons;
} WindowGamepad;
bool window_gamepad(const Window *window, WindowGamepad *gamepad);

#endif
