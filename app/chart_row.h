/* One run of `slosh chart`: with which settings, how long it took, how far off it was. Rows are kept in a CSV
   file, so that a run already there is not repeated. */
#ifndef SLOSH_CHART_ROW_H
#define SLOSH_CHART_ROW_H

#include "sim/error.h"
#include "sim/world_def.h"

#include <stdio.h>

enum { CHART_TIMES = 40, CHART_QUANTITIES = 4, CHART_ROWS_MAX = 256 };

/* Why a run is made. */
typedef enum ChartRole {
    CHART_POINT,     /* a point of the chart */
    CHART_REFERENCE, /* the finest run of a scene that has no other reference */
    CHART_FLOOR      /* one of three that differ by a millionth of a spacing */
} ChartRole;

typedef struct ChartRow {
    uint64_t key; /* of all that the run depends on */
    ChartRole role;
    char method[NAME_SIZE], backend[NAME_SIZE];
    char step[NAME_SIZE]; /* "number 0.3" or "substeps 20" */
    int fineness;         /* of the step: rows of the same one are one line of the convergence */
    double spacing;       /* m */
    size_t particles;
    double seconds;    /* of computing, a simulated second; NaN: it broke */
    double error;      /* NaN: not known */
    char failure[128]; /* why it broke; "" where it did not, and in rows that were read */
    double series[CHART_TIMES]
                 [CHART_QUANTITIES]; /* of a scene: centre x y z, kinetic energy, at even times */
} ChartRow;

typedef struct ChartRows {
    int count;
    ChartRow row[CHART_ROWS_MAX];
} ChartRows;

/* The whole rows of an older run; none where there is no such file, or it is empty. False with the reason
   where the file is no chart's: it is not to be replaced. */
bool chart_rows_read(ChartRows *rows, const char *path, Error *error);

/* Adds a row, in place of the oldest that is none of `plan` where there is no room. */
void chart_rows_add(ChartRows *rows, const ChartRow *row, const ChartRows *plan);

/* Adds the rows that the file has got since it was read, from another chart under the same name. */
void chart_rows_merge(ChartRows *rows, const char *path, const ChartRows *plan);

/* Writes all rows, whole or not at all. */
bool chart_rows_write(const ChartRows *rows, const char *path, Error *error);

/* NULL where there is none. */
const ChartRow *chart_rows_find(const ChartRows *rows, uint64_t key);

/* The reference among them, or NULL: none, or it broke. */
const ChartRow *chart_rows_reference(const ChartRows *rows);

/* rms over time of the distance of two rows' series, each quantity over its range in `reference`, and the
   mean of the two quantities: centre of mass and kinetic energy. */
double chart_distance(const ChartRow *row, const ChartRow *reference);

/* Fills the errors of the points from the one reference among them; the spread of the floor's, the greatest
   distance of two of them, or NaN. */
double chart_rows_compare(ChartRows *rows);

/* Whether no other point is both cheaper and nearer. */
bool chart_on_front(const ChartRows *rows, int row);

/* The two charts: error over cost with the front, error over spacing with the order. `error_name` is what the
   error is of, `floor` the spread (NaN: none). */
bool chart_draw(const ChartRows *rows, const char *title, const char *error_name, double floor,
                const char *path, Error *error);

#endif
