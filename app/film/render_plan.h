/* What `slosh render` shows: the views of a scene; with --compare two or four settings of it side by side,
   the views of each below one another. */
#ifndef SLOSH_RENDER_PLAN_H
#define SLOSH_RENDER_PLAN_H

#include "app/playback/recorded.h"
#include "app/scene/scene.h"
#include "app/session/args.h"
#include "render/panels.h"

typedef struct RenderPlan {
    const Args *args;
    int setting_count; /* of --compare; 1 without */
    int panel_count, world_count;
    Scene scenes[PANELS_MAX];           /* of each setting */
    char names[PANELS_MAX][TITLE_SIZE]; /* of each setting: "particles 2000"; "" of a single one */
    int setting_of[PANELS_MAX];         /* of each panel */
    const ViewDef *views[PANELS_MAX];   /* of each panel, in its setting's scene */
    int world_of[PANELS_MAX];    /* of each panel; what differs in keys of the view alone shares one; -1: a
                                    file's */
    Scene own[PANELS_MAX];       /* of panels whose view has settings of its own */
    Scene *scene_of[PANELS_MAX]; /* of each world, among those */
    char worlds[PANELS_MAX][TITLE_SIZE]; /* of each world: its settings' name without keys of the view */
    int file_of[PANELS_MAX];             /* of each panel; -1: simulated */
    int leader_of[PANELS_MAX]; /* of each panel: the world of its setting's scene itself; -1: nobody shows it
                                */
    int file_count;
    Recorded files[PANELS_MAX]; /* recorded runs; the shoot takes over what it reads of them */
} RenderPlan;

/* Loads each setting, and says what is to be said of it; starts and writes nothing. False with the reason and
   the setting at fault; render_plan_close is needed in either case. */
bool render_plan_make(const Args *args, RenderPlan *plan, Error *error);
void render_plan_close(RenderPlan *plan); /* a zeroed one is allowed */

/* The panel's name, of its setting and of what its view has of its own; "": none. */
void render_plan_name(const RenderPlan *plan, int panel, char name[TITLE_SIZE]);

#endif
