/* The overlay of the picture: the panel, the list of keys and the time line. User input goes to the request
   queue. */
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
    bool opener;      /* given: a button opens a closed panel, which had no room at the start */
    bool scenes;      /* the list of scenes is shown */
    SceneCards cards;
    bool timeline; /* always shown, even if running and without the mouse near */
    Ui *ui;
    Panel *widgets;
    WidgetInput input;
    float mouse[2];   /* position at the last event */
    unsigned held;    /* pressed mouse buttons, a bit each */
    double moved_ms;  /* wall time of the last move */
    int height;       /* of the last drawn picture */
    bool scrubs;      /* the mouse drags the time line */
    double wished;    /* to this time, s */
    double particles; /* count chosen in the panel, for the release of the mouse; 0: none */
    double time;      /* of the last drawn state, s */
    double drawn_ms;  /* wall time of the last drawing */
    int shown;        /* bits of the last drawn parts */
    bool watches;     /* gauges are watched */
    bool watches_probes;
    const char *warnings[8 + NOTES_MAX];
    int warning_count;
    char lost[64]; /* a warning of lost particles */
    BoxControlDevice devices[BOX_CONTROL_DEVICES_MAX];
    int device_count;
    uint64_t reports_shown; /* reports of motion devices at the last drawing of their bars */
    double bars_ms;         /* wall time of that drawing */
} Overlay;

/* Data for the overlay beside the model. */
typedef struct OverlayFacts {
    int width, height; /* of the picture */
    double range[2];   /* of the picture's colours */
    double opacity_range[2], size_range[2];
    const char *renderer;
    const PlayMeter *meter;
    const StageTimes *gl_times; /* NULL: the stages of a picture cannot be timed */
    bool movie;                 /* a video is being recorded */
} OverlayFacts;

/* Starts the overlay; `letters`: text height, pixels. */
bool overlay_start(Overlay *overlay, float letters, Error *error);
void overlay_end(Overlay *overlay);                        /* also after a failed start */
void overlay_set_letters(Overlay *overlay, float letters); /* keeps the old letters on failure */

/* overlay_event: passes an event to the widgets; overlay_takes: true if the event belongs to the widgets
   alone, while nothing is dragged. */
void overlay_event(Overlay *overlay, const WindowEvent *event);
bool overlay_takes(const Overlay *overlay, const Model *model, const WindowEvent *event);

/* Draws the shown parts. Returns true if the next picture will still change: unhandled input, or moving
   windows. */
bool overlay_draw(Overlay *overlay, Model *model, const OverlayFacts *facts, AskQueue *asks);

/* Opens or closes the list of scenes. Returns false with the reason if the list has no pictures; the list
   opens anyway. */
bool overlay_toggle_scenes(Overlay *overlay, const Model *model, Error *error);

/* Call once in a while: true if there is more to show without user input. */
bool overlay_follow(Overlay *overlay);

/* True if any part is shown. */
bool overlay_shown(const Overlay *overlay, const Model *model);

/* Height of the time line above the lower edge, pixels; 0: hidden. */
float overlay_covered_below(const Overlay *overlay, const Model *model);

/* Part of the width taken by the panel, 0 .. 1; 0 if less than two fifths would remain. */
double overlay_covered_left(const Overlay *overlay, int width);

#endif
