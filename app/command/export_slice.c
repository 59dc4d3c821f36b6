#include "app/base/json_file.h"
#include "app/base/output.h"
#include "app/base/suggest.h"
#include "app/command/cmd.h"
#include "app/command/export_parts.h"
#include "app/output/slice_table.h"
#include "app/output/snapshot_sift.h"
#include "app/session/headless.h"
#include "render/plane/plane_kernel.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* What is to be done. */
typedef struct SliceExport {
    const Args *args;
    SnapshotReader *reader;
    SnapshotScene scene;
    SnapshotFlaws flaws;
    SliceWanted wanted;
    size_t index; /* of the snapshot */
    bool csv;     /* else VTK's image data */
} SliceExport;

static bool ends_in(const char *path, const char *extension)
{
    const size_t length = strlen(path), end = strlen(extension);
    return length > end && strcasecmp(path + length - end, extension) == 0;
}

bool export_needs_slice(const Args *args, Error *error)
{
    const char *option = args->raw          ? "--raw"
                         : args->kernel     ? "--kernel"
                         : args->scalar     ? "--scalar"
                         : args->size_given ? "--size"
                                            : NULL;
    if (option)
        return error_set(error, "%s is of a slice; add --slice \"{point: [0, 0, 0], normal: [0, 0, 1]}\"",
                         option);
    if (!ends_in(args->output, ".vti") && !ends_in(args->output, ".csv"))
        return true;
    return error_set(error, "%s is of a slice; add --slice \"{point: [0, 0, 0], normal: [0, 0, 1]}\"",
                     args->output);
}

/* ---- the command line ---- */

const char *export_scalar_choice(int index)
{
    return slice_scalars[index].name;
}

/* The first is the solver's own, which is no shape. */
const char *export_kernel_choice(int index)
{
    return plane_kernels[1 + index].name;
}

