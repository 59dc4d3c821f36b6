/* Table of probe readings over a run: CSV, one row per step, growing with the run. Columns: `time [s]`,
   then the columns of the probes with units, "wall.pressure [Pa]". With an averaging time, each column is
   followed by its mean, "wall.pressure_mean [Pa]" (app/probe/probe_window.h). A field without a number is
   empty. */
#ifndef SLOSH_PROBE_TABLE_H
#define SLOSH_PROBE_TABLE_H

#include "app/probe/probe.h"

#include "app/base/output.h"
#include "app/probe/probe_window.h"

#include <jansson.h>
#include <stdio.h>

/* Statistics of a column over the whole table. */
typedef struct ProbeFigures {
    size_t rows; /* rows with a number */
    double sum, least, most;
} ProbeFigures;

/* Zero-initialise before use. */
typedef struct ProbeTable {
    FILE *file; /* NULL: no table */
    OutputLock lock;
    char path[1024];
    const Probes *probes;
    int columns;           /* count of probe columns */
    double last;           /* time of the last row, s; less than 0: no rows */
    ProbeWindow window;    /* of written rows */
    ProbeFigures *figures; /* one per probe column */
    size_t waiting, room;  /* rows not written yet, and their capacity */
    double *time;          /* s, */
    float *value;          /* `columns` per row */
} ProbeTable;

/* Returns true if a table may be written to the path: no file, an empty file, or a table of any scene's
   probes. Returns false with the reason. */
bool probe_table_check(const char *path, Error *error);

/* Opens the table of the given probes, which must outlive the table. Starts a new table; or with `keep`
   (s) at least 0, keeps the rows up to time `keep` of an existing table. Returns false with the reason:
   the file cannot be written, another slosh writes the file, or the file has other contents, which stay. */
bool probe_table_open(ProbeTable *table, const char *path, const Probes *probes, double keep, Error *error);

/* Adds a waiting row, as the step may be taken back. Returns false if memory is short. */
bool probe_table_add(ProbeTable *table, double time, const float value[]);

void probe_table_drop(ProbeTable *table);                /* drops waiting rows */
bool probe_table_write(ProbeTable *table, Error *error); /* writes waiting rows to the file */

/* Closes the table; does nothing if not open. */
bool probe_table_close(ProbeTable *table, Error *error);

/* Returns {"wall.pressure": {"unit", "rows", "mean", "min", "max"}, ...}: means over rows. Returns NULL if
   memory is short. */
json_t *probe_table_json(const ProbeTable *table);

void probe_table_free(ProbeTable *table); /* call after probe_table_close */

#endif
