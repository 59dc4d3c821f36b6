#include "app/session/snapshot_series.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

void snapshot_series_resume(SnapshotSeries *series, const Session *session)
{
    series->next = fmax(series->next, floor(session->info.time / series->every + 1e-6)) + 1;
}

bool snapshot_series_add(SnapshotSeries *series, const Session *session, Error *error)
{
    if (!series->file || !session_reached(session, series->next * series->every))
        return true;
    if (!snapshot_append(series->file, session->world, error))
        return false;
    snapshot_series_resume(series, session);
    return true;
}

void snapshot_series_left(const SnapshotWriter *file, const char *path)
{
    if (file && snapshot_steps(file) > 0)
        fprintf(stderr, "%s: holds the %zu whole snapshot%s before that\n", path, snapshot_steps(file),
                plural(snapshot_steps(file)));
}

bool snapshot_series_name(const char *path, Error *error)
{
    const char *extension = strrchr(path, '.');
    return (extension && strcasecmp(extension, ".h5part") == 0) ||
           error_set(error, "'%s' is no name for snapshots; name a FILE.h5part", path);
}
