#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "app/files/export.h"
#include "app/files/snapshot.h"
#include "app/run/offscreen.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A trail export and its results. */
typedef struct TrailExport {
    const Args *args;
    const ExportFormat *format;
    SnapshotReader *reader;
    SnapshotFlaws flaws;
    SnapshotScene scene;
    PathlinesDef def;
    Scalar scalar;
    size_t first, last; /* of the snapshots */
    Pathlines trace;
    size_t steps;     /* count of steps with points */
    double time;      /* of the last step, s */
    bool interrupted; /* by a signal, before the last step */
} TrailExport;

/* ---- the command line ---- */

static bool choose_format(TrailExport *export, Error *error)
{
    const Args *args = export->args;
    const ExportOptions *own = options_of_export(args);
    const char *option = own->surface                         ? "--surface"
                         : own->solids                        ? "--solids"
                         : own->fluids                        ? "--fluids"
                         : own->color_by != COLOR_CHOICE_AUTO ? "--color-by"
                         : own->level > 0                     ? "--level"
                         : own->cell > 0                      ? "--cell"
                         : own->kernel                        ? "--kernel"
                         : own->raw                           ? "--raw"
                         : args_given(args, "--size")         ? "--size"
                                                              : NULL;
    if (option)
        return error_set(error, "%s makes no sense with --trails, which are lines", option);
    export->format = export_format_find(args->output, EXPORT_LINES, error);
    return export->format != NULL;
}

/* Starts `length` before the end. */
static bool choose_first(TrailExport *export, Error *error)
{
    double end, time;
    export->first = 0;
    if (!snapshot_read_time(export->reader, export->last, &end, error))
        return false;
    for (size_t k = export->last; k-- > 0 && export->def.length > 0;) {
        if (!snapshot_read_time(export->reader, k, &time, error))
            return false;
        if (time < end - export->def.length - 1e-9 * fmax(end, 1)) {
            export->first = k + 1;
            break;
        }
    }
    return export->first < export->last ||
           error_set(error, "%s: a line needs two steps, and there is one from %.9g s to %.9g s; %s",
                     export->args->scenes[0], export->def.length > 0 ? end - export->def.length : end, end,
                     export->last == 0 ? "take a later --time or a longer run" : "take a larger length");
}

/* Lines need particle ids. */
static bool has_ids(const TrailExport *export, const SnapshotStep *step, size_t index, Error *error)
{
    return !snapshot_step_misses(step, "id") ||
           error_set(error, "%s: Step#%zu has no ids, and nobody knows which particle went where",
                     export->args->scenes[0], index);
}

/* Checks the last step for ids, before any writing. */
static bool check_ids(const TrailExport *export, Error *error)
{
    SnapshotStep step;
    if (!snapshot_read_for_display(export->reader, export->last, &step, error))
        return false;
    const bool has = has_ids(export, &step, export->last, error);
    snapshot_step_free(&step);
    return has;
}

static bool understand(TrailExport *export, Error *error)
{
    const Args *args = export->args;
    const ExportOptions *own = options_of_export(args);
    return choose_format(export, error) && pathlines_def_read(&export->def, own->trails, error) &&
           export_scalar(own->scalar ? own->scalar : "speed", &export->scalar, error) &&
           export_open(args, &export->reader, error) &&
           snapshot_read_scene(export->reader, &export->scene, error) &&
           export_choose(args, export->reader, &export->last, error) && choose_first(export, error) &&
           check_ids(export, error) &&
           export_has_scalar(args, export->reader, export->last, export->scalar, error);
}

/* ---- steps ---- */

/* True if a step must be read although it adds no points: lines may begin at a place or across a plane. */
static bool is_read(const TrailExport *export, bool column)
{
    return column || pathlines_def_has_plane(&export->def) || pathlines_def_has_region(&export->def);
}

/* Checks a step, which may lack columns of the last step. */
static bool check_step(const TrailExport *export, const SnapshotStep *step, size_t index, Error *error)
{
    return has_ids(export, step, index, error) &&
           ((snapshot_scalar_attributes(export->scalar) & ~snapshot_attributes(step)) == 0 ||
            error_set(error, "%s: Step#%zu has no %s", export->args->scenes[0], index,
                      scalar_name(export->scalar)));
}

static bool take_step(TrailExport *export, size_t index, Error *error)
{
    SnapshotStep step;
    double time;
    if (!snapshot_read_time(export->reader, index, &time, error))
        return false;
    const bool column = index == export->last || pathlines_step_has_points(&export->trace, time);
    if (!is_read(export, column))
        return true;
    if (!snapshot_read_for_display(export->reader, index, &step, error))
        return false;
    const bool taken = check_step(export, &step, index, error) &&
                       (snapshot_validate(&export->flaws, index, &step) ||
                        error_set(error, "out of memory for a snapshot")) &&
                       pathlines_step(&export->trace, &step, column, error);
    snapshot_step_free(&step);
    export->steps += column;
    export->time = time;
    return taken;
}

