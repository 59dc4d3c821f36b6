#include "app/export/series.h"

#include "app/base/interrupt.h"
#include "app/export/export_index.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct Series {
    Output index;
    OutputFolder folder;
    double *times; /* of each file, s */
} Series;

typedef bool IndexWriter(FILE *file, const ExportIndex *index);

static const struct {
    const char *extension;
    IndexWriter *write;
} indices[] = {
    {".pvd", export_index_pvd}, {".ply.series", export_index_series}, {".obj.series", export_index_series}};

/* Finds the index format by the ending of the name; the first format for unknown endings. */
static size_t index_of(const char *path)
{
    const size_t length = strlen(path);
    for (size_t k = 0; k < sizeof indices / sizeof *indices; k++) {
        const size_t end = strlen(indices[k].extension);
        if (length > end && strcasecmp(path + length - end, indices[k].extension) == 0)
            return k;
    }
    return 0;
}

/* Begins both outputs; the folder's name is the index's name without extension. */
static bool begin(Series *series, const SeriesJob *job, Error *error)
{
    char folder[sizeof series->folder.path];
    if (!output_begin(&series->index, job->path, error))
        return false;
    const size_t length = strlen(job->path) - strlen(indices[index_of(job->path)].extension);
    snprintf(folder, sizeof folder, "%.*s", (int)length, job->path);
    series->times = calloc(job->count + 1, sizeof *series->times);
    if (!series->times)
        return error_set(error, "%s: out of memory for %zu files", job->path, job->count);
    return output_folder_begin(&series->folder, folder, job->extension, error);
}

static bool write_files(Series *series, const SeriesJob *job, Progress *progress, size_t *written,
                        Error *error)
{
    for (*written = 0; *written < job->count && !(*written > 0 && interrupted());) {
        char name[1088], path[sizeof series->folder.temp + sizeof name];
        export_index_name(series->folder.path, *written, job->count, job->extension, name, sizeof name);
        snprintf(path, sizeof path, "%s/%s", series->folder.temp, name);
        if (!job->write(job->user, *written, path, &series->times[*written], error))
            return false;
        progress_update(progress, (double)++*written / (double)job->count);
    }
    return true;
}

static bool write_index(const Series *series, const SeriesJob *job, size_t count, Error *error)
{
    FILE *file = fopen(series->index.temp, "wb");
    const ExportIndex index = {.folder = series->folder.path,
                               .extension = job->extension,
                               .count = count,
                               .of = job->count,
                               .times = series->times,
                               .part_count = job->part_count,
                               .parts = job->parts};
    bool written = file && indices[index_of(job->path)].write(file, &index);
    int reason = errno;
    if (file && fclose(file) != 0 && written) {
        reason = errno;
        written = false;
    }
    return written || error_set(error, "%s: cannot be written: %s", job->path, strerror(reason));
}

bool series_write(const SeriesJob *job, Progress *progress, size_t *written, Error *error)
{
    Series series = {.times = NULL};
    const bool done = begin(&series, job, error) && write_files(&series, job, progress, written, error) &&
                      write_index(&series, job, *written, error) &&
                      output_folder_commit(&series.folder, error) && output_commit(&series.index, error);
    output_folder_discard(&series.folder);
    output_discard(&series.index);
    free(series.times);
    return done;
}
