#include "app/files/export.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "sim/error.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

void export_index_name(const char *folder, size_t index, size_t of, const char *extension, char *name,
                       size_t size)
{
    snprintf(name, size, "%s-%0*zu%s", last_part(folder), number_digits(of, 4), index, extension);
}

/* Prints a text within the quotes of an attribute. */
static void print_escaped(FILE *file, const char *text)
{
    for (; *text; text++)
        if (strchr("&<>\"", *text))
            fprintf(file, "&#%d;", *text);
        else
            fputc(*text, file);
}

/* Turns NAME-0000EXTENSION into NAME-0000SUFFIXEXTENSION. */
static void export_part_name(const char *name, const char *suffix, char *own, size_t size)
{
    const char *dot = strrchr(name, '.');
    const int length = dot ? (int)(dot - name) : (int)strlen(name);
    snprintf(own, size, "%.*s%s%s", length, name, suffix, dot ? dot : "");
}

/* Prints one file's entry; without parts, part 0 without a name. */
static void print_part(FILE *file, const ExportIndex *index, size_t number, size_t part)
{
    const ExportPart *own = index->part_count > 0 ? &index->parts[part] : NULL;
    char name[1088], part_name[1120];
    export_index_name(index->folder, number, index->of, index->extension, name, sizeof name);
    export_part_name(name, own ? own->suffix : "", part_name, sizeof part_name);
    fprintf(file, "<DataSet timestep=\"%.17g\" group=\"\" part=\"%zu\"", index->times[number], part);
    if (own) {
        fputs(" name=\"", file);
        print_escaped(file, own->name);
        fputc('"', file);
    }
    fputs(" file=\"", file);
    print_escaped(file, last_part(index->folder));
    fputc('/', file);
    print_escaped(file, part_name);
    fputs("\"/>\n", file);
}

bool export_index_pvd(FILE *file, const ExportIndex *index)
{
    fputs("<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
          file);
    for (size_t i = 0; i < index->count; i++)
        for (size_t part = 0; part < (index->part_count > 0 ? index->part_count : 1); part++)
            print_part(file, index, i, part);
    fputs("</Collection>\n</VTKFile>\n", file);
    return !ferror(file);
}

bool export_index_series(FILE *file, const ExportIndex *index)
{
    char name[1088];
    json_t *files = json_array();
    for (size_t i = 0; i < index->count; i++) {
        export_index_name(index->folder, i, index->of, index->extension, name, sizeof name);
        json_array_append_new(files, json_pack("{s:o, s:f}", "name",
                                               json_sprintf("%s/%s", last_part(index->folder), name), "time",
                                               index->times[i]));
    }
    json_t *all = json_pack("{s:s, s:o}", "file-series-version", "1.0", "files", files);
    const bool whole = all && json_array_size(files) == index->count;
    if (!whole)
        errno = EILSEQ; /* json_pack failed: the name is not UTF-8 */
    const bool written =
        whole && json_dumpf(all, file, JSON_INDENT(1) | JSON_PRESERVE_ORDER) == 0 && fputc('\n', file) != EOF;
    json_decref(all);
    return written && !ferror(file);
}

/* Closes a stream; NULL, or `written` false: writing failed, for the reason in errno. */
static bool close_file(FILE *file, bool written, const char *path, Error *error)
{
    int reason = errno;
    if (file && fclose(file) != 0 && written) {
        reason = errno;
        written = false;
    }
    return written || error_set(error, "%s: cannot be written: %s", path, strerror(reason));
}

bool export_content_write(const ExportFormat *format, const ExportContent *content, const char *name,
                          const char *path, Error *error)
{
    FILE *file = fopen(name, "wb");
    return close_file(file, file && (format->each ? format->each : format)->write(file, content), path,
                      error);
}

typedef struct SeriesFiles {
    Output index;
    OutputFolder folder;
    char extension[32]; /* of each file: ".vtp"; the folder points to it */
    double *times;      /* of each file, s */
} SeriesFiles;

/* Begins both outputs; the folder's name is the index's name without extension. */
static bool begin(SeriesFiles *series, const ExportSeries *job, Error *error)
{
    char folder[sizeof series->folder.path];
    if (!output_begin(&series->index, job->path, error))
        return false;
    const size_t length = strlen(job->path) - strlen(job->format->extension) - 1;
    snprintf(series->extension, sizeof series->extension, ".%s", job->format->each->extension);
    snprintf(folder, sizeof folder, "%.*s", (int)length, job->path);
    series->times = calloc(job->count + 1, sizeof *series->times);
    if (!series->times)
        return error_set(error, "%s: out of memory for %zu files", job->path, job->count);
    return output_folder_begin(&series->folder, folder, series->extension, error);
}

static bool write_files(SeriesFiles *series, const ExportSeries *job, Progress *progress, size_t *written,
                        Error *error)
{
    for (*written = 0; *written < job->count && !(*written > 0 && interrupted());) {
        char name[1088], path[sizeof series->folder.temp + sizeof name];
        export_index_name(series->folder.path, *written, job->count, series->extension, name, sizeof name);
        snprintf(path, sizeof path, "%s/%s", series->folder.temp, name);
        if (!job->write(job->user, *written, path, &series->times[*written], error))
            return false;
        progress_update(progress, (double)++*written / (double)job->count);
    }
    return true;
}

