/* What the panel's widgets are told. Widgets see one state of mouse and keys a picture; events come faster,
   on a slow picture a whole click. So events wait in a queue, and a picture takes as many of them as it can
   tell apart: no button or key goes down and up in one, and the mouse does not leave the place where a button
   changed. Pure. */
#ifndef SLOSH_PANEL_WIDGET_INPUT_H
#define SLOSH_PANEL_WIDGET_INPUT_H

#include "app/window/window.h"
#include "render/ui/ui.h"

enum { WIDGET_EVENTS_MAX = 256 };

/* Zero-initialise it. */
typedef struct WidgetInput {
    UiInput now; /* for ui_begin; dt and changed are the caller's */
    int first, count;
    WindowEvent events[WIDGET_EVENTS_MAX]; /* a ring of those that wait */
} WidgetInput;

/* Adds an event. Mouse moves in a row are one. Of a full queue the oldest event is taken first. */
void widget_input_add(WidgetInput *input, const WindowEvent *event);

/* Into `now`: the next picture's events. What came once in the picture before (wheel, text) is forgotten. */
void widget_input_next(WidgetInput *input);

/* No widget is shown: what waits is taken, all at once. */
void widget_input_skip(WidgetInput *input);

#endif
