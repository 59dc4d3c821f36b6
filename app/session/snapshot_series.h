/* Snapshots of a session at regular times: what `run` and `replay` write. */
#ifndef SLOSH_SNAPSHOT_SERIES_H
#define SLOSH_SNAPSHOT_SERIES_H

#include "app/output/snapshot.h"
#include "app/session/session.h"

typedef struct SnapshotSeries {
    Snapshot *file; /* not owned; NULL: none is written */
    double every;   /* s, more than 0 */
    double next;    /* multiple of `every` that is due next */
} SnapshotSeries;

/* Appends the present state if it is the first one at or after the multiple of `every` that is due. False
   with the reason: the file could not take it. */
bool snapshot_series_add(SnapshotSeries *series, const Session *session, Error *error);

/* After a failure: says on standard error what whole snapshots `path` holds. NULL is allowed. */
void snapshot_series_left(const Snapshot *file, const char *path);

/* Whether `path` is a name for snapshots, FILE.h5part: ParaView knows the format by it. */
bool snapshot_series_name(const char *path, Error *error);

/* Goes on behind the present state, which the file has. */
void snapshot_series_resume(SnapshotSeries *series, const Session *session);

#endif
