/* One run of `slosh chart`: its settings, its computing time, its error. Rows are kept in a CSV file, so
   that no run is repeated. The last column, for a scene, has the numbers of the metrics at CHART_TIMES
   even times: numbers separated by blanks, times by semicolons. */
#ifndef SLOSH_CHART_ROW_H
#define SLOSH_CHART_ROW_H

#include "app/run/measure/metric.h"
#include "app/run/measure/outcome.h"
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

typedef struct ChartRows {
    int metric_count, metrics[SCENE_METRICS_MAX]; /* metrics to compare a scene's runs by, as in Scene */
    int probe_count;                              /* of the scene */
    int count;
    ChartRow row[CHART_ROWS_MAX];
} ChartRows;

/* Reads the sound rows of an older run; zero rows if the file is missing or empty. Each unsound row, or a
   file of another version, is reported to `warnings` (may be NULL). Returns false with the reason if the
   file cannot be read or is no chart's; such a file must not be replaced. */
bool chart_rows_read(ChartRows *rows, const char *path, FILE *warnings, Error *error);

/* Adds a row, replacing the row with the same key. If there is no room, replaces the oldest row outside
   `plan`. */
void chart_rows_add(ChartRows *rows, const ChartRow *row, const ChartRows *plan);

/* Adds the rows written to the file since it was read, by another chart under the same name. */
void chart_rows_merge(ChartRows *rows, const char *path, const ChartRows *plan);

/* Writes all rows; the file is complete or not written at all. */
bool chart_rows_write(const ChartRows *rows, const char *path, Error *error);

/* Returns the row with the key, or NULL. */
const ChartRow *chart_rows_find(const ChartRows *rows, uint64_t key);

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

#endif
