/* Input of the window's own devices: mouse, keys and a gamepad. Turns events into requests (app/play/ask.h),
   and held inputs into motion of the box (app/input/hand.h). Pure: independent of window, scene and clock. */
#ifndef SLOSH_PLAY_INPUT_H
#define SLOSH_PLAY_INPUT_H

#include "app/input/hand.h"
#include "app/play/ask.h"
#include "app/window/window.h"

enum { INPUT_KEYS = 512 };

typedef struct Input {
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
} Input;

/* Releases all: at the start, and when a scene is opened. Given fields stay. */
void input_begin(Input *input);

/* Handles an event; `height`: of the picture, pixels; keys are translated by play_key_on_layout. */
void input_take(Input *input, const WindowEvent *event, int height, AskQueue *asks);

/* True if the event makes no request: it only holds or moves the box, or does nothing. Such events may be
   handled during a picture. */
bool input_only_holds(const Input *input, const WindowEvent *event);

/* Sets a trigger's pressure on the fluid: 0 .. 1 like the left button, down to -1 like the right button. No
   effect while the mouse drags. */
void input_press(Input *input, double press);

/* True if a drag, or a trigger, touches the fluid. */
bool input_touches(const Input *input);

/* holds_box: true if a drag or a key moves the box; busy: true if the hand needs frequent updates, for this
   or any drag. */
bool input_holds_box(const Input *input);
bool input_busy(const Input *input);

/* Adds the input since the last call to the hand's input; `pad` NULL: no gamepad; `metres`: size of a pixel.
   Returns the wall time of the first event included, or 0. */
double input_hand(Input *input, const WindowGamepad *pad, double metres, HandInput *hand, AskQueue *asks);

#endif
