/* The panel of the live window: state and cost of the session, and the scene's live keys as sliders and
   choices.

   The panel only shows its data, and changes nothing itself: user actions are returned as events. */
#ifndef APP_WINDOW_PANEL_PANEL_H
#define APP_WINDOW_PANEL_PANEL_H

#include "app/input/input.h"
#include "app/run/simulator.h"
#include "app/scene/scene.h"
#include "render/ui/ui.h"
#include "sim/gpu/gl.h"
#include "sim/step/constants.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct Panel Panel;

typedef struct PanelData {
    const Scene *scene;           /* present values */
    const char *about;            /* help of the title; NULL: none */
    bool recorded;                /* shows a recorded run: no solver data */
    double stage_ms[STAGE_COUNT]; /* per frame of the solver; per picture of the view */
    bool stage_ran[STAGE_COUNT];
    bool render_stages_known; /* false on a software renderer, where stages of a picture cannot be timed
                                 without waiting: one bar for all rendering */
    double sim_ms, render_ms; /* per frame of the solver; per picture */
    GlCalls substep_calls, picture_calls; /* of the driver in the last one; 0: not by a GPU */
    const float *frame_history,
        *step_history;           /* ms, oldest first: between pictures; per frame of the solver */
    int frame_count, step_count; /* counts */
    const GaugeSample *gauges;   /* oldest first */
    int gauge_count;
    const ProbeSample *probes; /* the same for the scene's probes */
    int probe_count;
    uint64_t closed_gates;          /* gates of emitters and drains: sim/flow/flow.h */
    double box_wanted[3], box_most; /* target size of the box; longest side in the scene file, m */
    size_t particles, particles_at_start;
    double particles_wished; /* from PanelEvents, while the mouse holds the slider; else 0 */
    size_t opened;           /* ordinal of the scene among the opened scenes */
    double time;             /* simulated, s */
    double dt;               /* of the last step, s */
    StepLimit limit;         /* what limited the last step */
    double iterations;       /* of iterative solvers, in the last step */
    SolveFigures solved;     /* since the scene's start; steps 0: none in this method */
    double real_time_factor; /* simulated over wall time */
    double speed;            /* requested; 1: real time */
    double pictures_per_second;
    bool paused, realtime;
    double scalar_range[2];                 /* present range of the shown scalar */
    double opacity_range[2], size_range[2]; /* the same for the scalars of opacity and size; else 0 */
    const char *renderer;
    const char *const *warnings; /* in plain words */
    int warning_count;
    const BoxControlDevice *devices; /* motion devices; without any, the panel has no section for devices */
    int device_count;
    double panel_ms; /* mean CPU time of the panel per picture, over the last pictures */
} PanelData;

enum { PANEL_VALUES_MAX = 8 };

/* User requests. */
typedef struct PanelEvents {
    int value_count;
    SettingValue values[PANEL_VALUES_MAX]; /* for scene_set_value */
    char term[SETTING_TEXT_SIZE];          /* "path=value" of a switched term, for scene_set_live; "": none */
    const UserAction *action;              /* of the pressed button, or NULL */
    bool gated;                            /* shut these gates: */
    uint64_t closed_gates;
    bool sized; /* resize the box, m: */
    double size[3];
    double particles;    /* more than 0: requested number of particles */
    char restart[64];    /* or "path=value" for a restart of the scene; "": none */
    bool watches;        /* the gauges are shown */
    bool watches_probes; /* the probes' plots are shown */
    int tuned;           /* number of a motion device to tune, or 0: */
    double gain, dead_zone;
} PanelEvents;

/* Returns NULL if memory is short. */
Panel *panel_create(void);
void panel_destroy(Panel *panel); /* NULL is allowed */

/* Returns the panel's width, with margin, for a picture of the given width: half of a small picture, but
   wide enough for its words. */
float panel_width(const Ui *ui, int width);

/* Call both between ui_begin and ui_end, if ui_begin returned true. */
void panel_draw(Panel *panel, Ui *ui, int width, int height, const PanelData *data, PanelEvents *events);

/* Draws the button to open the panel, in the upper left corner, `below` pixels under the edge. Returns
   true if pressed. */
bool panel_opener_draw(Ui *ui, float below);

/* Draws all user commands with their keys, in the middle of the picture. */
void panel_help_draw(Ui *ui, int width, int height);

/* A scene to choose: app/window/play.h. */
typedef struct PanelCard {
    const char *title, *text, *path;
    unsigned texture; /* the picture; 0: not ready */
    bool lit;         /* true for the open scene */
} PanelCard;

/* Draws the scenes to choose from, with their pictures, in the middle of the picture. Returns the index of
   the pressed scene, or -1. */
int panel_scenes_draw(Ui *ui, int width, int height, const PanelCard *cards, int count);

/* The time line: a bar at the bottom of the window over the available time span, with the present time,
   and buttons for play and single steps. The caller decides the source, a running simulation's past or a
   recorded file. The time line only shows its data, and changes nothing: user actions are returned as
   events.

   Nothing is kept between pictures. */

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
    const UserAction *action; /* of the pressed button, or NULL */
} TimelineEvents;

/* Returns the height over the lower edge, with margin, pixels. */
float timeline_height(const Ui *ui);

/* Draws the time line; call between ui_begin and ui_end, if ui_begin returned true. Leaves `left` pixels
   of the picture's width free, for a panel. */
void timeline_draw(Ui *ui, int width, int height, float left, const TimelineData *data,
                   TimelineEvents *events);

#endif
