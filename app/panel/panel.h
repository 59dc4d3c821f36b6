/* The panel of the live window: what the session does and costs, and the scene's live keys as sliders and
   choices.

   It shows what it is given and changes nothing itself: what the user does comes back as events. */
#ifndef SLOSH_PANEL_H
#define SLOSH_PANEL_H

#include "app/held/hand_post.h"
#include "app/scene/scene.h"
#include "app/session/simulator.h"
#include "app/shelf/cards.h"
#include "render/ui/ui.h"
#include "sim/base/stage.h"
#include "sim/world/step_control.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct Panel Panel;

typedef struct PanelData {
    const Scene *scene;           /* values as they stand */
    bool recorded;                /* a recorded run is shown: nothing of a solver */
    double stage_ms[STAGE_COUNT]; /* of a frame of the solver, of a picture of the view */
    bool stage_ran[STAGE_COUNT];
    bool render_stages_known; /* false on a software renderer, where the stages of a picture cannot be timed
                                 without waiting: then one bar for all rendering */
    double sim_ms, render_ms; /* a frame of the solver, a picture */
    const float *frame_history,
        *step_history;           /* ms, oldest first: picture to picture; a frame of the solver */
    int frame_count, step_count; /* of them */
    const GaugeSample *gauges;   /* oldest first */
    int gauge_count;
    const ProbeSample *probes; /* the same of the scene's probes */
    int probe_count;
    uint64_t shut; /* gates of emitters and drains: sim/matter/flow.h */
    double box_wanted[3],
        box_most; /* the size to which the box goes; the longest side that the file has, m */
    size_t particles, particles_at_start;
    double particles_wished; /* of PanelEvents, while the mouse holds it; else 0 */
    size_t opened;           /* the number of the scene among those that were opened */
    double time;             /* simulated, s */
    double dt;               /* of the last step, s */
    StepLimit limit;         /* what bounded it */
    double iterations;       /* of solvers that iterate, in the last step; */
    SolveFigures solved;     /* since the scene's start; steps 0: the method has none */
    double real_time_factor; /* simulated over wall time */
    double speed;            /* that is asked for; 1: real time */
    double pictures_per_second;
    bool paused, realtime;
    double scalar_range[2];                 /* of the scalar shown, now */
    double opacity_range[2], size_range[2]; /* the same of those by which opacity and size go; else 0 */
    const char *renderer;
    const char *const *warnings; /* plain words */
    int warning_count;
    const HandDevice *devices; /* motion devices; none: the panel has no section for them */
    int device_count;
    double panel_ms; /* CPU time of the panel in a picture, mean of the last ones */
} PanelData;

enum { PANEL_SETTINGS_MAX = 8, PANEL_SETTING_SIZE = 192 };

/* What the user asks for. */
typedef struct PanelEvents {
    int setting_count;
    char settings[PANEL_SETTINGS_MAX][PANEL_SETTING_SIZE]; /* "path=value", as scene_set_live takes it */
    int command;                                           /* a PlayCommand, or PLAY_NONE */
    bool gated;                                            /* these gates shall be shut: */
    uint64_t shut;
    bool sized; /* the box shall be so large, m: */
    double size[3];
    double particles;    /* more than 0: about so many are wished, */
    char again[64];      /* or "path=value", with which the scene shall begin anew; "": not */
    bool watches;        /* the gauges are shown, */
    bool watches_probes; /* and what probes read */
    int tuned;           /* number of a motion device, or 0: it shall have these two */
    double gain, dead_zone;
} PanelEvents;

/* NULL without memory. */
Panel *panel_create(void);
void panel_destroy(Panel *panel); /* NULL is allowed */

/* How wide the panel is, in a picture that wide; with its margin. Half of a small picture, and not too narrow
   for its words. */
float panel_width(const Ui *ui, int width);

/* Both stand between ui_begin and ui_end, when ui_begin returned true. */
void panel_draw(Panel *panel, Ui *ui, int width, int height, const PanelData *data, PanelEvents *events);

/* The button that opens the panel, in the upper left corner, so many pixels below the edge. True when
 * pressed. */
bool panel_opener_draw(Ui *ui, float below);

/* All that a user can do, with its keys, in the middle of the picture. */
void panel_help_draw(Ui *ui, int width, int height);

/* The scenes to choose from, with their pictures, in the middle of the picture. The place of the one that was
   pressed, or -1. */
int panel_cards_draw(Ui *ui, int width, int height, const SceneCard *cards, int count);

#endif
