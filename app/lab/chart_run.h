/* Makes one row of a chart: a case, or a scene over time. */
#ifndef SLOSH_CHART_RUN_H
#define SLOSH_CHART_RUN_H

#include "app/case/run.h"
#include "app/lab/chart_row.h"
#include "app/lab/chart_subject.h"

enum { CHART_SWEEPS = 8 };

/* The variable part of a run. */
typedef struct ChartJob {
    ChartRole role;
    const char *method, *backend;
    double coarsening; /* times the scene's spacing */
    int fineness;      /* 0: steps as long as the scene's, or by its CFL number; 1: half as long */
    double jitter;     /* spacings, added to the scene's own jitter */
    int set_count;
    const char *set[CHART_SWEEPS]; /* "--sweep key=value" of remaining keys */
    bool step_unnamed;             /* ChartRow.swept leaves out keys already in ChartRow.step */
} ChartJob;

/* A CHART_LONG run takes CHART_LONGER times the subject's time. */
enum { CHART_LONGER = 3 };

enum { CHART_TEXTS = 6, CHART_TEXT_SIZE = 96 };

/* The settings of a run: settings of the command line, then settings of the job. Contains pointers into
   itself: do not copy. */
typedef struct ChartSettings {
    SceneSettings all;
    char texts[CHART_TEXTS][CHART_TEXT_SIZE];
    int used;
} ChartSettings;

/* Fills in settings, and row's step, swept values and spacing. The spacing is set to a value with whole
   layers in the fills. `scene` is scratch space. A case puts its own settings first. */
bool chart_settings(const ChartSubject *subject, const ChartJob *job, ChartSettings *settings, Scene *scene,
                    ChartRow *row, Error *error);

/* Loads the scene of a job, and fills in row's key, method, backend, step and spacing. The scene's notes
   go to `notes`, unless NULL or a case. */
bool chart_prepare(const ChartSubject *subject, const ChartJob *job, Scene *scene, ChartRow *row,
                   Notes *notes, Error *error);

/* Runs the job into `row`, filled in by chart_prepare before. A broken simulation leaves seconds and error
   NaN, with the reason in the outcome. Returns false on any other failure or a signal. */
bool chart_run(const ChartSubject *subject, const ChartJob *job, ChartRow *row, Progress *progress,
               double done, double part, Error *error);

#endif
