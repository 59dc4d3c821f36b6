/* What the window's own devices say: mouse, keys and a gamepad. Events become what is asked of the window
   (app/play/ask.h), and what is held moves the box (app/hand/hand.h). Pure: it knows no window, no scene and
   no clock. */
#ifndef SLOSH_PLAY_INPUT_H
#define SLOSH_PLAY_INPUT_H

#include "app/hand/hand.h"
#include "app/play/ask.h"
#include "app/window/window.h"

enum { INPUT_KEYS = 512 };

typedef struct Input {
    double mouse[2];  /* pixels */
    PlayCommand drag; /* PLAY_ORBIT, ..., or PLAY_NONE */
    int drag_button;
    bool touching;         /* given: drags and the wheel are for the fluid (app/touch) */
    bool grabbed;          /* the drag has the camera; one to shift it that has it not yet is a click */
    bool down[INPUT_KEYS]; /* keys, by their number */
    unsigned pad_buttons;  /* at the last look */
    double pressed;        /* how hard a trigger touches the fluid, 0 .. 1; 1 under the mouse */
    double move_drag[2];   /* since the hand's last update: pixels to the right and up */
    double turn_drag[2];   /* the same, radians */
    double hand_event_ms;  /* wall time of the first event since then that concerns the box; 0: none */
} Input;

/* Nothing is held: at the start, and when a scene is opened. What is given stays. */
void input_begin(Input *input);

/* Takes an event of a picture so many pixels high; its key is as play_key_on_layout has it. */
void input_take(Input *input, const WindowEvent *event, int height, AskQueue *asks);

/* Whether an event asks for nothing: it says what is held and how it moves, of the box or of nothing. Such a
   one may be taken in the middle of a picture. */
bool input_only_holds(const Input *input, const WindowEvent *event);

/* A trigger touches the fluid by so much: 0 .. 1 as the left button does, down to -1 as the right one.
   Nothing while the mouse has something. */
void input_press(Input *input, double press);

/* Whether a drag, or a trigger, has the fluid. */
bool input_touches(const Input *input);

/* Whether a drag or a key has the box; or a drag anything, so that the hand is to be looked at often. */
bool input_holds_box(const Input *input);
bool input_busy(const Input *input);

/* Adds to the hand's input what has come since the last call; pad: NULL where there is none. A pixel is so
   many metres. Returns the wall time of the first event of it, or 0. */
double input_hand(Input *input, const WindowGamepad *pad, double metres, HandInput *hand, AskQueue *asks);

#endif