/* Which of the names it is; what to take where it is none of them. */
static bool find_name(const char *option, const char *name, const char *(*names)(int), int *found,
                      Error *error)
{
    char list[256] = "";
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

static bool find_scalar(const char *name, int *scalar, Error *error)
{
    return find_name("--scalar", name, export_scalar_choice, scalar, error);
}

static bool find_kernel(const char *name, int *kernel, Error *error)
{
    const bool found = find_name("--kernel", name, export_kernel_choice, kernel, error);
    ++*kernel;
    return found;
}

/* The file's own kernel, where it says one. */
static bool choose_kernel(SliceExport *export, Error *error)
{
    char own[NAME_SIZE];
    if (export->args->kernel)
        return find_kernel(export->args->kernel, &export->wanted.kernel, error);
    export->wanted.kernel = snapshot_kernel(export->reader, own) ? plane_kernel_named(own) : 1;
    return true;
}

static bool refuse_others(const Args *args, Error *error)
{
    const char *option = args->surface                         ? "--surface"
                         : args->frame != FRAME_BOX            ? "--frame world"
                         : args->color_by != COLOR_CHOICE_AUTO ? "--color-by"
                         : args->level > 0                     ? "--level"
                         : args->cell > 0                      ? "--cell"
                                                               : NULL;
    return !option ||
           error_set(error, "%s makes no sense with --slice, which is of numbers in the frame of the box",
                     option);
}

static bool understand(SliceExport *export, Error *error)
{
    const Args *args = export->args;
    export->wanted =
        (SliceWanted){.normal = {0, 0, 1}, .samples = {args->width, args->height}, .raw = args->raw};
    export->csv = ends_in(args->output, ".csv");
    if (!export->csv && !ends_in(args->output, ".vti"))
        return error_set(error, "cannot tell the format of a slice from '%s'; use .vti or .csv",
                         args->output);
    return refuse_others(args, error) && slice_wanted_read(&export->wanted, args->slice, error) &&
           find_scalar(args->scalar ? args->scalar : "pressure", &export->wanted.scalar, error) &&
           export_open(args, &export->reader, error) &&
           snapshot_read_scene(export->reader, &export->scene, error) && choose_kernel(export, error) &&
           export_choose(args, export->reader, &export->index, error);
}

/* ---- the file ---- */

static bool write_table(const SliceExport *export, const SliceTable *table, Error *error)
{
    Output output = {0};
    if (!output_begin(&output, export->args->output, error))
        return false;
    FILE *file = fopen(output.temp, "wb");
    bool written = file && (export->csv ? slice_table_csv : slice_table_vti)(file, table);
    int reason = errno;
    if (file && fclose(file) != 0) {
        reason = written ? errno : reason;
        written = false;
    }
    if (written)
        return output_commit(&output, error);
    output_discard(&output);
    return error_set(error, "%s: cannot be written: %s", export->args->output, strerror(reason));
}

static bool make_table(SliceExport *export, SliceTable *table, Error *error)
{
    SnapshotStep step;
    if (!snapshot_read_step(export->reader, export->index, &step, error))
        return false;
    export->flaws = snapshot_flaws(export->reader, false);
    const bool made = (snapshot_sift(&export->flaws, export->index, &step) ||
                       error_set(error, "out of memory for a snapshot")) &&
                      slice_table_make(&export->wanted, &export->scene, &step, table, error);
    snapshot_step_free(&step);
    return made;
}

/* ---- what is said ---- */

static void report(const SliceExport *export, const SliceTable *table)
{
    const Args *args = export->args;
    const SliceWanted *wanted = &export->wanted;
    const size_t all = (size_t)wanted->samples[0] * (size_t)wanted->samples[1];
    const double across =
        hypot(table->plane.size[0] / wanted->samples[0], table->plane.size[1] / wanted->samples[1]);
    snapshot_flaws_print(&export->flaws, args->scenes[0], stderr);
    if (table->empty == all)
        fprintf(stderr, "%s: warning: no particle is within a support radius of the plane: all is empty\n",
                args->output);
    else if (2 * export->scene.support_radius < across)
        fprintf(stderr,
                "%s: warning: samples are %.3g m apart and particles reach %.3g m: some lie between samples; "
                "use a larger --size\n",
                args->output, across, export->scene.support_radius);
    if (args->quiet)
        return;
    fprintf(stderr, "%s: %d x %d samples of %s%s%s%s, %s, kernel %s, t = %.4g s; %zu are empty\n",
            args->output, wanted->samples[0], wanted->samples[1], slice_scalars[wanted->scalar].name,
            *slice_scalars[wanted->scalar].unit ? " (" : "", slice_scalars[wanted->scalar].unit,
            *slice_scalars[wanted->scalar].unit ? ")" : "", wanted->raw ? "sums" : "means",
            plane_kernels[wanted->kernel].name, table->time, table->empty);
}

static bool write_json(const SliceExport *export, const SliceTable *table, Error *error)
{
    const Args *args = export->args;
    const SliceWanted *wanted = &export->wanted;
    if (!args->json)
        return true;
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:f, s:{s:[f,f,f], s:[f,f,f], s:[i,i], s:s, s:s, s:b, s:I}}", "command", "export",
        "input", args->scenes[0], "output", args->output, "simulated_seconds", table->time, "slice", "point",
        wanted->point[0], wanted->point[1], wanted->point[2], "normal", table->plane.normal[0],
        table->plane.normal[1], table->plane.normal[2], "samples", wanted->samples[0], wanted->samples[1],
        "scalar", slice_scalars[wanted->scalar].name, "kernel", plane_kernels[wanted->kernel].name, "raw",
        wanted->raw, "empty", (json_int_t)table->empty);
    const bool written = json_file_write(json, args->json, error);
    json_decref(json);
    return written;
}

static bool run(SliceExport *export, Error *error)
{
    SliceTable table = {0};
    const Args *args = export->args;
    if (args->json && !json_file_check(args->json, error))
        return false;
    Headless *context = headless_create(HEADLESS_GPU_AUTO, error);
    if (context && !args->quiet)
        fprintf(stderr, "renderer: %s\n", headless_renderer(context));
    bool done = context && make_table(export, &table, error) && write_table(export, &table, error);
    if (done)
        report(export, &table);
    done = done && write_json(export, &table, error);
    slice_table_free(&table);
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
    return done ? 0 : understood ? EXIT_FAILED : EXIT_USAGE;
}
