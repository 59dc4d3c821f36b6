#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "app/files/export.h"
#include "app/files/snapshot.h"
#include "app/run/offscreen.h"
#include "render/particles/particles.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A slice export. */
typedef struct SliceExport {
    const Args *args;
    SnapshotReader *reader;
    SnapshotScene scene;
    SnapshotFlaws flaws;
    SliceTableDef wanted;
    size_t index; /* of the snapshot */
    const ExportFormat *format;
    SliceMaker maker;
    SliceTable table; /* of the last slice */
    size_t slices;    /* count of written slices */
    size_t empty;     /* count of empty slices */
    bool interrupted; /* by a signal, before the last slice */
} SliceExport;

bool export_needs_slice(const Args *args, Error *error)
{
    const ExportOptions *own = options_of_export(args);
    const char *option = own->raw                     ? "--raw"
                         : own->kernel                ? "--kernel"
                         : own->scalar                ? "--scalar"
                         : args_given(args, "--size") ? "--size"
                                                      : NULL;
    if (option)
        return error_set(error, "%s is of a slice%s; add --slice \"{point: [0, 0, 0], normal: [0, 0, 1]}\"",
                         option, own->scalar && strcmp(option, "--scalar") == 0 ? " or of trails" : "");
    if (export_format_find(args->output, EXPORT_SNAPSHOT, NULL) ||
        !export_format_find(args->output, EXPORT_SLICE, NULL))
        return true;
    return error_set(error, "%s is of a slice; add --slice \"{point: [0, 0, 0], normal: [0, 0, 1]}\"",
                     args->output);
}

/* ---- the command line ---- */

const char *export_scalar_choice(int index)
{
    return scalar_list[index].name;
}

/* Skips the first kernel: the solver's own, which is not a named shape. */
const char *export_kernel_choice(int index)
{
    return plane_kernels[1 + index].name;
}

/* Finds the index of the name; otherwise the error lists the names. */
static bool find_name(const char *option, const char *name, const char *(*names)(int), int *found,
                      Error *error)
{
    char list[1000] = "";
    size_t used = 0;
    Suggestion near = suggest_for(name);
    for (*found = 0; names(*found); ++*found) {
        if (strcmp(names(*found), name) == 0)
            return true;
        suggest_offer(&near, names(*found));
        const char *before = *found == 0 ? "" : names(*found + 1) ? ", " : " or ";
        if (used < sizeof list)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", before, names(*found));
    }
    return error_set(error, "%s %.60s is not known%s%s; take %s", option, name,
                     near.best ? "; did you mean " : "", near.best ? near.best : "", list);
}

bool export_scalar(const char *name, Scalar *scalar, Error *error)
{
    int found;
    const bool known = find_name("--scalar", name, export_scalar_choice, &found, error);
    *scalar = (Scalar)found;
    return known;
}

static bool find_kernel(const char *name, int *kernel, Error *error)
{
    const bool found = find_name("--kernel", name, export_kernel_choice, kernel, error);
    ++*kernel;
    return found;
}

/* Uses the kernel of the option, then of the file, then the default. */
static bool choose_kernel(SliceExport *export, Error *error)
{
    char own[NAME_SIZE];
    if (options_of_export(export->args)->kernel)
        return find_kernel(options_of_export(export->args)->kernel, &export->wanted.kernel, error);
    export->wanted.kernel = snapshot_kernel(export->reader, own) ? plane_kernel_named(own) : 1;
    return true;
}

static bool refuse_others(const Args *args, Error *error)
{
    const ExportOptions *own = options_of_export(args);
    const char *option = own->surface                         ? "--surface"
                         : own->solids                        ? "--solids"
                         : own->fluids                        ? "--fluids"
                         : own->trails                        ? "--trails"
                         : own->frame != FRAME_BOX            ? "--frame world"
                         : own->color_by != COLOR_CHOICE_AUTO ? "--color-by"
                         : own->level > 0                     ? "--level"
                         : own->cell > 0                      ? "--cell"
                                                              : NULL;
    return !option ||
           error_set(error, "%s makes no sense with --slice, which is of numbers in the frame of the box",
                     option);
}

