#include "app/files/export.h"
#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/run/playback/playback.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>

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
    const bool series = export->format->each != NULL;
    return export_colors(export, scalars[options_of_export(args)->color_by], series ? 0 : index,
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
    const bool done =
        export->format->each ? export_series(export, &progress, error) : export_one(export, index, error);
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
    const ExportOptions *own = options_of_export(args);
    if (!own->surface && (own->level > 0 || own->cell > 0))
        return error_set(error, "%s is of a surface; add --surface", own->level > 0 ? "--level" : "--cell");
    if (!own->surface)
        return true;
    *surface =
        (SurfaceDef){.level = own->level, .cell = own->cell > 0 ? own->cell : 0.5, .each = own->fluids};
    export->surface = surface;
    return snapshot_read_scene(export->reader, &export->scene, error) &&
           surface_check(surface, &export->scene, error);
}

/* Reads the scene, for facts missing in the snapshots. */
static bool read_scene(const Export *export, const Args *args, Scene *scene, Error *error)
{
    SnapshotScene numbers;
    Notes notes = {0};
    if (!recorded_scene(export->reader, args->scenes[0], snapshot_is_foreign(args->scenes[0]), NULL, &numbers,
                        scene, &notes, error))
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
    const ExportOptions *own = options_of_export(args);
    Scene scene;
    if (!own->solids && !own->fluids)
        return true;
    if (!read_scene(export, args, &scene, error))
        return false;
    name_fluids(export, &scene.world);
    if (!own->solids)
        return true;
    if (scene.world.solid_count == 0)
        return error_set(error, "%s: has no solids; export it without --solids", args->scenes[0]);
    export->solids = solids;
    return export_solids_make(solids, &scene.world, error);
}

static bool check_parts(const Export *export, const Args *args, Error *error)
{
    const ExportOptions *own = options_of_export(args);
    const char *option = own->solids ? "--solids" : own->fluids ? "--fluids" : NULL;
    if (own->fluids && !own->surface)
        return error_set(error, "--fluids is of a surface; add --surface");
    return !option || export->format->has_parts || (export->format->holds & EXPORT_MESHES) != 0 ||
           error_set(error, "%s has room for one mesh; for %s name a FILE.pvd, or with --surface a FILE.obj",
                     args->output, option);
}

/* Prepares the export before any writing; false: a mistake in the command line or the input. */
static bool understand(Export *export, SurfaceDef *surface, ExportSolids *solids, size_t *index,
                       const Args *args, Error *error)
{
    const ExportOptions *own = options_of_export(args);
    if (!export_needs_slice(args, error) ||
        !(export->format = export_format_find(args->output, EXPORT_SNAPSHOT, error)))
        return false;
    if (export->format->each && args_given(args, "--time"))
        return error_set(error,
                         "--time makes no sense for all snapshots, %s; name a FILE.vtp, FILE.ply or FILE.obj",
                         args->output);
    if (own->color_by != COLOR_CHOICE_AUTO && !export->format->colored)
        return error_set(
            error, "--color-by is of a .ply or a .obj; a .vtp has every scalar, and ParaView colours by any");
    if ((export->format->holds & EXPORT_PARTICLES) == 0 && !own->surface)
        return error_set(error, "a .obj holds meshes, no particles: add --surface, or write %s as a .ply",
                         args->output);
    if (!check_parts(export, args, error) || !export_open(args, &export->reader, error))
        return false;
    export->flaws = snapshot_flaws(export->reader, own->surface);
    return understand_surface(export, surface, args, error) &&
           understand_parts(export, solids, args, error) && export_choose(args, export->reader, index, error);
}

/* A series has a folder for its files. */
static void files_export(CommandFiles *files, const OptionRow *row, const char *output)
{
    const ExportFormat *format = export_format_find(output, ~0U, NULL);
    files_replaced(files, row, output);
    if (format && format->each)
        command_files_add_beside(files, "the folder of -o", output, strlen(format->extension) + 1, "", "*");
}

