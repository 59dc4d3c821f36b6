/* What probes read over a run, as a table: CSV, a row a step, that grows as the run does. Columns: `time
   [s]`, then those of the probes with their units, "wall.pressure [Pa]"; where a probe asks for an average
   each of its columns is followed by that mean, "wall.pressure_mean [Pa]" (app/probe/probe_window.h). A field
   without a number is empty. */
#ifndef SLOSH_PROBE_TABLE_H
#define SLOSH_PROBE_TABLE_H

#include "app/base/output_lock.h"
#include "app/probe/probe.h"
#include "app/probe/probe_window.h"

#include <jansson.h>
#include <stdio.h>

/* Of a column over the whole table. */
typedef struct ProbeFigures {
    size_t rows; /* that have a number */
    double sum, least, most;
} ProbeFigures;

/* Zero-initialise it. */
typedef struct ProbeTable {
    FILE *file; /* NULL: there is none */
    OutputLock lock;
    char path[1024];
    const Probes *probes;
    int columns;           /* of the probes */
    double last;           /* time of its last row, s; less than 0: it has none */
    ProbeWindow window;    /* of rows that are written */
    ProbeFigures *figures; /* one a column of the probes */
    size_t waiting, room;  /* rows that are not written yet, and that there is memory for */
    double *time;          /* s, */
    float *value;          /* `columns` a row */
} ProbeTable;

/* Whether a table may begin there: no file, an empty one, or a table of some scene's probes. False with the
   reason. */
bool probe_table_check(const char *path, Error *error);

/* Opens the table of these probes, which outlive it: anew, or with `keep` (s) not less than 0 behind the rows
   up to then, where there is such a table. False with the reason: it cannot be written, another slosh writes
   it, or what is there is something else, which stays as it is. */
bool probe_table_open(ProbeTable *table, const char *path, const Probes *probes, double keep, Error *error);

/* Adds a row, which waits: the step may be taken back. False when memory is short. */
bool probe_table_add(ProbeTable *table, double time, const float value[]);

void probe_table_drop(ProbeTable *table);                /* the rows that wait */
bool probe_table_write(ProbeTable *table, Error *error); /* them; they are in the file then */

/* Nothing where there is none. */
bool probe_table_close(ProbeTable *table, Error *error);

/* {"wall.pressure": {"unit", "rows", "mean", "min", "max"}, ...}: means over rows. NULL without memory. */
json_t *probe_table_json(const ProbeTable *table);

void probe_table_free(ProbeTable *table); /* after the close */

#endif