bool export_has_scalar(const Args *args, SnapshotReader *reader, size_t index, Scalar scalar, Error *error)
{
    char list[800] = "";
    SnapshotStep step;
    if (!snapshot_read_for_display(reader, index, &step, error))
        return false;
    const unsigned has = snapshot_attributes(&step);
    snapshot_step_free(&step);
    if ((snapshot_scalar_attributes(scalar) & ~has) == 0)
        return true;
    for (int s = 0; s < SCALAR_COUNT; s++)
        if ((snapshot_scalar_attributes((Scalar)s) & ~has) == 0)
            snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", *list ? ", " : "",
                     scalar_name((Scalar)s));
    return error_set(error, "%s: Step#%zu has no %s; take --scalar %s", args->scenes[0], index,
                     scalar_name(scalar), *list ? list : "of another file");
}

static bool understand(SliceExport *export, Error *error)
{
    const Args *args = export->args;
    const ExportOptions *own = options_of_export(args);
    export->wanted =
        (SliceTableDef){.normal = {0, 0, 1}, .samples = {args->width, args->height}, .raw = own->raw};
    export->format = export_format_find(args->output, EXPORT_SLICE, error);
    if (!export->format)
        return false;
    if (export->format->each && args_given(args, "--time"))
        return error_set(error, "--time makes no sense for all snapshots, %s; name a FILE.vti or a FILE.csv",
                         args->output);
    return refuse_others(args, error) && slice_table_def_read(&export->wanted, own->slice, error) &&
           export_scalar(own->scalar ? own->scalar : "pressure", &export->wanted.scalar, error) &&
           export_open(args, &export->reader, error) &&
           snapshot_read_scene(export->reader, &export->scene, error) && choose_kernel(export, error) &&
           export_choose(args, export->reader, &export->index, error) &&
           export_has_scalar(args, export->reader, export->format->each ? 0 : export->index,
                             export->wanted.scalar, error);
}

/* ---- files ---- */

static bool make_table(SliceExport *export, size_t index, Error *error)
{
    SnapshotStep step;
    slice_table_free(&export->table);
    if (!snapshot_read_for_display(export->reader, index, &step, error))
        return false;
    const bool made =
        (snapshot_validate(&export->flaws, index, &step) ||
         error_set(error, "out of memory for a snapshot")) &&
        slice_table_make(&export->maker, &export->wanted, &export->scene, &step, &export->table, error);
    snapshot_step_free(&step);
    return made;
}

static size_t samples_of(const SliceExport *export)
{
    return (size_t) export->wanted.samples[0] * (size_t) export->wanted.samples[1];
}

static bool write_slice(void *user, size_t index, const char *name, double *time, Error *error)
{
    SliceExport *export = user;
    if (!make_table(export, index, error))
        return false;
    *time = export->table.time;
    const ExportContent content = {.time = *time, .frame = "box", .slice = &export->table};
    if (!export_content_write(export->format, &content, name, export->args->output, error))
        return false;
    export->slices++;
    export->empty += export->table.empty == samples_of(export);
    return true;
}

static bool write_one(SliceExport *export, Error *error)
{
    Output output = {0};
    double time;
    if (!output_begin(&output, export->args->output, error))
        return false;
    if (write_slice(export, export->index, output.temp, &time, error))
        return output_commit(&output, error);
    output_discard(&output);
    return false;
}

static bool write_all(SliceExport *export, Error *error)
{
    const ExportSeries job = {.path = export->args->output,
                              .format = export->format,
                              .count = snapshot_count_steps(export->reader),
                              .write = write_slice,
                              .user = export};
    Progress progress;
    size_t written = 0;
    progress_begin(&progress, stderr, "export", export->args->quiet);
    const bool done = export_series_write(&job, &progress, &written, error);
    progress_end(&progress);
    export->interrupted = done && written < job.count;
    return done;
}

/* ---- messages ---- */

