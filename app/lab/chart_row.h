/* One run of `slosh chart`: with which settings, how long it took, how far off it was. Rows are kept in a CSV
   file, so that a run already there is not repeated; its last column has, of a scene, the numbers of the
   metrics at CHART_TIMES even times: numbers parted by blanks, times by semicolons. */
#ifndef SLOSH_CHART_ROW_H
#define SLOSH_CHART_ROW_H

#include "app/metric/metric_list.h"
#include "app/outcome/outcome.h"
#include "app/scene/scene.h"

#include <stdio.h>

enum {
    CHART_TIMES = 40,
    CHART_QUANTITIES = SCENE_METRICS_MAX * METRIC_NUMBERS + METRIC_PROBES,
    CHART_ROWS_MAX = 256,
    CHART_SWEPT = 128
};

/* Why a run is made. */
typedef enum ChartRole {
    CHART_POINT,     /* a point of the chart */
    CHART_REFERENCE, /* the finest run of a scene that has no other reference */
    CHART_FLOOR,     /* one of three that differ by a millionth of a spacing */
    CHART_LONG       /* three times as long, to see whether it holds: slosh fit */
} ChartRole;

typedef struct ChartRow {
    uint64_t key; /* of all that the run depends on */
    ChartRole role;
    char method[NAME_SIZE], backend[NAME_SIZE];
    char step[NAME_SIZE];    /* "number 0.3" or "substeps 20" */
    char swept[CHART_SWEPT]; /* "support=2.6 kernel=cubic"; "" */
    int fineness;            /* of the step: rows of the same one are one line of the convergence */
    double spacing;          /* m */
    size_t particles;
    double seconds;  /* of computing, a simulated second; NaN: it broke */
    double error;    /* NaN: not known */
    uint64_t steps;  /* of a scene, in all; the file does not keep it: 0 then */
    Outcome outcome; /* how it went; of OUTCOME_NONE that it has not been run */
    unsigned backs;  /* times that the sentinel went back */
    int quantities;  /* of a scene: the numbers of its metrics, one after the other, at even times; else 0 */
    double series[CHART_TIMES][CHART_QUANTITIES];
} ChartRow;

typedef struct ChartRows {
    int metric_count, metrics[SCENE_METRICS_MAX]; /* that a scene's runs are compared by, as Scene has them */
    int probe_count;                              /* of the scene */
    int count;
    ChartRow row[CHART_ROWS_MAX];
} ChartRows;

/* The sound rows of an older run; none where there is no such file, or it is empty. Each other row, or
   that the file is of another version, is told to `warnings` (NULL: to nobody). False with the reason where
   the file is no chart's, or cannot be read: it is not to be replaced.
 */
bool chart_rows_read(ChartRows *rows, const char *path, FILE *warnings, Error *error);

/* Adds a row, in place of the one with its key; where there is no room, of the oldest that is none of `plan`.
 */
void chart_rows_add(ChartRows *rows, const ChartRow *row, const ChartRows *plan);

/* Adds the rows that the file has got since it was read, from another chart under the same name. */
void chart_rows_merge(ChartRows *rows, const char *path, const ChartRows *plan);

/* Writes all rows, whole or not at all. */
bool chart_rows_write(const ChartRows *rows, const char *path, Error *error);

/* NULL where there is none. */
const ChartRow *chart_rows_find(const ChartRows *rows, uint64_t key);

/* The reference among them, or NULL: none, or it broke. */
const ChartRow *chart_rows_reference(const ChartRows *rows);

/* How far a row is from the reference: the mean over the metrics of rms over time over the metric's range in
   `reference`; times at which either has none are left out, and a metric that does not change in the
   reference. NaN where no metric changes in the reference, a metric was at no time in both, or a row has not
   the numbers of these metrics. */
double chart_distance(const ChartRows *rows, const ChartRow *row, const ChartRow *reference);

/* Whether distances from that row are known: a metric changes in it. What to say where none does. */
#define CHART_NO_CHANGE                                                                                      \
    "no metric changes in the run that all are compared with: no error is known; name others (metrics: of "  \
    "the scene)"
bool chart_changes(const ChartRows *rows, const ChartRow *row);

/* Fills the errors of the points from the one reference among them; the spread of the floor's, the greatest
   distance of two of them, or NaN. */
double chart_rows_compare(ChartRows *rows);

/* Whether no other point is both cheaper and nearer. */
bool chart_on_front(const ChartRows *rows, int row);

/* Whether the row is a point that can be drawn, and the first of its line: rows of one line differ in nothing
   but the spacing. */
bool chart_drawn(const ChartRow *row);
bool chart_same_line(const ChartRow *a, const ChartRow *b);
bool chart_opens_line(const ChartRows *rows, int row);

/* method, backend, what is swept and "long steps" */
enum { CHART_NAME = CHART_SWEPT + 128 };
void chart_line_name(const ChartRow *row, char name[CHART_NAME]);

/* The order of the line that the row `first` opens: the slope of log error over log spacing. NaN where there
   is none to be seen, and *why says it. `floor` as of chart_draw. */
double chart_order(const ChartRows *rows, int first, double floor, const char **why);

typedef struct ChartWords {
    const char *title, *error; /* what the error is of */
    const char *note;          /* below the title; "" */
} ChartWords;

/* The two charts: error over cost with the front, error over spacing with the order. `floor`: the spread
   (NaN: none). */
bool chart_draw(const ChartRows *rows, const ChartWords *words, double floor, const char *path, Error *error);

#endif
