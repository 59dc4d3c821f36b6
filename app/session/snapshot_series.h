/* Snapshots of a session at regular times: output of `run` and `replay`. */
#ifndef SLOSH_SNAPSHOT_SERIES_H
#define SLOSH_SNAPSHOT_SERIES_H

#include "app/session/session.h"

#include "app/files/snapshot.h"

typedef struct SnapshotSeries {
    SnapshotWriter *file; /* not owned; NULL: no snapshots */
    double every;         /* s, more than 0 */
    double next;          /* next due multiple of `every` */
} SnapshotSeries;

/* Appends the present state if it is the first at or after the due multiple of `every`. Returns false with
   the reason if writing fails. */
bool snapshot_series_add(SnapshotSeries *series, const Session *session, Error *error);

/* After a failure: reports the whole snapshots in `path` on standard error. NULL is allowed. */
void snapshot_series_left(const SnapshotWriter *file, const char *path);

/* True if `path` is a valid name for snapshots, FILE.h5part: ParaView finds the format by this suffix. */
bool snapshot_series_name(const char *path, Error *error);

/* Continues after the present state, which the file already has. */
void snapshot_series_resume(SnapshotSeries *series, const Session *session);

#endif
