/* Input of the panel's widgets. Widgets see one state of mouse and keys per picture; events come faster,
   even a whole click within a slow picture. So events wait in a queue, and a picture takes only
   distinguishable events: no button or key goes down and up within a picture, and the mouse stays where a
   button changed. Pure. */
#ifndef SLOSH_PANEL_WIDGET_INPUT_H
#define SLOSH_PANEL_WIDGET_INPUT_H

#include "app/window/window.h"
#include "render/ui/ui.h"

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
