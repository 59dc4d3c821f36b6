/* A window and its input: the window itself, requests from all sources, input of mouse, keys, gamepad and
   widgets, and measurements of delays. */
#ifndef APP_WINDOW_WINDOW_H
#define APP_WINDOW_WINDOW_H

#include "app/input/actions.h"
#include "app/input/input.h"
#include "app/scene/scene.h"
#include "render/frame/view.h"
#include "render/ui/ui.h"
#include "sim/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A window with an OpenGL 4.5 core context, by GLFW: first tries an EGL context, then the system's own.

   Only one window at a time. All functions except window_wake must be called on the main thread. Positions
   are in framebuffer pixels from left and top, for any display scale. */

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

/* Requests to the window: from keys, mouse and wheel, dropped files, the panel and motion devices. Requests
   wait in a queue and are executed in order between two pictures, so that no data of a picture changes during
   its drawing. */

typedef enum RequestKind {
    REQUEST_ACTION,       /* action, held, amount: one of the user's actions (app/input/actions.h) */
    REQUEST_VALUE,        /* value: of a live key */
    REQUEST_SETTING,      /* text: "path=value" of a live key */
    REQUEST_OPEN_SCENE,   /* text: the file of a scene */
    REQUEST_RESTART,      /* text: "path=value", for a restart of the scene */
    REQUEST_PARTICLES,    /* amount: approximate count, for a restart of the scene */
    REQUEST_TUNE_DEVICE,  /* device, amount: gain and dead zone */
    REQUEST_STOP_BOX,     /* the box stops: the device or mouse that moved the box is gone */
    REQUEST_GO_TO_TIME,   /* amount: simulated time to show and stay at, s */
    REQUEST_CHOOSE_VIEW,  /* amount: position in the picture, pixels: chooses the view at that position */
    REQUEST_GRAB_CAMERA,  /* takes the camera into the hand, unmoved */
    REQUEST_STEER_CAMERA, /* amount: radians to the right and up, steps nearer; grabs the camera first */
    REQUEST_RESIZE_BOX,   /* amount: size of the box, m */
    REQUEST_SET_GATES     /* gates: emitters and drains to close */
} RequestKind;

typedef struct Request {
    RequestKind kind;
    const UserAction *action;
    bool held;  /* repeated by a held key */
    int device; /* the device's number */
    uint64_t gates;
    double amount[3]; /* unused values are 0 */
    union {
        char text[1024];
        SettingValue value;
    };
} Request;

enum { REQUESTS_MAX = 64 };

/* Zero-initialise before use. */
typedef struct RequestQueue {
    int first, count;
    int lost;                       /* count for requests_lost */
    Request requests[REQUESTS_MAX]; /* a ring */
} RequestQueue;

/* Adds a copy. Consecutive actions of ACTION_ADDS_UP, and turns of the camera by devices, add up. A full
   queue drops the request and counts the loss. */
void request_add(RequestQueue *queue, const Request *request);
void request_add_action(RequestQueue *queue, const UserAction *action);
void request_add_settings(RequestQueue *queue, const ViewSetting *settings, int count);

/* The count of dropped requests since the last call. */
int requests_lost(RequestQueue *queue);

/* Takes the oldest request; false if there is none. */
bool request_next(RequestQueue *queue, Request *request);

/* Input of the window's own devices: mouse, keys and a gamepad. Turns events into requests, and
   held inputs into motion of the box (app/input/input.h). Pure: independent of window, scene and clock. */

enum { INPUT_KEYS = 512 };

typedef struct PlayInput {
    double mouse[2];        /* pixels */
    const UserAction *drag; /* NULL: none */
    int drag_button;
    bool touching;         /* given: drags and the wheel act on the fluid (app/input/input.h) */
    bool grabbed;          /* the drag moves the camera; an ungrabbed pan drag is still a click */
    bool down[INPUT_KEYS]; /* keys, by their number */
    unsigned pad_buttons;  /* at the last poll */
    double pressed;        /* pressure of a trigger on the fluid, 0 .. 1; 1 for the mouse */
    double move_drag[2];   /* since the hand's last update: pixels to the right and up */
    double turn_drag[2];   /* since the hand's last update: radians */
    double hand_event_ms;  /* wall time of the first event since then for the box; 0: none */
} PlayInput;

/* Releases all: at the start, and when a scene is opened. Given fields stay. */
void input_begin(PlayInput *input);

/* Handles an event; `height`: of the picture, pixels; keys are translated by key_on_layout. */
void input_event(PlayInput *input, const WindowEvent *event, int height, RequestQueue *requests);

/* True if the event makes no request: it only holds or moves the box, or does nothing. Such events may be
   handled during a picture. */
bool input_only_holds(const PlayInput *input, const WindowEvent *event);

/* Sets a trigger's pressure on the fluid: 0 .. 1 like the left button, down to -1 like the right button. No
   effect while the mouse drags. */
void input_press(PlayInput *input, double press);

/* True if a drag, or a trigger, touches the fluid. */
bool input_touches(const PlayInput *input);

/* holds_box: true if a drag or a key moves the box; busy: true if the hand needs frequent updates, for this
   or any drag. */
