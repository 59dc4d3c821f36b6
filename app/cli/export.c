#include "app/files/export.h"
#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "app/run/playback/playback.h"
#include "slosh/world.h"

#include <math.h>
#include <stdio.h>

bool export_choose(const Args *args, SnapshotReader *reader, size_t *index, Error *error)
{
    const size_t last = snapshot_count_steps(reader) - 1;
    /* allows for rounding of times */
    const double least = args->time - 1e-9 * fmax(args->time, 1);
    double time = -INFINITY;
    *index = args->time_given ? 0 : last;
    if (!args->time_given)
        return true;
    for (; *index <= last; ++*index)
        if (!snapshot_read_time(reader, *index, &time, error))
            return false;
        else if (time >= least)
            return true;
    return error_set(error, "%s: ends at %.9g s, before --time %.9g", args->scenes[0], time, args->time);
}

static void tell_gap(const SnapshotReader *reader, const char *path)
{
    char words[256];
    if (snapshot_gap(reader, words) && snapshot_count_steps(reader) > 0)
        fprintf(stderr, "%s: warning: %s; only the %zu before it can be exported\n", path, words,
                snapshot_count_steps(reader));
}

static bool no_snapshot(const SnapshotReader *reader, const char *path, Error *error)
{
    char words[256];
    if (snapshot_gap(reader, words))
        return error_set(error, "%s: %s; give the steps names from Step#0 on", path, words);
    return error_set(error, "%s: has no whole snapshot; make some with slosh run", path);
}

bool export_open(const Args *args, SnapshotReader **reader, Error *error)
{
    *reader = snapshot_open(args->scenes[0], error);
    if (!*reader)
        return false;
    tell_gap(*reader, args->scenes[0]);
    return snapshot_count_steps(*reader) > 0 || no_snapshot(*reader, args->scenes[0], error);
}

static int fail(int code, const Error *error)
{
    fprintf(stderr, "%s\n", error->message);
    return code;
}

static int fail_run(const Args *args, const Error *error)
{
    failure_json_write(failure_json("export", "input", args->scenes[0], args->output, error), args->json);
    return fail(EXIT_FAILED, error);
}

static json_t *fluids_json(const Export *export)
{
    json_t *fluids = json_array();
    for (size_t k = 0; k < export->scene.fluid_count; k++)
        json_array_append_new(
            fluids, json_pack("{s:s, s:f}", "name", export->fluids[k], "volume", export->volumes[k]));
    return fluids;
}

static json_t *surface_json(const Export *export)
{
    json_t *json = json_pack("{s:f, s:f, s:I, s:I, s:f}", "level", export->level, "cell",
                             export->surface->cell, "vertices", (json_int_t) export->vertices, "triangles",
                             (json_int_t) export->triangles, "volume", export->volume);
    if (json && export->surface->each)
        json_object_set_new(json, "fluids", fluids_json(export));
    return json;
}

static bool write_json(const Export *export, const Args *args, double wall_seconds, Error *error)
{
    if (!args->json)
        return true;
    json_t *json =
        json_pack("{s:s, s:s, s:s, s:s, s:I, s:I, s:I, s:f, s:f, s:b}", "command", "export", "input",
                  args->scenes[0], "output", args->output, "frame", snapshot_frame_name(export->frame),
                  "snapshots", (json_int_t) export->snapshots, "particles", (json_int_t) export->particles,
                  "left_out", (json_int_t)snapshot_flaws_left_out(&export->flaws), "simulated_seconds",
                  export->time, "wall_seconds", wall_seconds, "stopped", export->interrupted);
    if (json && export->surface)
        json_object_set_new(json, "surface", surface_json(export));
    if (json && export->solids)
        json_object_set_new(json, "solids", json_integer(export->solids->count));
    const bool written = json_file_write(json, args->json, error);
    json_decref(json);
    return written;
}

static void report(const Export *export, const Args *args)
{
    if (export->interrupted)
        fprintf(stderr, "stopped at t = %.4g s; %s is whole\n", export->time, args->output);
    snapshot_flaws_print(&export->flaws, args->scenes[0], stderr);
    if (export->empty > 0)
        fprintf(stderr, "%s: warning: %zu of %zu snapshots %s no fluid at that level, and no surface\n",
                args->output, export->empty, export->snapshots, export->empty == 1 ? "has" : "have");
    if (args->quiet)
        return;
    fprintf(stderr, "%s: %zu snapshot%s t = %.4g s, %zu particle%s, ", args->output, export->snapshots,
            export->snapshots == 1 ? " of" : "s up to", export->time, export->particles,
            plural(export->particles));
    if (export->surface)
        fprintf(stderr, "a surface of %zu triangles around %.4g m3 at level %.3g, ", export->triangles,
                export->volume, export->level);
    if (export->solids)
        fprintf(stderr, "%d solid%s, ", export->solids->count, plural((size_t) export->solids->count));
    fprintf(stderr, "in the frame of the %s\n", snapshot_frame_name(export->frame));
}

