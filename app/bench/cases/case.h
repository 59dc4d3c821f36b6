/* Published figures from a CSV file of scenes/reference: lines starting with '#' (the citation), a line of
   column names, rows. */
#ifndef APP_BENCH_CASES_CASE_H
#define APP_BENCH_CASES_CASE_H

#include "app/base/program.h"
#include "app/run/measure/measure.h"
#include "app/scene/scene.h"
#include "sim/error.h"
#include "sim/world.h"

#include <stdbool.h>

enum { REFERENCE_COLUMNS = 8, REFERENCE_ROWS = 256, REFERENCE_CELL = 32, REFERENCE_NOTES = 512 };

typedef struct Reference {
    char path[1024];
    char notes[REFERENCE_NOTES]; /* the lines starting with '#', without the '#' */
    int columns, rows;
    char column[REFERENCE_COLUMNS][REFERENCE_CELL];
    char cell[REFERENCE_ROWS][REFERENCE_COLUMNS][REFERENCE_CELL];
} Reference;

/* Loads a reference; `name` as in scene_path_find. Returns false with "file:line: ...". */
bool reference_load(const char *name, Reference *reference, Error *error);

/* Returns a cell as text, "" if there is no such column; as a number, NaN if not a number. */
const char *reference_text(const Reference *reference, int row, const char *column);
double reference_number(const Reference *reference, int row, const char *column);

/* Known flows: a case of `slosh validate` has a scene, measurements, and a reference.

   All cases run with the same solver parameters. Their scenes have `solver.preset: accurate`, geometry,
   fluids and a sound speed of ten times max(U, sqrt(g H)); further settings for a method are in its
   CaseMethod. Each case is one const Case in a file of this folder; app/bench/cases/case_list.h lists the
   cases.
 */

enum {
    CASE_METRICS = 4,
    CASE_METHODS = 8,
    CASE_SETTINGS = 3,
    CASE_COLUMNS = 8,
    CASE_CURVES = 3,
    CASE_PROBES = 8
};

/* Resolution of a case, and choice of tolerances. */
typedef enum CaseLevel { CASE_COARSE, CASE_DEFAULT, CASE_FULL, CASE_LEVELS } CaseLevel;

typedef struct CaseMetric {
    const char *name;
    const char *unit;    /* of value and reference; "" for pure numbers */
    double tolerance;    /* of the error, a fraction */
    double coarse;       /* at CASE_COARSE */
    const char *without; /* words for a run without a value; NULL: none */
    bool no_verdict;     /* shown beside its reference, without tolerance: no run is to reach the reference */
} CaseMetric;

/* How a case runs with a method. */
typedef struct CaseMethod {
    const char *name;
    const char *left_out;           /* why the method is skipped unless named; NULL: not skipped */
    const char *set[CASE_SETTINGS]; /* the method's settings in the form of --set, ended by NULL */
    double tolerance[CASE_METRICS], coarse[CASE_METRICS]; /* of the metrics; 0: the metric's own tolerance */
    const char *why[CASE_METRICS];                        /* known cause of a miss, in words */
} CaseMethod;

/* Result of a metric. */
typedef struct CaseFigure {
    double value, reference;
    double error; /* a fraction of the reference, or of a scale named by the case; NaN: not measured */
} CaseFigure;

/* Labels and style of a case's plot. */
typedef struct CasePlot {
    const char *x, *y;                 /* labels, with units */
    const char *found[CASE_CURVES];    /* names of the simulated curves; ended by NULL */
    const char *expected[CASE_CURVES]; /* names of the reference curves */
    bool dots;                         /* simulated curves are drawn as dots: particles */
    bool points;                       /* the reference is drawn as published points; else lines */
} CasePlot;

typedef struct Case Case;

