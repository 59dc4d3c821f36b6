/* What `slosh fit` may change of a scene: one axis each of app/fit/fit_search.h, in this order. The first
   place of an axis FIT_FREE is the scene's own value.

   Changed is how a flow is computed, never which flow: no viscosity, no surface tension, no speed of sound.
 */
#ifndef SLOSH_FIT_AXES_H
#define SLOSH_FIT_AXES_H

#include "app/fit/fit_search.h"
#include "app/lab/chart_run.h"

enum { FIT_METHODS = 8, FIT_PRESETS = 3, FIT_TERMS = 5 };

typedef enum FitAxisName { FIT_METHOD, FIT_PRESET, FIT_SPACING, FIT_STEP, FIT_SUPPORT, FIT_TERM } FitAxisName;

typedef struct FitAxes {
    ChartSubject subject;
    const Scene *scene;              /* as it is; of a case with its first method */
    const char *method[FIT_METHODS]; /* the scene's own first */
    const char *preset[FIT_PRESETS];
    bool effect[FIT_METHODS][FIT_TERMS]; /* whether the method reads the term */
    FitAxis axis[FIT_AXES];
    int axes;
} FitAxes;

/* All methods that there are, or of a case those that validate runs; those that cannot run the scene, and
   why, go to `notes`. What the command line sets (method, preset, support, a term) is kept as it says. The
   scene is to outlive it. */
void fit_axes_make(const ChartSubject *subject, const Scene *scene, FitAxes *axes, Notes *notes);

/* A run of a setting; it points into itself. */
typedef struct FitJob {
    ChartJob job;
    char text[CHART_SWEEPS][96];
} FitJob;

/* False where there is no such setting: the method does not read a term, or a value is the scene's own
   already. What else cannot be made, chart_prepare says. */
bool fit_axes_job(const FitAxes *axes, const FitPoint *point, FitJob *job);

/* Particles times steps times neighbours, in a unit of its own. */
double fit_axes_work(const FitAxes *axes, const FitPoint *point);

#endif