static bool take_steps(TrailExport *export, Error *error)
{
    Progress progress;
    bool done = true;
    progress_begin(&progress, stderr, "export", export->args->quiet);
    for (size_t k = export->first; done && k <= export->last && !export->interrupted; k++) {
        done = take_step(export, k, error);
        progress_update(&progress,
                        (double)(k + 1 - export->first) / (double)(export->last + 1 - export->first));
        export->interrupted = k < export->last && interrupted();
    }
    progress_end(&progress);
    return done;
}

/* ---- the file ---- */

static bool write_lines(const TrailExport *export, const char *name, const PathlineRows *order,
                        const PathlineRows *offset, Error *error)
{
    const Pathlines *trace = &export->trace;
    const VtpLines lines = {.time = export->time,
                            .points = trace->line.count,
                            .lines = trace->id.count,
                            .place = trace->place.data,
                            .when = trace->when.data,
                            .scalar = scalar_name(export->scalar),
                            .value = trace->value.data,
                            .order = order->data,
                            .offset = offset->data,
                            .id = trace->id.data};
    const ExportContent content = {.time = export->time,
                                   .frame = snapshot_frame_name(options_of_export(export->args)->frame),
                                   .lines = &lines};
    return export_content_write(export->format, &content, name, export->args->output, error);
}

static bool sort_and_write(const TrailExport *export, const char *name, Error *error)
{
    PathlineRows order = {0}, offset = {0};
    const bool written = pathlines_sort(&export->trace, &order, &offset, error) &&
                         write_lines(export, name, &order, &offset, error);
    pathline_rows_free(&order);
    pathline_rows_free(&offset);
    return written;
}

static bool make(TrailExport *export, Error *error)
{
    Output output = {0};
    if (!output_begin(&output, export->args->output, error))
        return false;
    pathlines_begin(&export->trace, &export->def, &export->scene, options_of_export(export->args)->frame,
                    export->scalar, export->args->output);
    if (take_steps(export, error) && sort_and_write(export, output.temp, error))
        return output_commit(&output, error);
    output_discard(&output);
    return false;
}

/* ---- messages ---- */

static void report(const TrailExport *export)
{
    const Args *args = export->args;
    const Pathlines *trace = &export->trace;
    const ScalarRow *scalar = &scalar_list[export->scalar];
    if (export->interrupted)
        fprintf(stderr, "stopped at t = %.4g s; %s is whole\n", export->time, args->output);
    snapshot_flaws_print(&export->flaws, args->scenes[0], stderr);
    if (trace->ends_count == 0)
        fprintf(stderr, "%s: warning: no particle has such an id: there are no trails\n", args->output);
    else if (trace->id.count == 0)
        fprintf(stderr, "%s: warning: none of %zu particles %s: there are no trails\n", args->output,
                trace->ends_count,
                pathlines_def_has_plane(&export->def) ? "crosses that plane"
                                                      : "is in that region when it is seen first");
    if (args->quiet)
        return;
    fprintf(stderr,
            "%s: %zu trail%s of %zu points, %s%s%s%s, %zu steps up to t = %.4g s, in the frame of the %s\n",
            args->output, trace->id.count, plural(trace->id.count), trace->line.count, scalar->name,
            *scalar->unit ? " (" : "", scalar->unit, *scalar->unit ? ")" : "", export->steps, export->time,
            snapshot_frame_name(options_of_export(args)->frame));
}

static bool write_json(const TrailExport *export, double wall_seconds, Error *error)
{
    const Args *args = export->args;
    const Pathlines *trace = &export->trace;
    if (!args->json)
        return true;
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:s, s:I, s:I, s:I, s:I, s:I, s:s, s:f, s:f, s:b}", "command", "export", "input",
        args->scenes[0], "output", args->output, "frame", snapshot_frame_name(options_of_export(args)->frame),
        "snapshots", (json_int_t) export->steps, "particles", (json_int_t)trace->ends_count, "trails",
        (json_int_t)trace->id.count, "points", (json_int_t)trace->line.count, "left_out",
        (json_int_t)snapshot_flaws_left_out(&export->flaws), "scalar", scalar_name(export->scalar),
        "simulated_seconds", export->time, "wall_seconds", wall_seconds, "stopped", export->interrupted);
    const bool written = json_file_write(json, args->json, error);
    json_decref(json);
    return written;
}

static bool run(TrailExport *export, Error *error)
{
    const Args *args = export->args;
    const bool derived = (int)export->scalar >= SCALAR_STATE_COUNT;
    const double began_ms = wall_ms();
    if (args->json && !json_file_check(args->json, error))
        return false;
    Headless *context = derived ? headless_create(HEADLESS_GPU_AUTO, error) : NULL;
    if (context && !args->quiet)
        renderer_tell(headless_renderer(context));
    export->flaws = snapshot_flaws(export->reader, false);
    const bool made = (context || !derived) && make(export, error);
    if (made)
        report(export);
    const bool done = made && write_json(export, (wall_ms() - began_ms) / 1000, error);
    pathlines_free(&export->trace);
    headless_destroy(context);
    return done;
}

int export_trails(const Args *args)
{
    TrailExport export = {.args = args};
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
