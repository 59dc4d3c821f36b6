/* What `slosh chart` runs: methods x backends x what is swept x steps x spacings; of a scene the reference
   and the floor too. */
#ifndef SLOSH_CHART_PLAN_H
#define SLOSH_CHART_PLAN_H

#include "app/lab/chart_sweep.h"
#include "app/session/args.h"
#include "app/session/headless.h"

enum { CHART_JOBS_MAX = 200, CHART_NAMES_MAX = SWEEP_NAMES_MAX };

typedef struct ChartPlan {
    const Args *args;
    ChartSubject subject;
    Scene scene;    /* as the command line has it: of a case with its first method */
    char csv[1024]; /* where the runs are kept */
    Notes notes;    /* of the scene */
    ChartSweeps sweeps;
    int coarsening_count;
    double coarsenings[CHART_SPACINGS]; /* times the scene's spacing, the coarsest first */
    char note[256];                     /* backends that were left out, and why; or "" */
    Headless *context;                  /* NULL as long as nobody needed one */
    bool wants_context;
    int count;
    ChartJob jobs[CHART_JOBS_MAX];
    double work[CHART_JOBS_MAX]; /* about how long each takes, up to a factor of its method and backend */
} ChartPlan;

/* False with what is wrong with the command line or the scene. Backends are those that the command line
   names; else the scene's own, `cpu`, and those on a GPU where there is one: a software renderer would take
   ten times as long and more, and say nothing of a GPU. chart_plan_end in either case. */
bool chart_plan_make(const Args *args, ChartPlan *plan, Error *error);
void chart_plan_end(ChartPlan *plan);

/* About how long job `i` takes, s, after the runs of `rows` with its method and backend, or else of others;
   in a unit of its own where there are none. */
double chart_plan_seconds(const ChartPlan *plan, int i, const ChartRows *rows);

#endif
