/* What `slosh render` shows: a scene, or with --compare two or four settings of it side by side. */
#ifndef SLOSH_RENDER_PLAN_H
#define SLOSH_RENDER_PLAN_H

#include "app/scene/scene.h"
#include "app/session/args.h"
#include "app/session/session.h"
#include "render/panels.h"

typedef struct RenderPlan {
    const Args *args;
    int panel_count, world_count;
    Scene scenes[PANELS_MAX];           /* of each panel */
    int world_of[PANELS_MAX];           /* panels whose settings differ in keys of the view alone share one */
    int panel_of[PANELS_MAX];           /* the first panel of each world */
    char names[PANELS_MAX][TITLE_SIZE]; /* of each panel: "particles 2000"; "" of a single one */
    char worlds[PANELS_MAX][TITLE_SIZE]; /* of each world: the same without keys of the view */
} RenderPlan;

/* Loads each setting, and says what is to be said of it; starts and writes nothing. False with the reason and
   the setting at fault. */
bool render_plan_make(const Args *args, RenderPlan *plan, Error *error);

/* What stands in a panel: its name, and what differs between the states of the panels. `sessions`: of each
   world. */
void render_plan_title(const RenderPlan *plan, const Session sessions[], int panel, Title *title);

#endif
