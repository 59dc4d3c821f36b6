/* Known flows: a case of `slosh validate` is a scene, what is measured of it, and a reference.

   All cases run with the same solver parameters: their scenes have `solver.preset: accurate`, besides
   geometry, fluids and a sound speed of ten times max(U, sqrt(g H)); what a method needs besides stands in
   its CaseMethod. Each is one const Case in a file of app/case; app/case/all.h lists them. */
#ifndef SLOSH_CASE_H
#define SLOSH_CASE_H

#include "app/metric/cloud.h"
#include "app/metric/curve.h"
#include "app/probe/probe.h"
#include "sim/world/world.h"

enum {
    CASE_METRICS = 4,
    CASE_METHODS = 8,
    CASE_SETTINGS = 3,
    CASE_COLUMNS = 8,
    CASE_CURVES = 3,
    CASE_PROBES = 8
};

/* How finely a case runs, and which tolerances hold. */
typedef enum CaseLevel { CASE_COARSE, CASE_DEFAULT, CASE_FULL, CASE_LEVELS } CaseLevel;

typedef struct CaseMetric {
    const char *name;
    const char *unit;    /* of value and reference; "" for pure numbers */
    double tolerance;    /* of the error, a fraction */
    double coarse;       /* at CASE_COARSE */
    const char *without; /* what a run without a value means, in words; NULL: nothing in particular */
    bool no_verdict;     /* shown beside its reference, which no run is to reach: it has no tolerance */
} CaseMetric;

/* How a case runs with a method. */
typedef struct CaseMethod {
    const char *name;
    const char *left_out;           /* why it does not, unless it is asked for; NULL: it runs */
    const char *set[CASE_SETTINGS]; /* settings of its own, as --set takes them, ended by NULL */
    double tolerance[CASE_METRICS], coarse[CASE_METRICS]; /* of the metrics; 0: the metric's own */
    const char *why[CASE_METRICS]; /* of a figure that is known to miss: what of, in words */
} CaseMethod;

/* What a metric gave. */
typedef struct Figure {
    double value, reference;
    double error; /* a fraction: of the reference, or of the scale that the case names; NaN: not measured */
} Figure;

/* What the plot of a case shows. */
typedef struct CasePlot {
    const char *x, *y;                 /* labels, with units */
    const char *found[CASE_CURVES];    /* names of what was simulated; NULL: one less */
    const char *expected[CASE_CURVES]; /* of what it is compared with */
    bool dots;                         /* what was simulated is dots: particles */
    bool points;                       /* the reference is points, as published; else lines */
} CasePlot;

typedef struct Case Case;

/* One case, run with one method on one backend: what its functions work on. */
typedef struct CaseRun {
    const Case *of;
    const WorldDef *def; /* the scene as resolved */
    CaseLevel level;
    WorldInfo info; /* of the present state */
    Cloud cloud;
    Probes *probes;                                  /* of the scene; NULL: it has none */
    bool feels;                                      /* one of them is a force */
    float probe[CASE_PROBES];                        /* their columns, of the state in `cloud` */
    Curve column[CASE_COLUMNS];                      /* over time, by the case's `sample` */
    Curve found[CASE_CURVES], expected[CASE_CURVES]; /* for the plot, by its `judge` */
    Figure figures[CASE_METRICS];
} CaseRun;

/* The state at the start: arrays as in InitialState, that begin as the scene's own start. */
typedef struct CaseStart {
    size_t count;
    float *position, *velocity; /* 3 a particle */
    float *density;             /* for methods whose particles carry it */
    const uint8_t *fluid;
} CaseStart;

struct Case {
    const char *name, *help;
    const char *scene;                /* as scene_load takes it */
    bool only_full;                   /* too long for the other levels: left out unless it is named */
    const char *setting;              /* of the case itself, as --set takes it; or NULL */
    CaseMethod methods[CASE_METHODS]; /* its best one first; ended by a NULL name */
    double spacing[CASE_LEVELS];      /* m */
    double time, every;               /* simulated, and from sample to sample, s */
    CaseMetric metrics[CASE_METRICS]; /* ended by a NULL name */
    CasePlot plot;
    void (*start)(const WorldDef *def, CaseStart *start); /* NULL: as the scene has it */
    void (*sample)(CaseRun *run);                         /* adds to the columns; NULL: none */
    bool (*judge)(CaseRun *run, Error *error);            /* at the end: fills figures, found and expected */
};

/* Ended by NULL. */
extern const Case *const case_list[];

/* NULL with the reason, which names the one that may be meant, and lists them, when there is none of that
 * name. */
const Case *case_find(const char *name, Error *error);

/* The name of a case that may have been meant by that word; NULL: none. */
const char *case_near(const char *word);

/* How a figure compares: |value - reference| / |reference|. */
Figure figure_relative(double value, double reference);

/* The same over a scale: (value - reference) / scale, for a reference of 0. */
Figure figure_scaled(double value, double reference, double scale);

/* The worse of two misses; NaN, not measured, is the worst. */
double figure_worse(double a, double b);

/* Of metric `m`; NaN: it has none. */
double case_tolerance(const Case *of, int m, CaseLevel level, const char *method);

/* How it runs with that method; NULL: nothing is known of it. */
const CaseMethod *case_method(const Case *of, const char *method);

#endif
