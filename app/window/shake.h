/* A hand that is always there and always the same: it shakes the box through the same events that a mouse
   makes, at their own times, whether the window looks or not. */
#ifndef SLOSH_WINDOW_SHAKE_H
#define SLOSH_WINDOW_SHAKE_H

#include "app/window/window.h"

#include <stddef.h>

/* Zero-initialise it. */
typedef struct WindowShake {
    double began_ms; /* wall time; 0: not yet */
    size_t events;   /* that were handed out */
} WindowShake;

/* The next event that is due at `now_ms` in a window of that size; false when there is none yet. A Shift drag
   at 125 events a second: to and fro across the picture, harder than the box may follow, and up and down. */
bool window_shake_next(WindowShake *script, double now_ms, int width, int height, WindowEvent *event);

#endif
