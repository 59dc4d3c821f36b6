/* A reproducible hand: shakes the box with mouse events at fixed times, independent of the window's
   polling. */
#ifndef SLOSH_WINDOW_SHAKE_H
#define SLOSH_WINDOW_SHAKE_H

#include "app/window/window.h"

#include <stddef.h>

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
