/* One run of `slosh chart`: its settings, its computing time, its error. The last cell of a row, for a scene,
   has the numbers of the metrics at CHART_TIMES even times: numbers separated by blanks, times by
   semicolons. */
#ifndef APP_LAB_ERROR_CHART_H
#define APP_LAB_ERROR_CHART_H

#include "app/bench/cases/case.h"
#include "app/cli/args/args.h"
#include "app/lab/experiment.h"
#include "app/run/measure/measure.h"
#include "app/run/offscreen.h"
#include "app/scene/scene.h"

#include <stdio.h>

enum {
    CHART_TIMES = 40,
    CHART_QUANTITIES = SCENE_METRICS_MAX * METRIC_NUMBERS + METRIC_PROBES,
    CHART_ROWS_MAX = 256,
    CHART_SWEPT = 128
};

/* Purpose of a run. */
typedef enum ChartRole {
    CHART_POINT,     /* a point of the chart */
    CHART_REFERENCE, /* the finest run of a scene, as reference */
    CHART_FLOOR,     /* one of three runs with jitters about a millionth of a spacing apart */
    CHART_LONG       /* CHART_LONGER times as long, to test stability: slosh fit */
} ChartRole;

typedef struct ChartRow {
    uint64_t key; /* hash of all inputs of the run */
    ChartRole role;
    char method[NAME_SIZE], backend[NAME_SIZE];
    char step[NAME_SIZE];    /* "number 0.3" or "substeps 20" */
    char swept[CHART_SWEPT]; /* "support=2.6 kernel=cubic"; "" */
    int fineness;            /* of the step: rows of equal fineness form one line of the convergence */
    double spacing;          /* m */
    size_t particles;
    double seconds;  /* computing time per simulated second; NaN: the run broke */
    double error;    /* NaN: unknown */
    uint64_t steps;  /* of a scene, in total; not kept in the file: 0 after reading */
    Outcome outcome; /* OUTCOME_NONE: not run */
    unsigned backs;  /* returns of the sentinel to an earlier state */
    int quantities;  /* of a scene: count of metric numbers per time; of a case 0 */
    double series[CHART_TIMES][CHART_QUANTITIES];
} ChartRow;

/* The file of the runs of `slosh chart` and `slosh fit`. */
extern const TrialTable chart_table;

typedef struct ChartRows {
    int metric_count, metrics[SCENE_METRICS_MAX]; /* metrics to compare a scene's runs by, as in Scene */
    int probe_count;                              /* of the scene */
    Trials *trials;                               /* of chart_table */
} ChartRows;

static inline ChartRow *chart_row(const ChartRows *rows, int i)
{
    return trials_row(rows->trials, i);
}

/* These rows, with the metrics of the scene. */
ChartRows chart_rows_of(Trials *trials, const Scene *scene);

/* Returns the reference among the rows, or NULL: missing, or its run broke. */
const ChartRow *chart_rows_reference(const ChartRows *rows);

/* Returns the distance of a row from the reference: mean over the metrics of (rms over time / range of the
   metric in `reference`). Skips times at which either row has no value, and metrics without change in the
   reference. NaN if no metric changes in the reference, a metric has no common time, or a row lacks the
   numbers of these metrics. */
double chart_distance(const ChartRows *rows, const ChartRow *row, const ChartRow *reference);

/* chart_changes: true if a metric changes in the row, so that distances from the row are known.
   CHART_NO_CHANGE: the message if no metric changes. */
#define CHART_NO_CHANGE                                                                                      \
    "no metric changes in the run that all are compared with: no error is known; name others (metrics: of "  \
    "the scene)"
bool chart_changes(const ChartRows *rows, const ChartRow *row);

/* Fills in the errors of the points from the one reference among the rows. Returns the floor's spread, the
   greatest distance between two floor rows, or NaN. */
double chart_rows_compare(ChartRows *rows);

/* True if no other point is both cheaper and more accurate. */
bool chart_on_front(const ChartRows *rows, int row);

/* chart_drawn: true if the row is a point with finite values. chart_opens_line: true if the row is the
   first of its line. Rows of one line differ only in spacing. */
bool chart_drawn(const ChartRow *row);
bool chart_same_line(const ChartRow *a, const ChartRow *b);
bool chart_opens_line(const ChartRows *rows, int row);

/* method, backend, swept values and "long steps" */
enum { CHART_NAME = CHART_SWEPT + 128 };
void chart_line_name(const ChartRow *row, char name[CHART_NAME]);

/* Returns the order of the line opened by row `first`: the slope of log error over log spacing. NaN if no
   order can be found; *why has the reason. `floor` as in chart_draw. */
double chart_order(const ChartRows *rows, int first, double floor, const char **why);

typedef struct ChartWords {
    const char *title, *error; /* meaning of the error */
    const char *note;          /* below the title; "" */
} ChartWords;

/* Draws the two charts: error over cost with the front, error over spacing with the order. `floor`: the
   spread (NaN: none). */
