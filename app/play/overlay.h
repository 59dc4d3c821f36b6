/* What lies over the picture: the panel, the list of keys and the time line. What the user asks for there is
 * queued. */
#ifndef SLOSH_PLAY_OVERLAY_H
#define SLOSH_PLAY_OVERLAY_H

#include "app/meter/meter.h"
#include "app/panel/panel.h"
#include "app/panel/timeline.h"
#include "app/panel/widget_input.h"
#include "app/play/ask.h"
#include "app/play/model.h"
#include "app/shelf/cards.h"
#include "app/window/window.h"

typedef struct Overlay {
    bool panel, help; /* shown */
    bool opener;      /* given: where there is no panel a button opens it: it had no room at the start */
    bool scenes;      /* the list of scenes is */
    SceneCards cards;
    bool timeline; /* always shown, not only while paused or near the mouse */
    Ui *ui;
    Panel *widgets;
    WidgetInput input;
    float mouse[2];   /* where the last event had it, */
    unsigned held;    /* buttons of the mouse, a bit each */
    double moved_ms;  /* wall time of that */
    int height;       /* of the picture drawn last */
    bool scrubs;      /* the mouse holds the time line, */
    double wished;    /* at this time, s */
    double particles; /* wished in the panel, for when the mouse lets go; 0: none */
    double time;      /* s: of the state drawn last */
    double drawn_ms;  /* wall time of the last drawing */
    int shown;        /* what was drawn then */
    bool watches;     /* with the gauges, */
    bool watches_probes;
    const char *warnings[8 + NOTES_MAX];
    int warning_count;
    char lost[64]; /* one of them */
    HandDevice devices[HAND_POST_DEVICES_MAX];
    int device_count;
    uint64_t reports_shown; /* of motion devices, when their bars were last drawn anew */
    double bars_ms;         /* wall time of that */
} Overlay;

/* What it shows beside the model. */
typedef struct OverlayFacts {
    int width, height; /* of the picture */
    double range[2];   /* of its colours */
    double opacity_range[2], size_range[2];
    const char *renderer;
    const PlayMeter *meter;
    const StageTimes *gl_times; /* NULL: the stages of a picture cannot be timed */
    bool movie;                 /* a video is being recorded */
} OverlayFacts;

/* Letters so many pixels high. */
bool overlay_start(Overlay *overlay, float letters, Error *error);
void overlay_end(Overlay *overlay);                        /* also after a start that failed */
void overlay_set_letters(Overlay *overlay, float letters); /* where they cannot be had the old ones stay */

/* Tells the widgets of an event; whether one is theirs alone, while nothing is dragged. */
void overlay_event(Overlay *overlay, const WindowEvent *event);
bool overlay_takes(const Overlay *overlay, const Model *model, const WindowEvent *event);

/* Draws what is shown. Whether the next picture is to show more of what was done, or windows in their place.
 */
bool overlay_draw(Overlay *overlay, Model *model, const OverlayFacts *facts, AskQueue *asks);

/* Opens or closes the list of scenes. False with the reason why it has no pictures; it is there nevertheless.
 */
bool overlay_toggle_scenes(Overlay *overlay, const Model *model, Error *error);

/* Once in a while: whether there is more to show though nothing was done. */
bool overlay_follow(Overlay *overlay);

/* Whether anything is. */
bool overlay_shown(const Overlay *overlay, const Model *model);

/* How high the time line stands over the lower edge, pixels; 0: it is not shown. */
float overlay_covered_below(const Overlay *overlay, const Model *model);

/* How much of the width the panel takes from the box, 0 .. 1: one that leaves less than two fifths takes
 * nothing.
 */
double overlay_covered_left(const Overlay *overlay, int width);

#endif
