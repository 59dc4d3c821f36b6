/* A series of files in the making: an index, OUT.pvd, OUT.ply.series or OUT.obj.series, and beside it the
   folder OUT with OUT-0000.EXTENSION, OUT-0001.EXTENSION, ... Index and folder get their names together when
   all is written, and what had those names before stays until then. */
#ifndef SLOSH_SERIES_H
#define SLOSH_SERIES_H

#include "app/base/output.h"
#include "app/base/output_folder.h"
#include "app/base/progress.h"
#include "app/export/export_index.h"

#include <stddef.h>

/* What makes its files. */
typedef struct SeriesJob {
    const char *
        path; /* of the index; ends in ".pvd", ".ply.series" or ".obj.series", which says how it is written */
    const char *extension; /* of the files: ".vtp" */
    size_t count;          /* of them */
    size_t part_count;     /* files of each number, of a .pvd; 0: one */
    const IndexPart *parts;
    /* Writes file number `index` under that name, or its parts under export_part_name, and says of which time
       it is, s. False with the reason. */
    bool (*write)(void *user, size_t index, const char *name, double *time, Error *error);
    void *user;
} SeriesJob;

/* Writes all files, or after a signal those so far: `written` says how many. False with the reason: nothing
   is left under these names but what was there. */
bool series_write(const SeriesJob *job, Progress *progress, size_t *written, Error *error);

#endif
