/* What the picture shows under the mouse: value, unit and place beside the cursor, and at places that are
   pinned. For views that can tell (probe and probing of ViewKind, render/frame/view.h). Of several panels the
   one under the mouse tells what is there, and each what it shows at the pins. Drawn over the window's own
   picture, not into screenshots and videos. */
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
    bool free;                          /* the mouse is over the picture, and nothing has it */
    bool shown;                         /* the last picture tells what is under it */
    int pinning;                        /* so many places are to be pinned, one after the other: */
    double pinned[READOUT_PINS_MAX][2]; /* pixels of the whole picture */
    double pins[READOUT_PINS_MAX][3];   /* m, box's frame */
    int pin_count;
    ViewProbes found; /* of the last picture, in the mouse's panel: pins, then the mouse's */
} Readout;

/* Nothing is pinned. */
void readout_begin(Readout *readout);

/* Whether a picture is due for it. `free`: nothing else has the mouse. */
bool readout_event(Readout *readout, const Panels *panels, const WindowEvent *event, bool free);

/* Pins what is under the mouse, with the next picture that knows it, or says why not. */
void readout_pin(Readout *readout, const Panels *panels, Notice *notice);
void readout_unpin(Readout *readout);

/* Reads and draws, over a picture of that size, behind the panels' own. Whether the next picture will know
   more. */
bool readout_draw(Readout *readout, const Panels *panels, int width, int height, Text *text, Notice *notice);

#endif
