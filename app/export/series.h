/* A series of files being written: an index, OUT.pvd, OUT.ply.series or OUT.obj.series, and the folder OUT
   with OUT-0000.EXTENSION, OUT-0001.EXTENSION, ... Index and folder get their names together at the end;
   older files of the same names stay until then. */
#ifndef SLOSH_EXPORT_SERIES_H
#define SLOSH_EXPORT_SERIES_H

#include "app/base/output.h"
#include "app/base/output_folder.h"
#include "app/base/progress.h"
#include "app/export/export_index.h"

#include <stddef.h>

/* Description of a series. */
typedef struct SeriesJob {
    const char *path; /* of the index; the ending ".pvd", ".ply.series" or ".obj.series" selects the format */
    const char *extension; /* of the files: ".vtp" */
    size_t count;          /* of files */
    size_t part_count;     /* for .pvd: files per time; 0: one */
    const IndexPart *parts;
    /* Writes file number `index` under `name`, or its parts under export_part_name, and fills in its time,
       s. Returns false with the reason. */
    bool (*write)(void *user, size_t index, const char *name, double *time, Error *error);
    void *user;
} SeriesJob;

/* Writes all files, or after a signal the files so far: `written` gets the count. Returns false with the
   reason; older files of the same names then stay. */
bool series_write(const SeriesJob *job, Progress *progress, size_t *written, Error *error);

#endif
