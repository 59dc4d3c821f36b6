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

/* Meshes of a snapshot: the surface if requested, and the solids. */
typedef struct Meshes {
    int count;
    Surface mesh[EXPORT_PARTS_MAX];
} Meshes;

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

/* True if the file is named SOMETHING.EXTENSION. */
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

/* True if a snapshot's file is a .ply. */
static bool is_ply(const Export *export)
{
    return export->kind == EXPORT_PLY || export->kind == EXPORT_PLY_SERIES;
}

/* Reads a step without particles to be left out, which are noted in `flaws`. */
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

/* Closes a stream; `written`: false if writing failed. */
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

/* ---- the meshes of a snapshot ---- */

/* Returns the count of fluid surfaces per snapshot. */
static int count_surfaces(const Export *export)
{
    if (!export->surface)
        return 0;
    return export->surface->each ? (int)export->scene.fluid_count : 1;
}

static void note_surfaces(Export *export, const Meshes *meshes)
{
    export->vertices = export->triangles = 0;
    export->volume = 0;
    for (int k = 0; k < count_surfaces(export); k++) {
        export->vertices += meshes->mesh[k].vertices.count;
        export->triangles += meshes->mesh[k].triangle_count;
        export->volume += meshes->mesh[k].volume;
        export->volumes[k] = meshes->mesh[k].volume;
    }
    export->level = meshes->mesh[0].level;
    export->empty += export->triangles == 0;
}

static bool make_surfaces(Export *export, const SnapshotStep *step, Meshes *meshes, Error *error)
{
    if (!export->surface)
        return true;
    if (!(export->surface->each ? surface_make_each : surface_make)(export->surface, &export->scene, step,
                                                                    meshes->mesh, error))
        return false;
    meshes->count = count_surfaces(export);
    note_surfaces(export, meshes);
    return true;
}

static bool make_solids(const Export *export, const SnapshotStep *step, Meshes *meshes, Error *error)
{
    for (int k = 0; export->solids && k < export->solids->count; k++, meshes->count++)
        if (!export_solid_at(export->solids, k, step, &meshes->mesh[meshes->count], error))
            return false;
    return true;
}

/* Makes the meshes in the requested frame. */
static bool make_meshes(Export *export, const SnapshotStep *step, Meshes *meshes, Error *error)
{
    if (!make_surfaces(export, step, meshes, error) || !make_solids(export, step, meshes, error))
        return false;
    for (int k = 0; export->frame == FRAME_WORLD && k < meshes->count; k++)
        surface_to_world(&meshes->mesh[k]);
    return true;
}

/* Returns the index of the solid of mesh `number`; less than 0: a fluid's surface. */
static int solid_of(const Export *export, int number)
{
    return number - count_surfaces(export);
}

static const char *mesh_name(const Export *export, int number)
{
    const int solid = solid_of(export, number);
    if (solid >= 0)
        return export->solids->solid[solid].name;
    return export->surface->each ? export->fluids[number] : "fluid";
}

static void free_meshes(Meshes *meshes)
{
    for (int k = 0; k < meshes->count; k++)
        surface_free(&meshes->mesh[k]);
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

/* Writes all meshes into one file. */
static bool write_obj(const Export *export, const char *name, const SnapshotStep *step, const Meshes *meshes,
                      Error *error)
{
    FILE *file = open_file(export, name, error);
    if (!file)
        return false;
    ObjFile obj = obj_begin(file, step->time, snapshot_frame_name(export->frame), &export->colors);
    for (int k = 0; k < meshes->count; k++) {
        const int solid = solid_of(export, k);
        obj_add(&obj, mesh_name(export, k), &meshes->mesh[k],
                solid < 0 ? &export->colors : &export->solids->solid[solid].color);
    }
    return close_file(export, file, obj_end(&obj), error);
}

static bool write_mesh(const Export *export, const char *name, int number, const Surface *mesh, Error *error)
{
    FILE *file = open_file(export, name, error);
    if (!file)
        return false;
    bool written;
    if (is_ply(export))
        written = ply_write_surface(file, mesh, snapshot_frame_name(export->frame), &export->colors);
    else
        written = solid_of(export, number) < 0 ? vtp_write_surface(file, mesh) : vtp_write_solid(file, mesh);
    return close_file(export, file, written, error);
}

/* Writes the particles and each mesh into files of their own; without parts there is only one of these. */
static bool write_parts(const Export *export, const char *name, SnapshotStep *step, const Meshes *meshes,
                        Error *error)
{
    const int first = export->surface ? 0 : 1; /* index of the first mesh's part */
    if (first > 0 && !write_particles(export, name, step, error))
        return false;
    for (int k = 0; k < meshes->count; k++) {
        char own[2048];
        export_part_name(name, export->part_count > 0 ? export->parts[first + k].suffix : "", own,
                         sizeof own);
        if (!write_mesh(export, export->part_count > 0 ? own : name, k, &meshes->mesh[k], error))
            return false;
    }
    return true;
}

static bool write_snapshot(Export *export, size_t index, const char *name, Error *error)
{
    Meshes meshes = {0};
    SnapshotStep step;
    if (!read_step(export, index, &export->flaws, &step, error))
        return false;
    export->particles = step.count;
    export->time = step.time;
    const bool written = make_meshes(export, &step, &meshes, error) &&
                         (export_is_obj(export->kind) ? write_obj(export, name, &step, &meshes, error)
                                                      : write_parts(export, name, &step, &meshes, error));
    free_meshes(&meshes);
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

static void add_part(Export *export, const char *name, const char *kind, int number)
{
    IndexPart *part = &export->parts[export->part_count++];
    snprintf(part->name, sizeof part->name, "%s", name);
    if (kind)
        snprintf(part->suffix, sizeof part->suffix, "-%s%d", kind, number);
}

/* Names the parts of a .pvd; without solids and surfaces of each fluid there is one file per time. */
static void name_parts(Export *export)
{
    const bool each = export->surface && export->surface->each;
    if (export->kind != EXPORT_PVD || (!export->solids && !each))
        return;
    if (!export->surface)
        add_part(export, "particles", NULL, 0);
    for (int k = 0; k < count_surfaces(export); k++)
        add_part(export, mesh_name(export, k), each ? "fluid" : NULL, k);
    for (int k = 0; export->solids && k < export->solids->count; k++)
        add_part(export, export->solids->solid[k].name, "solid", k);
}

static bool write_one_of_all(void *user, size_t index, const char *name, double *time, Error *error)
{
    Export *export = user;
    const bool written = write_snapshot(export, index, name, error);
    *time = export->time;
    return written;
}

bool export_series(Export *export, Progress *progress, Error *error)
{
    name_parts(export);
    const SeriesJob job = {.path = export->path,
                           .extension = export_is_obj(export->kind) ? ".obj"
                                        : is_ply(export)            ? ".ply"
                                                                    : ".vtp",
                           .count = snapshot_count_steps(export->reader),
                           .part_count = export->part_count,
                           .parts = export->parts,
                           .write = write_one_of_all,
                           .user = export};
    size_t written = 0;
    const bool done = series_write(&job, progress, &written, error);
    export->interrupted = done && written < job.count;
    return done;
}
