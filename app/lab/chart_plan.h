/* Plan of `slosh chart`: methods x backends x swept values x steps x spacings; for a scene also the
   reference and the floor. */
#ifndef SLOSH_CHART_PLAN_H
#define SLOSH_CHART_PLAN_H

#include "app/lab/chart_sweep.h"
#include "app/run/offscreen.h"
#include "app/session/args.h"

enum { CHART_JOBS_MAX = 200, CHART_NAMES_MAX = SWEEP_NAMES_MAX };

typedef struct ChartPlan {
    const Args *args;
    ChartSubject subject;
    Scene scene;    /* as set by the command line; for a case with its first method */
    char csv[1024]; /* file of the runs */
    Notes notes;    /* of the scene */
    ChartSweeps sweeps;
    int coarsening_count;
    double coarsenings[CHART_SPACINGS]; /* times the scene's spacing, coarsest first */
    char note[256];                     /* the left out backends and the reason; or "" */
    Headless *context;                  /* NULL until first needed */
    bool wants_context;
    int count;
    ChartJob jobs[CHART_JOBS_MAX];
    double work[CHART_JOBS_MAX]; /* estimated time of each job, up to a factor of its method and backend */
} ChartPlan;

/* Makes the plan. Returns false with the reason if the command line or the scene is wrong. Backends: those
   of the command line; else the scene's own, `cpu`, and the GPU backends if there is a GPU. A software
   renderer would take ten times as long or more, and not represent a GPU. Call chart_plan_end in either
   case. */
bool chart_plan_make(const Args *args, ChartPlan *plan, Error *error);
void chart_plan_end(ChartPlan *plan);

/* Estimates the time of job `i`, s, from the runs in `rows` with the same method and backend, else from
   other runs. Without such runs the unit is arbitrary. */
double chart_plan_seconds(const ChartPlan *plan, int i, const ChartRows *rows);

#endif
