#include "app/export.h"

#include "app/interrupt.h"
#include "app/output.h"
#include "app/output_folder.h"
#include "app/ply.h"
#include "app/vtp.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const Named kinds[] = {
    [EXPORT_PVD] = {"pvd", "all snapshots for ParaView: an index, and a folder with a .vtp for each"},
    [EXPORT_VTP] = {"vtp", "one snapshot for ParaView"},
    [EXPORT_PLY] = {"ply", "one snapshot as a point cloud: Blender, MeshLab, CloudCompare"},
    {0},
};

const Named *export_kinds(void)
{
    return kinds;
}

bool export_kind(const char *path, ExportKind *kind, Error *error)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *extension = strrchr(name, '.');
    for (int k = 0; extension && extension > name && kinds[k].name; k++)
        if (strcasecmp(extension + 1, kinds[k].name) == 0) {
            *kind = (ExportKind)k;
            return true;
        }
    return error_set(error, "'%s' says not what to write; name a FILE.pvd, a FILE.vtp or a FILE.ply", path);
}

static bool read_snapshot(Export *export, size_t index, SnapshotStep *step, Error *error)
{
    if (!snapshot_read_step(export->reader, index, step, error))
        return false;
    if (export->frame == FRAME_WORLD)
        snapshot_step_to_world(step);
    export->particles = step->count;
    export->time = step->time;
    return true;
}

/* Closes a stream that was written; `written` says how that went. */
static bool close_file(const Export *export, FILE *file, bool written, Error *error)
{
    int reason = errno;
    if (fclose(file) != 0 && written) {
        reason = errno;
        written = false;
    }
    return written || error_set(error, "%s: cannot be written: %s", export->path, strerror(reason));
}

static FILE *open_file(const Export *export, const char *name, Error *error)
{
    FILE *file = fopen(name, "wb");
    if (!file)
        error_set(error, "%s: cannot be written: %s", export->path, strerror(errno));
    return file;
}

/* ---- one snapshot ---- */

static bool write_ply(const Export *export, FILE *file, const SnapshotStep *step)
{
    PlyColors colors;
    colors.count = snapshot_read_colors(export->reader, colors.color);
    return ply_write(file, step, snapshot_frame_name(export->frame), &colors);
}

static bool write_one(const Export *export, const char *name, const SnapshotStep *step, Error *error)
{
    if (export->kind == EXPORT_PLY && !ply_check(step, error))
        return false;
    FILE *file = open_file(export, name, error);
    if (!file)
        return false;
    const bool written = export->kind == EXPORT_PLY ? write_ply(export, file, step) : vtp_write(file, step);
    return close_file(export, file, written, error);
}

bool export_one(Export *export, size_t index, Error *error)
{
    Output output = {0};
    SnapshotStep step;
    if (!output_begin(&output, export->path, error))
        return false;
    bool written = read_snapshot(export, index, &step, error);
    if (written) {
        written = write_one(export, output.temp, &step, error);
        snapshot_step_free(&step);
    }
    export->snapshots = written;
    if (written)
        return output_commit(&output, error);
    output_discard(&output);
    return false;
}

/* ---- a series ---- */

/* An index and its folder in the making. */
typedef struct Series {
    Output index;
    OutputFolder folder;
    double *times; /* of each snapshot, s */
} Series;

/* The folder is called as the index without its extension. */
static bool begin_series(Series *series, const Export *export, Error *error)
{
    char folder[sizeof series->folder.path];
    const size_t count = snapshot_count_steps(export->reader);
    if (!output_begin(&series->index, export->path, error))
        return false;
    snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(export->path, '.') - export->path), export->path);
    series->times = calloc(count, sizeof *series->times);
    if (!series->times)
        return error_set(error, "%s: out of memory for %zu snapshots", export->path, count);
    return output_folder_begin(&series->folder, folder, ".vtp", error);
}

static bool add_snapshot(Series *series, Export *export, Error *error)
{
    char name[1088], path[sizeof series->folder.temp + sizeof name];
    SnapshotStep step;
    vtp_series_name(series->folder.path, export->snapshots, name, sizeof name);
    snprintf(path, sizeof path, "%s/%s", series->folder.temp, name);
    if (!read_snapshot(export, export->snapshots, &step, error))
        return false;
    const bool written = write_one(export, path, &step, error);
    snapshot_step_free(&step);
    series->times[export->snapshots] = export->time;
    export->snapshots += written;
    return written;
}

static bool add_all(Series *series, Export *export, Progress *progress, Error *error)
{
    const size_t count = snapshot_count_steps(export->reader);
    while (export->snapshots < count && !export->interrupted) {
        if (!add_snapshot(series, export, error))
            return false;
        progress_update(progress, (double)export->snapshots / (double)count);
        export->interrupted = interrupted() && export->snapshots < count;
    }
    return true;
}

static bool write_index(const Series *series, const Export *export, Error *error)
{
    FILE *file = open_file(export, series->index.temp, error);
    return file &&
           close_file(export, file,
                      vtp_write_index(file, series->folder.path, export->snapshots, series->times), error);
}

bool export_series(Export *export, Progress *progress, Error *error)
{
    Series series = {.times = NULL};
    const bool written = begin_series(&series, export, error) && add_all(&series, export, progress, error) &&
                         write_index(&series, export, error) && output_folder_commit(&series.folder, error) &&
                         output_commit(&series.index, error);
    output_folder_discard(&series.folder);
    output_discard(&series.index);
    free(series.times);
    return written;
}