static int run_command(const Args *args)
{
    const ExportOptions *own = options_of_export(args);
    Export export = {.path = args->output, .frame = own->frame};
    SurfaceDef surface = {0};
    ExportSolids solids = {0};
    Error error = {{0}};
    size_t index = 0;
    interrupt_install();
    if (own->slice)
        return export_slice(args);
    if (own->trails)
        return export_trails(args);
    const int code = understand(&export, &surface, &solids, &index, args, &error)
                         ? run(&export, index, args, &error)
                         : fail(EXIT_USAGE, &error);
    export_solids_free(&solids);
    snapshot_reader_close(export.reader);
    return code;
}

/* Gives "box|world". */
#define X(NAME, name) "|" name
#define FRAMES        (&("" SNAPSHOT_FRAMES(X))[1])

/* clang-format off */
static const OptionRow options[] = {
    ROW_OUTPUT("OUT", .files = files_export, .help = "the file or folder to write"),
    ROW_TIME(0, "the one snapshot at that time, or the first after it (the last)"),
    {"--frame", FRAMES, OPTION_CHOICE, OWN(ExportOptions, frame), .min = FRAME_BOX, .help = "whose positions and velocities are written (box)"},
    {"--surface", NULL, OPTION_FLAG, OWN(ExportOptions, surface), .help = "the fluid's surface as a mesh instead of the particles"},
    {"--fluids", NULL, OPTION_FLAG, OWN(ExportOptions, fluids), .help = "with --surface: a mesh of each fluid with a smooth border between them, as blocks of a .pvd or objects of a .obj"},
    {"--solids", NULL, OPTION_FLAG, OWN(ExportOptions, solids), .help = "beside them each solid as a mesh of its own that moves with it: a block of a .pvd, or with --surface an object of a .obj"},
    {"--level", "F", OPTION_NUMBER, .offset = offsetof(ExportOptions, level), .max = 0.99, .flags = OPTION_OWN | OPTION_OPEN_LOW,
     .help = "level of the field at the surface (the level that encloses the fluid's volume: about 0.5)"},
    {"--cell", "SPACINGS", OPTION_NUMBER, OWN(ExportOptions, cell), .min = 0.05, .max = 4, .help = "side of the cells of the surface (0.5)"},
    {"--color-by", "fluid|speed|density|pressure", OPTION_CHOICE, OWN(ExportOptions, color_by), .min = COLOR_CHOICE_FLUID,
     .help = "colours of a .ply or a .obj: the fluids' own, or a colormap from the least to the greatest value (fluid)"},
    {"--slice", "{point: [X, Y, Z], normal: [X, Y, Z]}", OPTION_TEXT, OWN(ExportOptions, slice),
     .help = "a scalar on that plane, in the box's frame, as OUT.vti or OUT.csv; m"},
    {"--trails", "{stride: N, length: S, ...}", OPTION_TEXT, OWN(ExportOptions, trails),
     .help = "the paths of particles up to that time, as OUT.vtp: keys stride, ids, length, every, region_min, region_max, plane_point, plane_normal, as of the overlay trails; {}: of every 20th from the first step on"},
    {"--scalar", "NAME", OPTION_TEXT, OWN(ExportOptions, scalar), .help = "scalar of the slice (pressure) or of the trails (speed)", .names = export_scalar_choice},
    {"--kernel", "NAME", OPTION_TEXT, OWN(ExportOptions, kernel), .help = "kernel of the slice (the kernel of the file's method)", .names = export_kernel_choice},
    {"--raw", NULL, OPTION_FLAG, OWN(ExportOptions, raw), .help = "the slice as sums of V W s, without the division by the sums of V W"},
    ROW_SIZE("samples of the slice along and up"),
    ROW_DEVICE_REFUSED("nothing is simulated; slosh run takes it"),
    ROW_JSON, ROWS_END
};
/* clang-format on */
#undef X

const Command command_export = {
    .name = "export",
    .usage = "IN.h5part -o OUT.pvd|.vtp|.ply|.obj|.csv|.vti ...",
    .help = "writes snapshots in the formats of other programs",
    .takes = "snapshot file",
    .takes_min = 1,
    .takes_max = 1,
    .output = "OUT.pvd, OUT.vtp, OUT.ply, OUT.obj, or of a slice OUT.csv, OUT.vti or OUT.pvd",
    .width = 256,
    .height = 192,
    .own_size = sizeof(ExportOptions),
    .argument_files = files_snapshots,
    .options = options,
    .run = run_command,
};
