/* Forces on box and solids over a run (sim/world.h), as a CSV table with a row per frame. Columns:
   time (s), at the end of the row's mean, and length of the mean (s). Then for the box and for each solid by
   number: force_x, _y, _z (N) and torque_x, _y, _z (N m), along the box's axes. The box's torque is around
   the box's origin, a solid's around its centre. */
#ifndef APP_FILES_FORCES_LOG_H
#define APP_FILES_FORCES_LOG_H

#include "app/base/file.h"
#include "sim/world.h"

#include <jansson.h>
#include <stdio.h>

/* Zero-initialise before use. */
typedef struct ForcesLog {
    FILE *file; /* NULL: no table */
    Output output;
    OutputLock older, lock; /* on the file to replace, until then; on the table */
    bool named;             /* the table has its name; otherwise it is still a temporary file */
    int solids;
    Forces all; /* sum of all rows over time */
} ForcesLog;

/* Begins a table, which gets its name with the first row, or in forces_log_close: until then an older table
   stays. Rows of an existing table up to `keep` (s) are kept; a missing table is reported. Negative `keep`: a
   new run. Returns false with the reason: not writable, in use by another slosh, or a table with different
   columns. */
bool forces_log_open(ForcesLog *log, const char *path, int solids, double keep, Error *error);

/* Adds a row of means; none if no time has passed. The row is passed to the system, and survives a killed
   program. Returns false with the reason. */
bool forces_log_add(ForcesLog *log, double time, const Forces *mean, Error *error);

/* Completes the table; no effect without a table. */
bool forces_log_close(ForcesLog *log, Error *error);

/* Means over the run: {"seconds", "box": {"force": [3], "torque": [3]}, "solids": [the same]}. */
json_t *forces_log_json(const ForcesLog *log);

#endif
