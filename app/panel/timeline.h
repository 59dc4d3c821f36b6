/* The time line: a bar at the bottom of the window over the available time span, with the present time,
   and buttons for play and single steps. The caller decides the source, a running simulation's past or a
   recorded file. The time line only shows its data, and changes nothing: user actions are returned as
   events.

   Nothing is kept between pictures. */
#ifndef SLOSH_TIMELINE_H
#define SLOSH_TIMELINE_H

#include "render/ui/ui.h"

#include <stdbool.h>

typedef struct TimelineData {
    double from, to; /* s, from <= to: available time span */
    double now;      /* s: time of the picture; outside the span drawn at the nearer end */
    bool playing;    /* time runs: the first button shows pause, else play */
    double done;     /* played fraction of a recorded session, 0 .. 1; 0: none */
    bool grows;      /* the span grows at `to` while time runs: a simulation, not a file */
} TimelineData;

typedef struct TimelineEvents {
    bool wants_time; /* the mouse holds the bar: show `time`. Set in every picture while held, moved or
                        not; the newest request counts */
    double time;     /* s, from .. to */
    int command; /* of the pressed button: PLAY_PAUSE, PLAY_STEP_BACK, PLAY_STEP, PLAY_NEWEST; PLAY_NONE */
} TimelineEvents;

/* Returns the height over the lower edge, with margin, pixels. */
float timeline_height(const Ui *ui);

/* Draws the time line; call between ui_begin and ui_end, if ui_begin returned true. Leaves `left` pixels
   of the picture's width free, for a panel. */
void timeline_draw(Ui *ui, int width, int height, float left, const TimelineData *data,
                   TimelineEvents *events);

#endif