bool chart_draw(const ChartRows *rows, const ChartWords *words, double floor, const char *path, Error *error);

/* Subject of `slosh chart` and `slosh fit`: a case, or a scene over time. */

typedef struct ChartSubject {
    const Case *of;                /* or NULL: see scene */
    const char *scene;             /* name for scene_load */
    double time;                   /* s, of a scene */
    const SceneSettings *settings; /* of the command line */
} ChartSubject;

/* Finds the command line's scene or case (a case if the name fits both), and loads the scene as the
   command line sets it; for a case with its first method. `subject` points into `args`. Returns false with
   the reason. */
bool chart_subject_find(const Args *args, ChartSubject *subject, Scene *scene, Notes *notes, Error *error);

/* Returns the last setting of the key on the command line, or NULL. */
const char *chart_set_value(const SceneSettings *settings, const char *key);

/* Fills in a text such as "centre_of_mass and kinetic_energy, rms over range". */
void chart_error_name(const ChartSubject *subject, const Scene *scene, char name[256]);

/* Makes one row of a chart: a case, or a scene over time. */

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

/* Fills in settings, and row's step, swept values and spacing. The spacing is set to a value with whole
   layers in the fills. `scene` is scratch space. A case puts its own settings first. */
bool chart_settings(const ChartSubject *subject, const ChartJob *job, RunSettings *settings, Scene *scene,
                    ChartRow *row, Error *error);

/* Loads the scene of a job, and fills in row's key, method, backend, step and spacing. The scene's notes
   go to `notes`, unless NULL or a case. */
bool chart_prepare(const ChartSubject *subject, const ChartJob *job, Scene *scene, ChartRow *row,
                   Notes *notes, Error *error);

/* Runs the job into `row`, filled in by chart_prepare before. A broken simulation leaves seconds and error
   NaN, with the reason in the outcome. Returns false on any other failure or a signal. */
bool chart_run(const ChartSubject *subject, const ChartJob *job, ChartRow *row, const ProgressPart *part,
               Error *error);

/* --sweep of `slosh chart`: one series per combination of values; particles.spacing gives the axis
   instead. */

enum { CHART_SPACINGS = 8, SWEPT_TEXT = 192, SWEEP_NAMES_MAX = 8 };

/* All swept keys but method, backend and spacing, with their values. */
typedef struct ChartSweeps {
    int count;
    const char *key[CHART_SWEEPS];
    int values[CHART_SWEEPS];
    char text[CHART_SWEEPS][ARGS_SWEEP_VALUES_MAX][SWEPT_TEXT]; /* "--sweep key=value" */
    bool effective[CHART_SWEEPS];                               /* with at least one method */
} ChartSweeps;

/* Returns the values of --sweep, or else of the last setting, for a key such as solver.method, and their
   count; 0 if the command line does not set the key. */
int sweep_names(const Args *args, const char *key, const char *names[SWEEP_NAMES_MAX]);

/* Plan of `slosh chart`: methods x backends x swept values x steps x spacings; for a scene also the
   reference and the floor. */

enum { CHART_JOBS_MAX = 200, CHART_NAMES_MAX = SWEEP_NAMES_MAX };

typedef struct ChartPlan {
    const Args *args;
    ChartSubject subject;
    Scene scene; /* as set by the command line; for a case with its first method */
    Notes notes; /* of the scene */
    ChartSweeps sweeps;
    int coarsening_count;
    double coarsenings[CHART_SPACINGS]; /* times the scene's spacing, coarsest first */
    char note[256];                     /* the left out backends and the reason; or "" */
    Headless *context;                  /* NULL unless needed to know; of the caller */
    bool wants_context;
    int count;
    ChartJob jobs[CHART_JOBS_MAX];
    double work[CHART_JOBS_MAX]; /* estimated time of each job, up to a factor of its method and backend */
} ChartPlan;

/* Makes the plan. Returns false with the reason if the command line or the scene is wrong. Backends: those
   of the command line; else the scene's own, `cpu`, and the GPU backends if there is a GPU. A software
   renderer would take ten times as long or more, and not represent a GPU. */
bool chart_plan_make(const Args *args, ChartPlan *plan, Error *error);

/* Estimates the time of job `i`, s, from the runs in `rows` with the same method and backend, else from
   other runs. Without such runs the unit is arbitrary. */
double chart_plan_seconds(const ChartPlan *plan, int i, const Trials *rows);

/* Reports of `slosh chart`: a table, JSON. */

/* Prints one line per row; of the floor only the spread. */
void chart_print(const ChartRows *rows, double floor, FILE *file);

/* {"chart": subject, "error_of": error_name, "floor", "orders": [...], "runs": [...], "error": failure};
   unknown values are null. `failure`: why there is no chart, or NULL. */
json_t *chart_json(const ChartRows *rows, const char *subject, const char *error_name, double floor,
                   const char *failure);

#endif
