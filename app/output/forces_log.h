/* What box and solids felt over a run (sim/matter/forces.h), as a table: CSV, a row a frame. Columns: time
   (s), at the end of what the row is the mean of; its length (s); of the box, then of each solid by its
   number, force_x, _y, _z (N) and torque_x, _y, _z (N m) in the box's axes: the box's torque about the box's
   origin, a solid's about its own centre. */
#ifndef SLOSH_FORCES_LOG_H
#define SLOSH_FORCES_LOG_H

#include "app/base/output_lock.h"
#include "sim/matter/forces.h"

#include <jansson.h>
#include <stdio.h>

/* Zero-initialise it. */
typedef struct ForcesLog {
    FILE *file; /* NULL: there is none */
    Output output;
    OutputLock older, lock; /* of what is replaced, until then; of the table */
    bool named;             /* the table has its name; else it is still a temporary file */
    int solids;
    Forces all; /* of all rows that were added, summed over time */
} ForcesLog;

/* Begins a table of so many solids that gets its name with its first row, or in forces_log_close: until then
   an older one stays. The rows that a table of that name has up to `keep` (s) stay, and that there is none is
   said: less than 0 for a new run. False with the reason: it can't be written, another slosh writes it, or
   what is there is another table. */
bool forces_log_open(ForcesLog *log, const char *path, int solids, double keep, Error *error);

/* Adds a row, of means; none where no time went by. It is the system's from then on: a program that is killed
   leaves it. False with the reason. */
bool forces_log_add(ForcesLog *log, double time, const Forces *mean, Error *error);

/* The table is whole; nothing where there is none. */
bool forces_log_close(ForcesLog *log, Error *error);

/* {"seconds", "box": {"force": [3], "torque": [3]}, "solids": [the same]}: the means of all. */
json_t *forces_log_json(const ForcesLog *log);

#endif
