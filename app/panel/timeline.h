/* The time line: a bar at the bottom of the window over a stretch of time that can be shown, with the present
   time in it, and buttons for play and single steps. Whose time it is - a running simulation's past, a
   recorded file - is the caller's affair: it shows what it is given and changes nothing; what the user does
   comes back as events.

   It keeps nothing from picture to picture. */
#ifndef SLOSH_TIMELINE_H
#define SLOSH_TIMELINE_H

#include "render/ui/ui.h"

#include <stdbool.h>

typedef struct TimelineData {
    double from, to; /* s, from <= to: what can be shown now */
    double now;      /* s: what the picture shows; one beyond the ends is drawn at the nearer end */
    bool playing;    /* time runs: the first button says pause, else play */
    double done;     /* the part of a recorded session that was done again, 0 .. 1; 0: none is */
    bool grows;      /* more is added at `to` while time runs there: a simulation, not a file */
} TimelineData;

typedef struct TimelineEvents {
    bool wants_time; /* the mouse holds the bar: `time` is to be shown. Said in each picture for as long as it
                        is held, moved or not; the newest wish counts */
    double time;     /* s, from .. to */
    int command; /* of the button pressed: PLAY_PAUSE, PLAY_STEP_BACK, PLAY_STEP, PLAY_NEWEST; PLAY_NONE */
} TimelineEvents;

/* How high it stands over the lower edge, with its margin, pixels. */
float timeline_height(const Ui *ui);

/* Stands between ui_begin and ui_end, when ui_begin returned true. It leaves `left` pixels of the picture's
   width free, as wide as a panel is. */
void timeline_draw(Ui *ui, int width, int height, float left, const TimelineData *data,
                   TimelineEvents *events);

#endif