/* Finds the colormap; a series has one for all snapshots. */
static bool find_colors(Export *export, size_t index, const Args *args, Error *error)
{
    static const Scalar scalars[] = {[COLOR_CHOICE_AUTO] = SCALAR_FLUID,
                                     [COLOR_CHOICE_FLUID] = SCALAR_FLUID,
                                     [COLOR_CHOICE_SPEED] = SCALAR_SPEED,
                                     [COLOR_CHOICE_DENSITY] = SCALAR_DENSITY,
                                     [COLOR_CHOICE_PRESSURE] = SCALAR_PRESSURE};
    const bool series = export_is_series(export->kind);
    return export_colors(export, scalars[args->color_by], series ? 0 : index,
                         series ? snapshot_count_steps(export->reader) : 1, error);
}

static int run(Export *export, size_t index, const Args *args, Error *error)
{
    const double began_ms = wall_ms();
    Progress progress;
    if (args->json && !json_file_check(args->json, error))
        return fail(EXIT_FAILED, error);
    if (!find_colors(export, index, args, error))
        return fail_run(args, error);
    progress_begin(&progress, stderr, "export", args->quiet);
    const bool done = export_is_series(export->kind) ? export_series(export, &progress, error)
                                                     : export_one(export, index, error);
    progress_end(&progress);
    if (!done)
        return fail_run(args, error);
    report(export, args);
    if (!write_json(export, args, (wall_ms() - began_ms) / 1000, error))
        return fail(EXIT_FAILED, error);
    return export->interrupted ? EXIT_INTERRUPTED : 0;
}

static bool understand_surface(Export *export, SurfaceDef *surface, const Args *args, Error *error)
{
    if (!args->surface && (args->level > 0 || args->cell > 0))
        return error_set(error, "%s is of a surface; add --surface", args->level > 0 ? "--level" : "--cell");
    if (!args->surface)
        return true;
    *surface =
        (SurfaceDef){.level = args->level, .cell = args->cell > 0 ? args->cell : 0.5, .each = args->fluids};
    export->surface = surface;
    return snapshot_read_scene(export->reader, &export->scene, error) &&
           surface_check(surface, &export->scene, error);
}

/* Reads the scene, for facts missing in the snapshots. */
static bool read_scene(const Export *export, const Args *args, Scene *scene, Error *error)
{
    SnapshotScene numbers;
    Notes notes = {0};
    if (!recorded_scene(export->reader, args->scenes[0], NULL, &numbers, scene, &notes, error))
        return false;
    notes_print(&notes, stderr);
    return true;
}

static void name_fluids(Export *export, const WorldDef *world)
{
    for (int k = 0; k < world->fluid_count; k++)
        if (*world->fluids[k].name)
            snprintf(export->fluids[k], NAME_SIZE, "%s", world->fluids[k].name);
        else
            snprintf(export->fluids[k], NAME_SIZE, "fluid%d", k);
}

static bool understand_parts(Export *export, ExportSolids *solids, const Args *args, Error *error)
{
    Scene scene;
    if (!args->solids && !args->fluids)
        return true;
    if (!read_scene(export, args, &scene, error))
        return false;
    name_fluids(export, &scene.world);
    if (!args->solids)
        return true;
    if (scene.world.solid_count == 0)
        return error_set(error, "%s: has no solids; export it without --solids", args->scenes[0]);
    export->solids = solids;
    return export_solids_make(solids, &scene.world, error);
}

static bool check_parts(const Export *export, const Args *args, Error *error)
{
    const char *option = args->solids ? "--solids" : args->fluids ? "--fluids" : NULL;
    if (args->fluids && !args->surface)
        return error_set(error, "--fluids is of a surface; add --surface");
    return !option || export->kind == EXPORT_PVD || export_is_obj(export->kind) ||
           error_set(error, "%s has room for one mesh; for %s name a FILE.pvd, or with --surface a FILE.obj",
                     args->output, option);
}

/* Prepares the export before any writing; false: a mistake in the command line or the input. */
static bool understand(Export *export, SurfaceDef *surface, ExportSolids *solids, size_t *index,
                       const Args *args, Error *error)
{
    if (!export_needs_slice(args, error) || !export_kind(args->output, &export->kind, error))
        return false;
    if (export_is_series(export->kind) && args->time_given)
        return error_set(error,
                         "--time makes no sense for all snapshots, %s; name a FILE.vtp, FILE.ply or FILE.obj",
                         args->output);
    if (args->color_by != COLOR_CHOICE_AUTO && !export_is_colored(export->kind))
        return error_set(
            error, "--color-by is of a .ply or a .obj; a .vtp has every scalar, and ParaView colours by any");
    if (export_is_obj(export->kind) && !args->surface)
        return error_set(error, "a .obj holds meshes, no particles: add --surface, or write %s as a .ply",
                         args->output);
    if (!check_parts(export, args, error) || !export_open(args, &export->reader, error))
        return false;
    export->flaws = snapshot_flaws(export->reader, args->surface);
    return understand_surface(export, surface, args, error) &&
           understand_parts(export, solids, args, error) && export_choose(args, export->reader, index, error);
}

int cmd_export(const Args *args)
{
    Export export = {.path = args->output, .frame = args->frame};
    SurfaceDef surface = {0};
    ExportSolids solids = {0};
    Error error = {{0}};
    size_t index = 0;
    interrupt_install();
    if (args->slice)
        return export_slice(args);
    if (args->trails)
        return export_trails(args);
    const int code = understand(&export, &surface, &solids, &index, args, &error)
                         ? run(&export, index, args, &error)
                         : fail(EXIT_USAGE, &error);
    export_solids_free(&solids);
    snapshot_reader_close(export.reader);
    return code;
}
