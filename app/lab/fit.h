/* Searches settings: the cheapest within an error, or the most accurate within a cost. Knows nothing about
   fluids: a setting is a place on each of some axes; its cost and error are requested one setting at a
   time, as rarely as possible.

   Order: 1. The unchanged scene. 2. Each line (a combination of the axes FIT_LINE, remaining axes
   unchanged) along the ladder from coarse to fine, until a rung is within the bound. 3. From the best of
   each line, the columns one step away along another axis, from their finest rung with a chance to be
   cheaper. A column has all settings that differ along the ladder alone. 4. From the best of all, the
   columns two steps away.

   A setting is not run if its predicted cost is more than FIT_MARGIN times the cost to beat. Prediction:
   the cost of the nearest finished setting of the same line, times the ratio of work.

   The best setting is checked twice. Errors fall with the spacing: if the next finer rung is outside the
   bound on the error, luck brought the setting within, and the setting is rejected. Then the run is
   repeated; a repeat beyond the bound also rejects. */
#ifndef APP_LAB_FIT_H
#define APP_LAB_FIT_H

#include "app/lab/error_chart.h"

#include <stdbool.h>
#include <stddef.h>

enum { FIT_AXES = 12, FIT_VALUES = 10, FIT_TRIES = 200 };

/* Predictions are off by about this factor. */
#define FIT_MARGIN 1.2

typedef struct FitPoint {
    int at[FIT_AXES]; /* a place on each axis */
} FitPoint;

typedef enum FitAxisKind {
    FIT_LINE,    /* names, each with its own ladder */
    FIT_LADDER,  /* one axis, from coarse to fine; cost grows along the axis */
    FIT_ORDERED, /* steps go to adjacent places */
    FIT_FREE     /* steps go to all places */
} FitAxisKind;

typedef struct FitAxis {
    FitAxisKind kind;
    int values, own; /* count of places; place of the unchanged scene */
} FitAxis;

typedef struct FitFigures {
    double cost;  /* any unit; NaN: the run broke */
    double error; /* a fraction; NaN: unknown */
    bool holds;   /* true if the setting may be chosen */
    int row;      /* for use by the callbacks */
} FitFigures;

typedef struct FitSpace {
    int axes;
    FitAxis axis[FIT_AXES];
    double scatter; /* errors with a smaller difference count as equal; 0: none do */
    double power;   /* cost grows as spacing^-power: dimensions + 1 */
    /* Returns true if the setting exists and differs from all earlier requests. */
    bool (*exists)(void *of, const FitPoint *point);
    /* Estimates the work, relative to other settings of the same line. */
    double (*work)(void *of, const FitPoint *point);
    /* Runs a setting; returns false to end the search. */
    bool (*run)(void *of, const FitPoint *point, double predicted, FitFigures *figures);
    /* Repeats a setting: `worst` gets the greatest error of all repeats, *holds is true if all repeats
       hold, and a longer run, too. NULL: no repeats. */
    bool (*repeat)(void *of, const FitPoint *point, const FitFigures *figures, double *worst, bool *holds);
    void *of;
} FitSpace;

/* One of the two bounds is INFINITY: the quantity to minimise. */
typedef struct FitGoal {
    double error, cost; /* bounds */
} FitGoal;

typedef enum FitFate {
    FIT_BEST,
    FIT_WITHIN, /* within the bound, but not better */
    FIT_BEYOND, /* outside the bound */
    FIT_BROKE,  /* broke, or does not hold */
    FIT_LUCK,   /* the next finer rung is beyond the bound */
    FIT_REPEAT, /* a repeat is beyond the bound */
    FIT_PRUNED  /* not run: predicted cost too high */
} FitFate;

typedef struct FitTry {
    FitPoint point;
    FitFigures figures;
    double predicted; /* cost; NaN: no prediction */
    double worst;     /* greatest error of the repeats; NaN: no repeats */
    double finer;     /* error of the next finer rung; NaN: not run */
    FitFate fate;
} FitTry;

typedef struct FitLadder {
    int count, best; /* best: index, or -1: no try is within the bound */
    bool full;       /* true: no room for further tries */
    FitTry tries[FIT_TRIES];
} FitLadder;

/* Searches. Returns false if `run` or `repeat` returned false; the ladder has the tries so far. */
bool fit_search(const FitSpace *space, const FitGoal *goal, FitLadder *ladder);

/* Returns the index of the try closest to the goal; -1: all broke. */
int fit_closest(const FitLadder *ladder, const FitGoal *goal);

