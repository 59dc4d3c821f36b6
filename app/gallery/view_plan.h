/* What `slosh chart --views` draws: of each view the scene's own settings, each grade of each of its keys
   (ViewKind.grades), all keys at their coarsest, all at their finest (but where one grade does that); and its
   reference, the finest too and supersampled. */
#ifndef SLOSH_VIEW_PLAN_H
#define SLOSH_VIEW_PLAN_H

#include "app/gallery/view_row.h"
#include "app/session/args.h"
#include "render/frame/view.h"

enum { VIEW_SETS = 12, VIEW_SET_NAME = 80, VIEW_JOBS_MAX = VIEW_ROWS_MAX };

typedef struct ViewJob {
    const ViewKind *kind;
    bool reference;
    int set_count;
    char set[VIEW_SETS][VIEW_SET_NAME]; /* "--set key=value" */
    char name[VIEW_SETTINGS];           /* as ViewRow.settings */
} ViewJob;

typedef struct ViewPlan {
    const char *scene;             /* as scene_load takes it */
    const SceneSettings *settings; /* of the command line */
    int count;                     /* a view's reference stands before its others */
    ViewJob jobs[VIEW_JOBS_MAX];
} ViewPlan;

/* Of the view that the command line names (--set view.kind=...), or of all. */
bool view_plan_make(const Args *args, ViewPlan *plan, Error *error);

/* The scene of a job: without legend and edges of the box, which are as wide as pixels, whatever the size. */
bool view_job_scene(const ViewPlan *plan, const ViewJob *job, Scene *scene, Error *error);

#endif
