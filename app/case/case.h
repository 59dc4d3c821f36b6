/* Known flows: a case of `slosh validate` has a scene, measurements, and a reference.

   All cases run with the same solver parameters. Their scenes have `solver.preset: accurate`, geometry,
   fluids and a sound speed of ten times max(U, sqrt(g H)); further settings for a method are in its
   CaseMethod. Each case is one const Case in a file of app/case; app/case/all.h lists the cases. */
#ifndef SLOSH_CASE_H
#define SLOSH_CASE_H

#include "app/run/measure/metric.h"
#include "app/run/measure/probe.h"
#include "sim/world/world.h"

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
typedef struct Figure {
    double value, reference;
    double error; /* a fraction of the reference, or of a scale named by the case; NaN: not measured */
} Figure;

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
    bool feels;                                      /* true if a probe measures force */
    float probe[CASE_PROBES];                        /* columns of the probes, for the state in `cloud` */
    Curve column[CASE_COLUMNS];                      /* over time, filled in by the case's `sample` */
    Curve found[CASE_CURVES], expected[CASE_CURVES]; /* for the plot, filled in by the case's `judge` */
    Figure figures[CASE_METRICS];
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
const char *case_near(const char *word);

/* Makes a figure with the error |value - reference| / |reference|. */
Figure figure_relative(double value, double reference);

/* Makes a figure with the error (value - reference) / scale, for a reference of 0. */
Figure figure_scaled(double value, double reference, double scale);

/* Returns the greater of two errors; NaN, not measured, counts as greatest. */
double figure_worse(double a, double b);

/* Returns the tolerance of metric `m`; NaN if the metric has no verdict. */
double case_tolerance(const Case *of, int m, CaseLevel level, const char *method);

/* Returns the CaseMethod of a method; NULL: unknown. */
const CaseMethod *case_method(const Case *of, const char *method);

#endif