/* One run of a case with a method on a backend: arguments of the case's functions. */
typedef struct CaseRun {
    const Case *of;
    const WorldDef *def; /* the resolved scene */
    CaseLevel level;
    WorldInfo info; /* of the present state */
    Cloud cloud;
    Probes *probes;                                  /* of the scene; or NULL */
    bool wants_forces;                               /* true if a probe measures force */
    float probe[CASE_PROBES];                        /* columns of the probes, for the state in `cloud` */
    Curve column[CASE_COLUMNS];                      /* over time, filled in by the case's `sample` */
    Curve found[CASE_CURVES], expected[CASE_CURVES]; /* for the plot, filled in by the case's `judge` */
    CaseFigure figures[CASE_METRICS];
} CaseRun;

/* State at the start: arrays as in InitialState, initialised to the scene's own start. */
typedef struct CaseStart {
    size_t count;
    float *position, *velocity; /* 3 per particle */
    float *density;             /* for methods with density as a state variable */
    const uint8_t *fluid;
} CaseStart;

struct Case {
    const char *name, *help;
    const char *scene;                /* name for scene_load */
    bool only_full;                   /* too long for other levels: skipped there unless named */
    const char *setting;              /* the case's setting in the form of --set; or NULL */
    CaseMethod methods[CASE_METHODS]; /* best method first; ended by a NULL name */
    double spacing[CASE_LEVELS];      /* m */
    double time, every;               /* simulated time, and interval of samples, s */
    CaseMetric metrics[CASE_METRICS]; /* ended by a NULL name */
    CasePlot plot;
    void (*start)(const WorldDef *def, CaseStart *start); /* NULL: the scene's own start */
    void (*sample)(CaseRun *run);                         /* adds to the columns; or NULL */
    bool (*judge)(CaseRun *run, Error *error);            /* at the end: sets figures, found, expected */
};

/* Ended by NULL. */
extern const Case *const case_list[];

/* Finds a case by name. If there is none, returns NULL with the reason, which suggests a similar name and
   lists all names. */
const Case *case_find(const char *name, Error *error);

/* Returns the name of a case similar to the word, or NULL. */
const char *case_suggest(const char *word);

/* Makes a figure with the error |value - reference| / |reference|. */
CaseFigure figure_relative(double value, double reference);

/* Makes a figure with the error (value - reference) / scale, for a reference of 0. */
CaseFigure figure_scaled(double value, double reference, double scale);

/* Returns the greater of two errors; NaN, not measured, counts as greatest. */
double figure_worse(double a, double b);

/* Returns the tolerance of metric `m`; NaN if the metric has no verdict. */
double case_tolerance(const Case *of, int m, CaseLevel level, const char *method);

/* Returns the CaseMethod of a method; NULL: unknown. */
const CaseMethod *case_method(const Case *of, const char *method);

/* Runs one case with one method on one backend. */

typedef struct CaseSetup {
    const Case *of;
    CaseLevel level;
    const char *method;
    const SceneSettings *settings; /* of the command line, applied last */
    /* Called with each sampled state, which is sound; or NULL. */
    void (*watch)(void *watcher, const WorldDef *def, World *world);
    void *watcher;
    Notes *notes; /* gets notes on the scene; or NULL */
} CaseSetup;

typedef struct CaseResult {
    const Case *of;
    CaseLevel level;
    Scene scene;
    CaseRun run; /* figures and curves; without the cloud */
    size_t particles;
    double seconds;      /* total wall time */
    double step_seconds; /* of the steps only */
    char failure[256];   /* why there are no figures; "" on success */
} CaseResult;

/* Loads the case's scene with the spacing of the level, or of --particles, the method and the settings. */
bool case_scene(const CaseSetup *setup, Scene *scene, Error *error);

/* Runs a case. `progress` goes from `done` to `done + part`. A broken simulation is a result too, with
   `failure` set. Returns false if a reference can't be read, memory is short, or a signal came (without
   message). The caller makes a current context if the backend needs one. Call case_result_free in any
   case. */
bool case_run(const CaseSetup *setup, Progress *progress, double done, double part, CaseResult *result,
              Error *error);
void case_result_free(CaseResult *result);

/* True if a metric's error is within its tolerance. */
bool case_passed(const CaseResult *result, int metric);

#endif
