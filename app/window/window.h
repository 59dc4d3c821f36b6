/* A window with an OpenGL 4.5 core context, by GLFW: first tries an EGL context, then the system's own.

   Only one window at a time. All functions except window_wake must be called on the main thread. Positions
   are in framebuffer pixels from left and top, for any display scale. */
#ifndef APP_WINDOW_WINDOW_H
#define APP_WINDOW_WINDOW_H

#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Window Window;

typedef enum WindowEventKind {
    WINDOW_KEY,    /* key, modifiers, down; held keys repeat */
    WINDOW_TEXT,   /* codepoint */
    WINDOW_BUTTON, /* button, modifiers, down; x, y: position at the press */
    WINDOW_MOVE,   /* x, y */
    WINDOW_WHEEL,  /* y: notches away from the user */
    WINDOW_FOCUS,  /* down: the window has the focus */
    WINDOW_RESIZE, /* or a new display scale: ask for both */
    WINDOW_EXPOSE, /* the window's contents are lost */
    WINDOW_DROP,   /* path */
    WINDOW_CLOSE   /* the user closes the window */
} WindowEventKind;

typedef struct WindowEvent {
    WindowEventKind kind;
    double when_ms; /* wall time */
    bool down, repeated;
    int key, button, modifiers; /* GLFW's codes */
    char label[8];              /* text of the key on the user's keyboard; "": none */
    unsigned codepoint;
    double x, y;
    char path[1024];
} WindowEvent;

/* Returns NULL on failure: no display, no OpenGL 4.5; the message names a command to run instead. On success
   the context is current. */
Window *window_create(const char *title, int width, int height, Error *error);
void window_destroy(Window *window); /* NULL is allowed */

/* Takes the next event found by the last window_poll or window_wait; false if there is none. */
bool window_next(Window *window, WindowEvent *event);
bool window_peek(const Window *window, WindowEvent *event); /* the next event, without taking it */
void window_poll(Window *window);
void window_wait(Window *window, double seconds); /* returns early for an event or window_wake */
void window_wake(void);                           /* from any thread */

void window_present(Window *window); /* shows what was drawn */

/* True if the display is gone: its server has ended, or the connection. From then on no function waits,
   except OpenGL's. Some functions may call `gone` of window_when_gone, which must not return. */
bool window_gone(Window *window);
int window_connection(const Window *window); /* the display's file descriptor; -1: unknown */

/* Sets a callback for when the display's library notices the loss first, inside a window function on the main
   thread; without a callback the library ends the program. NULL: no callback. */
void window_when_gone(Window *window, void (*gone)(void *user), void *user);
void window_hide(Window *window); /* immediately; for the end of the program */
void window_title(Window *window, const char *title);
void window_fullscreen(Window *window, bool full); /* on the display with most of the window, and back */
bool window_is_fullscreen(const Window *window);

void window_size(const Window *window, int *width, int *height); /* of the framebuffer; 0 when minimised */
double window_scale(const Window *window);                       /* text scale: 1 to 3 and more */
double window_refresh(const Window *window); /* display refresh rate, pictures per second */
const char *window_renderer(const Window *window);

/* Ignores gamepads with `claimed` true: other code reads such gamepads. */
typedef bool WindowClaimed(void *user, uint16_t vendor, uint16_t product);
void window_leave_gamepads(Window *window, WindowClaimed *claimed, void *user);

/* Reads vendor and product from a joystick's GUID of GLFW, in SDL's layout; false if the GUID has none. */
bool window_guid_ids(const char *guid, uint16_t *vendor, uint16_t *product);

/* State of the first gamepad: sticks -1..1 (right and down positive), pressed buttons as bits 1 <<
   GLFW_GAMEPAD_BUTTON_*. Returns false without a gamepad. */
typedef struct WindowGamepad {
    double left[2], right[2];
    double triggers[2]; /* left, right: 0 .. 1 */
    unsigned buttons;
} WindowGamepad;
bool window_gamepad(const Window *window, WindowGamepad *gamepad);

/* A reproducible hand: shakes the box with mouse events at fixed times, independent of the window's
   polling. */

/* Zero-initialise before use. */
typedef struct WindowShake {
    double began_ms; /* wall time; 0: not started */
    size_t events;   /* count of events returned so far */
} WindowShake;

/* Returns the next event due at `now_ms` in a window of width x height; false if none is due yet. The script
   is a Shift drag with 125 events per second: to and fro across the picture, faster than the box may follow,
   and up and down. */
bool window_shake_next(WindowShake *script, double now_ms, int width, int height, WindowEvent *event);

#endif