bool input_holds_box(const PlayInput *input);
bool input_busy(const PlayInput *input);

/* Rate of the box while a key is held, of the rates of HandInput: gentle, as a key has no half way. */
#define INPUT_KEY_RATE 0.4

/* Adds the input since the last call to the hand's input; `pad` NULL: no gamepad; `metres`: size of a pixel.
   Returns the wall time of the first event included, or 0. */
double input_fill_hand(PlayInput *input, const WindowGamepad *pad, double metres, HandInput *hand,
                       RequestQueue *requests);

/* Input of the panel's widgets. Widgets see one state of mouse and keys per picture; events come faster,
   even a whole click within a slow picture. So events wait in a queue, and a picture takes only
   distinguishable events: no button or key goes down and up within a picture, and the mouse stays where a
   button changed. Pure. */

enum { WIDGET_EVENTS_MAX = 256 };

/* Zero-initialise before use. */
typedef struct WidgetInput {
    UiInput now; /* for ui_begin; the caller sets dt and changed */
    int first, count;
    WindowEvent events[WIDGET_EVENTS_MAX]; /* waiting events; ring buffer */
} WidgetInput;

/* Adds an event. Consecutive mouse moves are merged. If the queue is full, the oldest event is taken
   first. */
void widget_input_add(WidgetInput *input, const WindowEvent *event);

/* Updates `now` with the next picture's events. Momentary input of the last picture (wheel, text) is
   cleared. */
void widget_input_next(WidgetInput *input);

/* Takes all waiting events at once, while no widget is shown. */
void widget_input_skip(WidgetInput *input);

/* Measurements of the live window: pictures per second, time from start to the first picture, and delay
   from an event to the first picture showing its effect. Pure, except for the clocks of the process. */

enum { FRAME_TIMES_HISTORY = 120, FRAME_TIMES_WAITING_MAX = 256, FRAME_TIMES_SAMPLES_MAX = 1 << 14 };

/* An event turned into a command: time of the event, number of the command. */
typedef struct FrameEvent {
    double when_ms;
    uint64_t command;
} FrameEvent;

/* Zero-initialise before use. Times are wall_ms(). */
typedef struct FrameTimes {
    double first_ms;                    /* from process start to the first picture; 0: none yet */
    double last_ms;                     /* wall time of the last picture */
    size_t pictures;                    /* total */
    double second_began_ms;             /* of the present count */
    int in_second;                      /* pictures in that second */
    double pictures_per_second;         /* of the last second */
    float history[FRAME_TIMES_HISTORY]; /* times between pictures, ms, without pauses; ring buffer */
    bool rests;                         /* set by frame_times_pause */
    int history_next, history_count;
    int waiting_count;
    FrameEvent waiting[FRAME_TIMES_WAITING_MAX]; /* not shown yet, ordered by command */
    size_t latencies;                            /* count of shown events */
    float latency_ms[FRAME_TIMES_SAMPLES_MAX];   /* latencies of the last events; ring buffer */
    double began_ms, began_cpu_ms;  /* wall and CPU time of the first picture of a state; 0: none yet */
    double drawn_ms, last_drawn_ms; /* wall time of drawing: total; last picture */
    double panel_ms;                /* total CPU time of the panel */
    double events_ms;               /* total CPU time of event handling */
    size_t drawn, panels;           /* counts of pictures and panels */
} FrameTimes;

/* Returns the wall time since the process began, ms, including program start. 0 if /proc cannot be read. */
double process_age_ms(void);

/* Reports that an event at `when_ms` became a command. */
void frame_times_event(FrameTimes *frame_times, double when_ms, uint64_t command);

/* Reports a picture on the screen, of a state after `obeyed` commands. */
void frame_times_picture(FrameTimes *frame_times, double now_ms, uint64_t applied);

/* Reports if time is paused: pictures then follow user actions, and do not count as a rate. */
void frame_times_pause(FrameTimes *frame_times, bool rests);

/* Reports the first picture of a state, the start of the session. Returns false if there was an earlier
   one. */
bool frame_times_begin(FrameTimes *frame_times, double now_ms);

/* CPU time of the process; of the calling thread; ms. */
double process_cpu_ms(void);
double thread_cpu_ms(void);

/* Report the time of a picture, and the panel's CPU time; the means are over all pictures. */
void frame_times_drawn(FrameTimes *frame_times, double ms);
void frame_times_panel(FrameTimes *frame_times, double cpu_ms);
double frame_times_drawn_mean(const FrameTimes *frame_times);
double frame_times_panel_mean(const FrameTimes *frame_times);

/* Reports CPU time of event handling, between and during pictures; the mean is per picture. */
void frame_times_events(FrameTimes *frame_times, double cpu_ms);
double frame_times_events_mean(const FrameTimes *frame_times);

/* Fills in the times between pictures, oldest first; returns their count. */
int frame_times_history(const FrameTimes *frame_times, float out[FRAME_TIMES_HISTORY]);

/* Returns the quantile `fraction` of the latencies, ms; 0 without any. */
double frame_times_latency(const FrameTimes *frame_times, double fraction);

/* Forgets waiting events: another scene restarts the command numbers. */
void frame_times_forget_events(FrameTimes *frame_times);

#endif
