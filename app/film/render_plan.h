/* Contents of `slosh render`: the views of a scene; with --compare two or four settings of the scene side
   by side, each with its views in a column. */
#ifndef SLOSH_RENDER_PLAN_H
#define SLOSH_RENDER_PLAN_H

#include "app/run/playback/playback.h"
#include "app/scene/scene.h"
#include "app/session/args.h"
#include "render/panels.h"

typedef struct RenderPlan {
    const Args *args;
    int setting_count; /* of --compare; 1 without */
    int panel_count, world_count;
    Scene scenes[PANELS_MAX];           /* per setting */
    char names[PANELS_MAX][TITLE_SIZE]; /* per setting: "particles 2000"; "" for a single setting */
    int setting_of[PANELS_MAX];         /* per panel */
    const ViewDef *views[PANELS_MAX];   /* per panel, in the scene of its setting */
    int world_of[PANELS_MAX];    /* per panel; settings differing only in keys of the view share a world;
                                    -1: a file */
    Scene own[PANELS_MAX];       /* for panels whose view has own settings */
    Scene *scene_of[PANELS_MAX]; /* per world: pointer into `scenes` or `own` */
    char worlds[PANELS_MAX][TITLE_SIZE]; /* per world: name of its settings without keys of the view */
    int file_of[PANELS_MAX];             /* per panel; -1: simulated */
    int leader_of[PANELS_MAX]; /* per panel: the world of the setting's scene without view settings; -1:
                                  not shown by any panel */
    int file_count;
    Recorded files[PANELS_MAX]; /* recorded runs; the shoot takes over their readers */
} RenderPlan;

/* Loads all settings and prints notes; starts and writes nothing. Returns false with the reason and the
   faulty setting; call render_plan_close in either case. */
bool render_plan_make(const Args *args, RenderPlan *plan, Error *error);
void render_plan_close(RenderPlan *plan); /* zeroed is allowed */

/* Fills in the panel's name, from the setting and the view's own settings; "": none. */
void render_plan_name(const RenderPlan *plan, int panel, char name[TITLE_SIZE]);

#endif
