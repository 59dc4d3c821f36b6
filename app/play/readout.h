/* Readout of the picture: value, unit and place under the mouse and at pinned places. Only for views with
   `probe` and `probing` (ViewKind, render/frame/view.h). The panel under the mouse shows the value there,
   and each panel its values at the pins. The readout appears only in the window, not in screenshots and
   videos. */
#ifndef SLOSH_PLAY_READOUT_H
#define SLOSH_PLAY_READOUT_H

#include "app/play/notice.h"
#include "app/window/window.h"
#include "render/frame/text.h"
#include "render/frame/view.h"
#include "render/panels.h"

enum { READOUT_PINS_MAX = VIEW_PROBES_MAX - 1 };

typedef struct Readout {
    double mouse[2];                    /* pixels of the whole picture */
    bool free;                          /* the mouse is over the picture and free */
    bool shown;                         /* the last picture has a value under the mouse */
    int pinning;                        /* count of places waiting to be pinned: */
    double pinned[READOUT_PINS_MAX][2]; /* pixels of the whole picture */
    double pins[READOUT_PINS_MAX][3];   /* m, box's frame */
    int pin_count;
    ViewProbes found; /* of the last picture, in the mouse's panel: pins, then the mouse */
} Readout;

/* Removes all pins. */
void readout_begin(Readout *readout);

/* Handles an event; returns true if a picture is due. `free`: nothing else uses the mouse. */
bool readout_event(Readout *readout, const Panels *panels, const WindowEvent *event, bool free);

/* Pins the place under the mouse at the next picture that knows it, or reports why not. */
void readout_pin(Readout *readout, const Panels *panels, Notice *notice);
void readout_unpin(Readout *readout);

/* Reads and draws the values over a picture of width x height, after the panels. Returns true if the next
   picture will know more. */
bool readout_draw(Readout *readout, const Panels *panels, int width, int height, Text *text, Notice *notice);

#endif
