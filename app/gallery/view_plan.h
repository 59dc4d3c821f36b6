/* Plan of `slosh chart --views`. Pictures of each view: the scene's own settings; each grade of each of
   the view's keys (ViewKind.grades); all keys at their coarsest; all keys at their finest (both skipped if
   equal to a single grade); and the reference, all keys at their finest and supersampled. */
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
    char name[VIEW_SETTINGS];           /* ViewRow.settings */
} ViewJob;

typedef struct ViewPlan {
    const char *scene;             /* name for scene_load */
    const SceneSettings *settings; /* of the command line */
    int count;                     /* the reference of a view comes before the view's other jobs */
    ViewJob jobs[VIEW_JOBS_MAX];
} ViewPlan;

/* Plans the view named on the command line (--set view.kind=...), or all views. */
bool view_plan_make(const Args *args, ViewPlan *plan, Error *error);

/* Loads the scene of a job, without legend and box edges: their width is in pixels, whatever the size. */
bool view_job_scene(const ViewPlan *plan, const ViewJob *job, Scene *scene, Error *error);

#endif
