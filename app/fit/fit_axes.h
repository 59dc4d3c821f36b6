/* The settings of a scene varied by `slosh fit`: each is one axis of app/fit/fit_search.h, in the order of
   FitAxisName. The first place of an axis FIT_FREE is the scene's own value.

   Only the computation of a flow may vary, never the flow: no viscosity, no surface tension, no speed of
   sound. */
#ifndef SLOSH_FIT_AXES_H
#define SLOSH_FIT_AXES_H

#include "app/fit/fit_search.h"
#include "app/lab/chart_run.h"

enum { FIT_METHODS = 8, FIT_PRESETS = 3, FIT_TERMS = 5 };

typedef enum FitAxisName { FIT_METHOD, FIT_PRESET, FIT_SPACING, FIT_STEP, FIT_SUPPORT, FIT_TERM } FitAxisName;

typedef struct FitAxes {
    ChartSubject subject;
    const Scene *scene;              /* unchanged; for a case with its first method */
    const char *method[FIT_METHODS]; /* the scene's own first */
    const char *preset[FIT_PRESETS];
    bool effect[FIT_METHODS][FIT_TERMS]; /* true if the method reads the term */
    FitAxis axis[FIT_AXES];
    int axes;
} FitAxes;

/* Fills in the axes. Methods: all, or for a case those run by validate. Methods unable to run the scene go
   to `notes` with the reason. Settings of the command line (method, preset, support, a term) stay fixed.
   `scene` must outlive `axes`. */
void fit_axes_make(const ChartSubject *subject, const Scene *scene, FitAxes *axes, Notes *notes);

/* A run of a setting. Contains pointers into itself: do not copy. */
typedef struct FitJob {
    ChartJob job;
    char text[CHART_SWEEPS][96];
} FitJob;

/* Fills in the run of a point. Returns false if there is no such setting: the method does not read a term,
   or a value equals the scene's own. Other errors are left to chart_prepare. */
bool fit_axes_job(const FitAxes *axes, const FitPoint *point, FitJob *job);

/* Estimates the work: particles times steps times neighbours, in an arbitrary unit. */
double fit_axes_work(const FitAxes *axes, const FitPoint *point);

#endif