static bool write_index(const SeriesFiles *series, const ExportSeries *job, size_t count, Error *error)
{
    FILE *file = fopen(series->index.temp, "wb");
    const ExportIndex index = {.folder = series->folder.path,
                               .extension = series->extension,
                               .count = count,
                               .of = job->count,
                               .times = series->times,
                               .part_count = job->part_count,
                               .parts = job->parts};
    return close_file(file, file && job->format->index(file, &index), job->path, error);
}

bool export_series_write(const ExportSeries *job, Progress *progress, size_t *written, Error *error)
{
    SeriesFiles series = {.times = NULL};
    const bool done = begin(&series, job, error) && write_files(&series, job, progress, written, error) &&
                      write_index(&series, job, *written, error) &&
                      output_folder_commit(&series.folder, error) && output_commit(&series.index, error);
    output_folder_discard(&series.folder);
    output_discard(&series.index);
    free(series.times);
    return done;
}

/* Meshes of a snapshot: the surface if requested, and the solids. */
typedef struct Meshes {
    int count;
    Surface mesh[EXPORT_PARTS_MAX];
} Meshes;

/* Reads a step without particles to be left out, which are noted in `flaws`. */
static bool read_step(const Export *export, size_t index, SnapshotFlaws *flaws, SnapshotStep *step,
                      Error *error)
{
    if (!snapshot_read_step(export->reader, index, step, error))
        return false;
    if (snapshot_validate(flaws, index, step))
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

static bool write_file(const Export *export, const char *name, const ExportContent *content, Error *error)
{
    return export_content_write(export->format, content, name, export->path, error);
}

static bool write_particles(const Export *export, const char *name, SnapshotStep *step, Error *error)
{
    const ExportFormat *format = export->format->each ? export->format->each : export->format;
    if (export->frame == FRAME_WORLD)
        snapshot_step_to_world(step);
    const ExportContent content = {.time = step->time,
                                   .frame = snapshot_frame_name(export->frame),
                                   .particles = step,
                                   .colors = &export->colors};
    return (!format->check || format->check(step, error)) && write_file(export, name, &content, error);
}

/* Describes the meshes for a file's writer. */
static ExportContent describe(const Export *export, const SnapshotStep *step, const Meshes *meshes,
                              ExportMesh described[EXPORT_PARTS_MAX])
{
    for (int k = 0; k < meshes->count; k++) {
        const int solid = solid_of(export, k);
        described[k] =
            (ExportMesh){.name = mesh_name(export, k),
                         .solid = solid >= 0,
                         .mesh = &meshes->mesh[k],
                         .colors = solid < 0 ? &export->colors : &export->solids->solid[solid].color};
    }
    return (ExportContent){.time = step->time,
                           .frame = snapshot_frame_name(export->frame),
                           .mesh_count = meshes->count,
                           .mesh = described};
}

/* Writes the particles and each mesh into files of their own; without parts there is only one of these. */
static bool write_parts(const Export *export, const char *name, SnapshotStep *step, const Meshes *meshes,
                        Error *error)
{
    const int first = export->surface ? 0 : 1; /* index of the first mesh's part */
    ExportMesh described[EXPORT_PARTS_MAX];
    ExportContent content = describe(export, step, meshes, described);
    if (first > 0 && !write_particles(export, name, step, error))
        return false;
    content.mesh_count = 1;
    for (int k = 0; k < meshes->count; k++) {
        char own[2048];
        export_part_name(name, export->part_count > 0 ? export->parts[first + k].suffix : "", own,
                         sizeof own);
        content.mesh = &described[k];
        if (!write_file(export, export->part_count > 0 ? own : name, &content, error))
            return false;
    }
    return true;
}

/* Writes all meshes into one file. */
static bool write_meshes(const Export *export, const char *name, const SnapshotStep *step,
                         const Meshes *meshes, Error *error)
{
    ExportMesh described[EXPORT_PARTS_MAX];
    ExportContent content = describe(export, step, meshes, described);
    content.colors = &export->colors;
    return write_file(export, name, &content, error);
}

static bool write_snapshot(Export *export, size_t index, const char *name, Error *error)
{
    Meshes meshes = {0};
    SnapshotStep step;
    if (!read_step(export, index, &export->flaws, &step, error))
        return false;
    export->particles = step.count;
    export->time = step.time;
    const bool written =
        make_meshes(export, &step, &meshes, error) &&
        ((export->format->holds & EXPORT_MESHES) != 0 ? write_meshes(export, name, &step, &meshes, error)
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
    ExportPart *part = &export->parts[export->part_count++];
    snprintf(part->name, sizeof part->name, "%s", name);
    if (kind)
        snprintf(part->suffix, sizeof part->suffix, "-%s%d", kind, number);
}

/* Names the parts of an index; without solids and surfaces of each fluid there is one file per time. */
static void name_parts(Export *export)
{
    const bool each = export->surface && export->surface->each;
    if (!export->format->has_parts || (!export->solids && !each))
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
    const ExportSeries job = {.path = export->path,
                              .format = export->format,
                              .count = snapshot_count_steps(export->reader),
                              .part_count = export->part_count,
                              .parts = export->parts,
                              .write = write_one_of_all,
                              .user = export};
    size_t written = 0;
    const bool done = export_series_write(&job, progress, &written, error);
    export->interrupted = done && written < job.count;
    return done;
}
