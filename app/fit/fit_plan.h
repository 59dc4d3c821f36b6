/* What `slosh fit` is asked, and what it found. */
#ifndef SLOSH_FIT_PLAN_H
#define SLOSH_FIT_PLAN_H

#include "app/fit/fit_runs.h"

/* A frame of --frame-ms, simulated seconds: as often as a screen shows one. */
#define FIT_FRAME (1.0 / 30)

typedef struct FitPlan {
    const Args *args;
    ChartSubject subject;
    Scene scene; /* as it is */
    Notes notes;
    FitAxes axes;
    FitGoal goal;
    char error_of[256];           /* what the error is of */
    char output[1024], csv[1024]; /* the scene that is written; where runs are kept */
    char command[1024];           /* as the user wrote it, about */
    FitRuns runs;
    FitLadder ladder;
} FitPlan;

/* Of --output where none is named: NAME_fit.yaml in the present folder. */
void fit_default_output(const char *scene, char output[1024]);

/* False with what is wrong with the command line or the scene. */
bool fit_plan_make(const Args *args, FitPlan *plan, Error *error);

/* The row of a try that was run. */
const ChartRow *fit_plan_row(const FitPlan *plan, int i);

/* The try of the scene as it is; NULL: it was not run. */
const FitTry *fit_plan_own(const FitPlan *plan);

/* "within 5 %", "within 0.6 s of computing a simulated second" */
void fit_goal_text(const FitPlan *plan, char *text, size_t size);

#endif
