/* Makes one row of a chart: a case, or a scene over time. */
#ifndef SLOSH_CHART_RUN_H
#define SLOSH_CHART_RUN_H

#include "app/case/run.h"
#include "app/lab/chart_row.h"

/* What is charted. */
typedef struct ChartSubject {
    const Case *of;                /* or NULL: */
    const char *scene;             /* as scene_load takes it */
    double time;                   /* s, of a scene */
    const SceneSettings *settings; /* of the command line */
} ChartSubject;

enum { CHART_SWEEPS = 8 };

/* What differs from run to run. */
typedef struct ChartJob {
    ChartRole role;
    const char *method, *backend;
    double coarsening; /* times the scene's spacing */
    int fineness;      /* 0: steps as long as the scene's, or as its number says; 1: half of it */
    double jitter;     /* spacings; 0: as the scene has it */
    int set_count;
    const char *set[CHART_SWEEPS]; /* "--sweep key=value" of other keys */
} ChartJob;

/* The scene of that job, with row's key, method, backend, step and spacing. */
bool chart_prepare(const ChartSubject *subject, const ChartJob *job, Scene *scene, ChartRow *row,
                   Error *error);

/* Runs it into `row`, which chart_prepare has filled. A simulation that breaks leaves seconds and error NaN,
   and its reason; false where something else fails, or a signal came. */
bool chart_run(const ChartSubject *subject, const ChartJob *job, ChartRow *row, Progress *progress,
               double done, double part, Error *error);

#endif
