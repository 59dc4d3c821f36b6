/* What `slosh render` shows: the views of a scene; with --compare two or four settings of it side by side,
   the views of each below one another. */
#ifndef SLOSH_RENDER_PLAN_H
#define SLOSH_RENDER_PLAN_H

#include "app/scene/scene.h"
#include "app/session/args.h"
#include "app/session/session.h"
#include "render/panels.h"

typedef struct RenderPlan {
    const Args *args;
    int setting_count; /* of --compare; 1 without */
    int panel_count, world_count;
    Scene scenes[PANELS_MAX];           /* of each setting */
    char names[PANELS_MAX][TITLE_SIZE]; /* of each setting: "particles 2000"; "" of a single one */
    int setting_of[PANELS_MAX];         /* of each panel */
    const ViewDef *views[PANELS_MAX];   /* of each panel, in its setting's scene */
    int world_of[PANELS_MAX]; /* of each panel; settings that differ in keys of the view alone share one */
    int first_of[PANELS_MAX]; /* the first setting of each world */
    char worlds[PANELS_MAX][TITLE_SIZE]; /* of each world: its settings' name without keys of the view */
} RenderPlan;

/* Loads each setting, and says what is to be said of it; starts and writes nothing. False with the reason and
   the setting at fault. */
bool render_plan_make(const Args *args, RenderPlan *plan, Error *error);

/* What stands in a panel: its name, and what differs between the states of the panels. `sessions`: of each
   world. */
void render_plan_title(const RenderPlan *plan, const Session sessions[], int panel, Title *title);

#endif