/* The settings of a scene varied by `slosh fit`: each is one axis, in the order of
   FitAxisName. The first place of an axis FIT_FREE is the scene's own value.

   Only the computation of a flow may vary, never the flow: no viscosity, no surface tension, no speed of
   sound. */

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

/* The runs of `slosh fit`, one at a time, kept in a file like a chart's; no run is repeated. */

enum { FIT_REASONS = 64 };

typedef struct FitRuns {
    const FitAxes *axes;
    ExperimentRun *run; /* has the rows of the file */
    bool quiet;
    ChartRows used;          /* rows of this search, in the order of the requests */
    int there, made;         /* counts of runs taken from the file, and of new runs */
    ChartRow reference;      /* of a scene: compared with all runs */
    double floor;            /* greatest distance between runs with tiny jitters; NaN: a run broke */
    Notes own;               /* notes on the unchanged scene; settings with any further note are rejected */
    int warned;              /* count of settings rejected because of a note */
    char warning[NOTE_SIZE]; /* the first such note */
    int left_count;          /* count of distinct reasons for impossible settings; hashes: */
    uint64_t left_out[FIT_REASONS];
    Error error; /* why a run could not be made; "" after a signal */
} FitRuns;

/* Returns the count of CPU threads of the runs, which the costs depend on. */
int fit_threads(const Scene *scene);

/* Returns false with the reason if the scene or its reference cannot run. */
bool fit_runs_begin(const FitAxes *axes, ExperimentRun *run, FitRuns *runs, Error *error);

/* Runs the unchanged scene with small jitters, and sets `floor` to the spread. Returns false with
   runs->error. */
bool fit_runs_floor(FitRuns *runs);

/* Makes the finest run of a scene; does nothing for a case. Returns false with runs->error. */
bool fit_runs_reference(FitRuns *runs);

/* Fills in the callbacks of the search. Call after fit_runs_floor. */
void fit_runs_space(FitRuns *runs, FitSpace *space);

/* Request and results of `slosh fit`. */

/* Simulated time per frame of --frame-ms, s: the frame rate of a screen. */
#define FIT_FRAME (1.0 / 30)

/* The options of `slosh fit`: Args.own. */
typedef struct FitOptions {
    double error, frame_ms; /* percent, ms; 0: not given */
} FitOptions;

typedef struct FitPlan {
    const Args *args;
    ChartSubject subject;
    Scene scene; /* unchanged */
    Notes notes;
    FitAxes axes;
    FitGoal goal;
    char error_of[256]; /* meaning of the error */
    const char *output; /* file of the resulting scene */
    char command[1024]; /* approximately as typed by the user */
    FitRuns runs;
    FitLadder ladder;
} FitPlan;

/* Fills in the default of --output: NAME_fit.yaml in the current folder. */
void fit_default_output(const char *scene, char output[1024]);

/* Fills in NAME.yaml, and NAME.csv beside it. */
bool fit_name_files(const Args *args, char output[1024], char csv[1024], Error *error);

/* Makes the plan. Returns false with the reason if the command line or the scene is wrong. */
bool fit_plan_make(const Args *args, const char *output, FitPlan *plan, Error *error);

/* Returns the row of a finished try. */
const ChartRow *fit_plan_row(const FitPlan *plan, int i);

/* Returns the try of the unchanged scene; NULL: not run. */
const FitTry *fit_plan_own(const FitPlan *plan);

/* Fills in a text such as "within 5 %" or "within 0.6 s of computing a simulated second". */
void fit_goal_text(const FitPlan *plan, char *text, size_t size);

/* Reports of `slosh fit`: a table, JSON. */

/* Prints one line per run, in the order of the runs, with the reason for its choice or rejection; then the
   settings not run. */
void fit_print(const FitPlan *plan, FILE *file);

/* {"fit": subject, "error_of", "goal": {"error" or "frame_ms", "cost"}, "floor", "processor",
   "threads", "best": place in "runs" or null, "output", "runs": [...], "pruned": [...], "error": failure};
   unknown values are null. `failure`: why there is no scene, or NULL. */
json_t *fit_json(const FitPlan *plan, const char *failure);

/* Writes the scene found by `slosh fit`. */

/* Returns true if the file may be written: no such file exists, or an older fit wrote the file. Returns
   false with the reason. */
bool fit_scene_check(const char *path, Error *error);

/* Writes the scene with the chosen settings. Comments give the reason for the choice and the scene's old
   values. Leaves out keys made useless by the settings. The file is complete or not written at all. */
bool fit_scene_write(const FitPlan *plan, Error *error);

#endif
