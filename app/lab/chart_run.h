/* Makes one row of a chart: a case, or a scene over time. */
#ifndef SLOSH_CHART_RUN_H
#define SLOSH_CHART_RUN_H

#include "app/case/run.h"
#include "app/lab/chart_row.h"
#include "app/lab/chart_subject.h"

enum { CHART_SWEEPS = 8 };

/* What differs from run to run. */
typedef struct ChartJob {
    ChartRole role;
    const char *method, *backend;
    double coarsening; /* times the scene's spacing */
    int fineness;      /* 0: steps as long as the scene's, or as its number says; 1: half of it */
    double jitter;     /* spacings, besides the scene's own */
    int set_count;
    const char *set[CHART_SWEEPS]; /* "--sweep key=value" of other keys */
    bool step_unnamed;             /* row's swept leaves out what row's step says after the job's scaling */
} ChartJob;

/* CHART_LONG runs so many times the subject's time. */
enum { CHART_LONGER = 3 };

enum { CHART_TEXTS = 6, CHART_TEXT_SIZE = 96 };

/* The settings of a run: those of the command line, and behind them those that the job adds. It points into
   itself: it isn't to be copied. */
typedef struct ChartSettings {
    SceneSettings all;
    char texts[CHART_TEXTS][CHART_TEXT_SIZE];
    int used;
} ChartSettings;

/* Fills in row's step, what is swept, and its spacing: the one at which the fills have whole layers, which is
   set. `scene` is for scratch. A case adds its own before them. */
bool chart_settings(const ChartSubject *subject, const ChartJob *job, ChartSettings *settings, Scene *scene,
                    ChartRow *row, Error *error);

/* The scene of that job (its lines go to `notes`, unless it is NULL or a case), with row's key, method,
 * backend, step and spacing. */
bool chart_prepare(const ChartSubject *subject, const ChartJob *job, Scene *scene, ChartRow *row,
                   Notes *notes, Error *error);

/* Runs it into `row`, which chart_prepare has filled. A simulation that breaks leaves seconds and error NaN,
   and its reason; false where something else fails, or a signal came. */
bool chart_run(const ChartSubject *subject, const ChartJob *job, ChartRow *row, Progress *progress,
               double done, double part, Error *error);

#endif