static void warn(const SliceExport *export)
{
    const Args *args = export->args;
    const SliceTableDef *wanted = &export->wanted;
    const SliceTable *table = &export->table;
    const double across =
        hypot(table->plane.size[0] / wanted->samples[0], table->plane.size[1] / wanted->samples[1]);
    if (export->empty == export->slices)
        fprintf(stderr, "%s: warning: no particle is within a support radius of the plane: all is empty\n",
                args->output);
    else if (export->empty > 0)
        fprintf(stderr, "%s: warning: %zu of %zu slices are empty: no particle is within a support radius\n",
                args->output, export->empty, export->slices);
    if (2 * export->scene.support_radius < across)
        fprintf(stderr,
                "%s: warning: samples are %.3g m apart and particles reach %.3g m: some lie between samples; "
                "use a larger --size\n",
                args->output, across, export->scene.support_radius);
}

static void report(const SliceExport *export)
{
    const Args *args = export->args;
    const SliceTableDef *wanted = &export->wanted;
    const ScalarRow *scalar = &scalar_list[wanted->scalar];
    if (export->interrupted)
        fprintf(stderr, "stopped at t = %.4g s; %s is whole\n", export->table.time, args->output);
    snapshot_flaws_print(&export->flaws, args->scenes[0], stderr);
    warn(export);
    if (args->quiet)
        return;
    fprintf(stderr, "%s: ", args->output);
    if (export->format->each)
        fprintf(stderr, "%zu slice%s of ", export->slices, plural(export->slices));
    fprintf(stderr, "%d x %d samples of %s%s%s%s, %s, kernel %s, %s = %.4g s", wanted->samples[0],
            wanted->samples[1], scalar->name, *scalar->unit ? " (" : "", scalar->unit,
            *scalar->unit ? ")" : "", wanted->raw ? "sums" : "means", plane_kernels[wanted->kernel].name,
            export->format->each ? "up to t" : "t", export->table.time);
    if (export->format->each)
        fprintf(stderr, "\n");
    else
        fprintf(stderr, "; %zu are empty\n", export->table.empty);
}

static bool write_json(const SliceExport *export, Error *error)
{
    const Args *args = export->args;
    const SliceTable *table = &export->table;
    const SliceTableDef *wanted = &export->wanted;
    if (!args->json)
        return true;
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:I, s:b, s:f, s:{s:[f,f,f], s:[f,f,f], s:[i,i], s:s, s:s, s:b, s:I}}", "command",
        "export", "input", args->scenes[0], "output", args->output, "snapshots", (json_int_t) export->slices,
        "stopped", export->interrupted, "simulated_seconds", table->time, "slice", "point", wanted->point[0],
        wanted->point[1], wanted->point[2], "normal", table->plane.normal[0], table->plane.normal[1],
        table->plane.normal[2], "samples", wanted->samples[0], wanted->samples[1], "scalar",
        scalar_list[wanted->scalar].name, "kernel", plane_kernels[wanted->kernel].name, "raw", wanted->raw,
        "empty", (json_int_t)table->empty);
    const bool written = json_file_write(json, args->json, error);
    json_decref(json);
    return written;
}

static bool run(SliceExport *export, Error *error)
{
    const Args *args = export->args;
    if (args->json && !json_file_check(args->json, error))
        return false;
    Headless *context = headless_create(HEADLESS_GPU_AUTO, error);
    if (context && !args->quiet)
        renderer_tell(headless_renderer(context));
    export->flaws = snapshot_flaws(export->reader, false);
    export->flaws.summed = true;
    bool done = context && (export->format->each ? write_all : write_one)(export, error);
    if (done)
        report(export);
    done = done && write_json(export, error);
    slice_table_free(&export->table);
    if (context)
        slice_maker_destroy(&export->maker);
    headless_destroy(context);
    return done;
}

int export_slice(const Args *args)
{
    SliceExport export = {.args = args};
    Error error = {{0}};
    const bool understood = understand(&export, &error), done = understood && run(&export, &error);
    if (!done)
        fprintf(stderr, "%s\n", error.message);
    if (understood && !done && args->json)
        failure_json_write(failure_json("export", "input", args->scenes[0], args->output, &error),
                           args->json);
    snapshot_reader_close(export.reader);
    return !understood ? EXIT_USAGE : !done ? EXIT_FAILED : export.interrupted ? EXIT_INTERRUPTED : 0;
}
