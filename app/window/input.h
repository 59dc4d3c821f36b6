/* Requests to the window: from keys, mouse and wheel, dropped files, the panel and motion devices. Requests
   wait in a queue and are executed in order between two pictures, so that no data of a picture changes during
   its drawing. */
#ifndef APP_WINDOW_INPUT_H
#define APP_WINDOW_INPUT_H

#include "app/window/window.h"

#include "app/input/hand.h"
#include "app/input/play_commands.h"
#include "render/frame/view.h"
#include "render/ui/ui.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum ActionKind {
    ACTION_COMMAND,      /* command, held */
    ACTION_SETTING,      /* text: "path=value" of a live key */
    ACTION_OPEN_SCENE,   /* text: the file of a scene */
    ACTION_RESTART,      /* text: "path=value", for a restart of the scene */
    ACTION_PARTICLES,    /* amount: approximate count, for a restart of the scene */
    ACTION_TUNE_DEVICE,  /* device, amount: gain and dead zone */
    ACTION_STOP_BOX,     /* the box stops: the device or mouse that moved the box is gone */
    ACTION_GO_TO_TIME,   /* amount: simulated time to show and stay at, s */
    ACTION_CHOOSE_VIEW,  /* amount: position in the picture, pixels: chooses the view at that position */
    ACTION_GRAB_CAMERA,  /* takes the camera into the hand, unmoved */
    ACTION_TURN_CAMERA,  /* amount: radians to the right and up, for a held camera */
    ACTION_PAN_CAMERA,   /* amount: picture heights to the right and up */
    ACTION_ZOOM_CAMERA,  /* amount: steps nearer; grabs the camera first */
    ACTION_STEER_CAMERA, /* amount: radians to the right and up, steps nearer; grabs the camera first */
    ACTION_TILT_GRAVITY, /* amount: radians of tilt to the right, and away */
    ACTION_CHANGE_TOUCH, /* amount: notches of size, notches of strength */
    ACTION_RESIZE_BOX,   /* amount: size of the box, m */
    ACTION_SET_GATES,    /* gates: emitters and drains to close */
    ACTION_CLOSE_WINDOW  /* closes the window */
} ActionKind;

typedef struct Action {
    ActionKind kind;
    PlayCommand command;
    bool held;  /* repeated by a held key */
    int device; /* the device's number */
    uint64_t gates;
    double amount[3]; /* unused values are 0 */
    char text[1024];
} Action;

enum { ACTIONS_MAX = 64 };

/* Zero-initialise before use. */
typedef struct ActionQueue {
    int first, count;
    int lost;                    /* count for actions_lost */
    Action actions[ACTIONS_MAX]; /* a ring */
} ActionQueue;

/* Adds a copy. Consecutive turns, pans and zooms of the camera add up. A full queue drops the request and
   counts the loss. */
void action_add(ActionQueue *queue, const Action *action);
void action_add_command(ActionQueue *queue, PlayCommand command);
void action_add_settings(ActionQueue *queue, const ViewSetting *settings, int count);

/* The count of dropped requests since the last call. */
int actions_lost(ActionQueue *queue);

/* Takes the oldest request; false if there is none. */
bool action_next(ActionQueue *queue, Action *action);

/* Input of the window's own devices: mouse, keys and a gamepad. Turns events into requests
   (app/window/input.h), and held inputs into motion of the box (app/input/hand.h). Pure: independent of
   window, scene and clock. */

enum { INPUT_KEYS = 512 };

typedef struct PlayInput {
    double mouse[2];  /* pixels */
    PlayCommand drag; /* PLAY_ORBIT, ..., or PLAY_NONE */
    int drag_button;
    bool touching;         /* given: drags and the wheel act on the fluid (app/input/touch.h) */
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

/* Handles an event; `height`: of the picture, pixels; keys are translated by play_key_on_layout. */
void input_event(PlayInput *input, const WindowEvent *event, int height, ActionQueue *actions);

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

/* Adds the input since the last call to the hand's input; `pad` NULL: no gamepad; `metres`: size of a pixel.
   Returns the wall time of the first event included, or 0. */
double input_fill_hand(PlayInput *input, const WindowGamepad *pad, double metres, HandInput *hand,
                       ActionQueue *actions);

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

#endif
