#include "app/export/export.h"

#include "app/base/output.h"
#include "app/export/obj.h"
#include "app/export/series.h"
#include "app/export/vtp.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const Named kinds[] = {
    [EXPORT_PVD] = {"pvd", "all snapshots for ParaView: an index, and a folder with a .vtp for each"},
    [EXPORT_VTP] = {"vtp", "one snapshot for ParaView"},
    [EXPORT_PLY] = {"ply", "one snapshot as a point cloud or a mesh: Blender, MeshLab, CloudCompare"},
    [EXPORT_PLY_SERIES] = {"ply.series", "all snapshots: an index, and a folder with a .ply for each"},
    [EXPORT_OBJ] = {"obj", "one snapshot's surface as a mesh: Blender, Houdini"},
    [EXPORT_OBJ_SERIES] = {"obj.series",
                           "all snapshots' surfaces: an index, and a folder with a .obj for each"},
    {0},
};

const Named *export_kinds(void)
{
    return kinds;
}

/* Whether the file is called SOMETHING.EXTENSION. */
static bool has_extension(const char *path, const char *extension)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const size_t length = strlen(name), end = strlen(extension);
    return length > end + 1 && name[length - end - 1] == '.' &&
           strcasecmp(name + length - end, extension) == 0;
}

bool export_kind(const char *path, ExportKind *kind, Error *error)
{
    for (int k = 0; kinds[k].name; k++)
        if (has_extension(path, kinds[k].name)) {
            *kind = (ExportKind)k;
            return true;
        }
    return error_set(error,
                     "cannot tell the format from '%s'; use .pvd, .vtp or .ply, .obj for a surface, or "
                     ".ply.series or .obj.series for all snapshots",
                     path);
}

bool export_is_series(ExportKind kind)
{
    return kind == EXPORT_PVD || kind == EXPORT_PLY_SERIES || kind == EXPORT_OBJ_SERIES;
}

bool export_is_obj(ExportKind kind)
{
    return kind == EXPORT_OBJ || kind == EXPORT_OBJ_SERIES;
}

bool export_is_colored(ExportKind kind)
{
    return kind != EXPORT_PVD && kind != EXPORT_VTP;
}

/* Of the file of one snapshot. */
static bool is_ply(const Export *export)
{
    return export->kind == EXPORT_PLY || export->kind == EXPORT_PLY_SERIES;
}

/* Without what is left out, which is noted in `flaws`. */
static bool read_step(const Export *export, size_t index, SnapshotFlaws *flaws, SnapshotStep *step,
                      Error *error)
{
    if (!snapshot_read_step(export->reader, index, step, error))
        return false;
    if (snapshot_sift(flaws, index, step))
        return true;
    snapshot_step_free(step);
    return error_set(error, "%s: out of memory for a snapshot", export->path);
}

/* ---- colours ---- */

static bool widen_range(Export *export, size_t index, Error *error)
{
    PointColors *colors = &export->colors;
    SnapshotFlaws noted_later = export->flaws;
    SnapshotStep step;
    if (!read_step(export, index, &noted_later, &step, error))
        return false;
    if (export->frame == FRAME_WORLD)
        snapshot_step_to_world(&step);
    for (size_t i = 0; i < step.count; i++) {
        const double value = point_scalar(&step, i, colors->scalar);
        colors->low = fmin(colors->low, value);
        colors->high = fmax(colors->high, value);
    }
    snapshot_step_free(&step);
    return true;
}

bool export_colors(Export *export, Scalar by, size_t first, size_t count, Error *error)
{
    PointColors *colors = &export->colors;
    *colors = (PointColors){.mapped = by != SCALAR_FLUID, .scalar = by, .low = INFINITY, .high = -INFINITY};
    colors->count = snapshot_read_colors(export->reader, colors->color);
    for (size_t k = 0; colors->mapped && k < count; k++)
        if (!widen_range(export, first + k, error))
            return false;
    if (colors->low > colors->high) /* no particles */
        colors->low = colors->high = 0;
    return true;
}

/* ---- files ---- */

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

static bool write_particles(const Export *export, const char *name, SnapshotStep *step, Error *error)
{
    if (export->frame == FRAME_WORLD)
        snapshot_step_to_world(step);
    if (is_ply(export) && !ply_check(step, error))
        return false;
    FILE *file = open_file(export, name, error);
    if (!file)
        return false;
    const bool written = is_ply(export)
                             ? ply_write(file, step, snapshot_frame_name(export->frame), &export->colors)
                             : vtp_write(file, step);
    return close_file(export, file, written, error);
}

static bool write_obj(const Export *export, FILE *file, const Surface *surface)
{
    ObjFile obj =
        obj_begin(file, surface->vertices.time, snapshot_frame_name(export->frame), &export->colors);
    obj_add(&obj, "fluid", surface, &export->colors);
    return obj_end(&obj);
}

static bool write_mesh_as(const Export *export, FILE *file, const Surface *surface)
{
    if (export_is_obj(export->kind))
        return write_obj(export, file, surface);
    return is_ply(export)
               ? ply_write_surface(file, surface, snapshot_frame_name(export->frame), &export->colors)
               : vtp_write_surface(file, surface);
}

static bool write_mesh(Export *export, const char *name, Surface *surface, Error *error)
{
    export->vertices = surface->vertices.count;
    export->triangles = surface->triangle_count;
    export->level = surface->level;
    export->volume = surface->volume;
    export->empty += surface->triangle_count == 0;
    if (export->frame == FRAME_WORLD)
        surface_to_world(surface);
    FILE *file = open_file(export, name, error);
    if (!file)
        return false;
    const bool written = write_mesh_as(export, file, surface);
    return close_file(export, file, written, error);
}

static bool write_surface(Export *export, const char *name, const SnapshotStep *step, Error *error)
{
    Surface surface;
    if (!surface_make(export->surface, &export->scene, step, &surface, error))
        return false;
    const bool written = write_mesh(export, name, &surface, error);
    surface_free(&surface);
    return written;
}

static bool write_snapshot(Export *export, size_t index, const char *name, Error *error)
{
    SnapshotStep step;
    if (!read_step(export, index, &export->flaws, &step, error))
        return false;
    export->particles = step.count;
    export->time = step.time;
    const bool written = export->surface ? write_surface(export, name, &step, error)
                                         : write_particles(export, name, &step, error);
    snapshot_step_free(&step);
    export->snapshots += written;
    return written;
}

bool export_one(Export *export, size_t index, Error *error)
{
    Output output = {0};
    if (!output_begin(&output, export->path, error))
        return false;
    if (write_snapshot(export, index, output.temp, error))
        return output_commit(&output, error);
    output_discard(&output);
    return false;
}

/* ---- a series ---- */

static bool write_one_of_all(void *user, size_t index, const char *name, double *time, Error *error)
{
    Export *export = user;
    const bool written = write_snapshot(export, index, name, error);
    *time = export->time;
    return written;
}

bool export_series(Export *export, Progress *progress, Error *error)
{
    const SeriesJob job = {.path = export->path,
                           .extension = export_is_obj(export->kind) ? ".obj"
                                        : is_ply(export)            ? ".ply"
                                                                    : ".vtp",
                           .count = snapshot_count_steps(export->reader),
                           .write = write_one_of_all,
                           .user = export};
    size_t written = 0;
    const bool done = series_write(&job, progress, &written, error);
    export->interrupted = done && written < job.count;
    return done;
}
