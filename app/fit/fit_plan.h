/* Request and results of `slosh fit`. */
#ifndef SLOSH_FIT_PLAN_H
#define SLOSH_FIT_PLAN_H

#include "app/fit/fit_runs.h"

/* Simulated time per frame of --frame-ms, s: the frame rate of a screen. */
#define FIT_FRAME (1.0 / 30)

typedef struct FitPlan {
    const Args *args;
    ChartSubject subject;
    Scene scene; /* unchanged */
    Notes notes;
    FitAxes axes;
    FitGoal goal;
    char error_of[256];           /* meaning of the error */
    char output[1024], csv[1024]; /* file of the resulting scene; file of the runs */
    char command[1024];           /* approximately as typed by the user */
    FitRuns runs;
    FitLadder ladder;
} FitPlan;

/* Fills in the default of --output: NAME_fit.yaml in the current folder. */
void fit_default_output(const char *scene, char output[1024]);

/* Makes the plan. Returns false with the reason if the command line or the scene is wrong. */
bool fit_plan_make(const Args *args, FitPlan *plan, Error *error);

/* Returns the row of a finished try. */
const ChartRow *fit_plan_row(const FitPlan *plan, int i);

/* Returns the try of the unchanged scene; NULL: not run. */
const FitTry *fit_plan_own(const FitPlan *plan);

/* Fills in a text such as "within 5 %" or "within 0.6 s of computing a simulated second". */
void fit_goal_text(const FitPlan *plan, char *text, size_t size);

#endif
