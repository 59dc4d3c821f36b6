#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/files/export.h"
#include "app/files/pictures.h"
#include "app/run/measure/measure.h"
#include "app/run/offscreen.h"
#include "app/run/playback/playback.h"
#include "app/scene/scene.h"
#include "render/frame/view.h"
#include "sim/def/fluids.h"
#include "sim/kernel/kernel.h"
#include "sim/start/start.h"
#include "sim/step/constants.h"
#include "sim/world.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* Output as text, and as JSON for --json. */
typedef struct Info {
    bool quiet;
    json_t *json, *list; /* the whole JSON; the present list */
} Info;

static void begin_list(Info *info, const char *title, const char *key)
{
    if (!info->quiet)
        printf("%s\n", title);
    info->list = json_array();
    json_object_set_new(info->json, key, info->list);
}

static json_t *add_row(Info *info, const char *name, const char *word, const char *text)
{
    json_t *row = json_pack("{s:s, s:s}", "name", name, word, text);
    json_array_append_new(info->list, row);
    return row;
}

/* Adds a row; its object belongs to the list. */
static json_t *put_row(Info *info, const char *name, const char *help)
{
    if (!info->quiet)
        printf("  %-12s %s\n", name, help);
    return add_row(info, name, "help", help);
}

static void put_named(Info *info, const char *title, const char *key, const Named *list)
{
    begin_list(info, title, key);
    for (; list->name; list++)
        put_row(info, list->name, list->help);
}

/* Tests with a world of the scene, or a small world, if a backend on a GPU can run; `no_context`: the reason
   for a missing context, or NULL. */
static void put_backend(Info *info, const Named *backend, const WorldDef *scene, const char *no_context)
{
    WorldDef def = *scene;
    Error error = {{0}};
    json_t *row = put_row(info, backend->name, backend->help);
    snprintf(def.backend, sizeof def.backend, "%s", backend->name);
    const bool on_gpu = world_on_gpu(&def);
    const bool fits = !on_gpu || (!no_context && world_fits(&def, &error));
    const char *reason = fits ? NULL : no_context ? no_context : error.message;
    if (reason && !info->quiet)
        printf("  %-12s cannot run here: %s\n", "", reason);
    json_object_set_new(row, "runs", json_boolean(!reason));
    if (reason)
        json_object_set_new(row, "reason", json_string(reason));
}

/* A small world: a block of fluid in a box. */
static WorldDef small_def(void)
{
    static const Fill block = {.kind = FILL_BLOCK, .min = {-0.5, 0, -0.5}, .max = {0.5, 0.5, 0.5}};
    WorldDef def = world_def_default();
    for (int k = 0; k < 3; k++)
        def.box_size[k] = 1;
    def.spacing = 0.1;
    def.fluid_count = 1;
    def.fluids[0] = (FluidDef){.density = 1000, .fill_count = 1, .fills = &block};
    return def;
}

/* In a process of its own, as a driver may crash where memory is short: a context, a small world on each
 * backend. */
_Noreturn static void try_driver(const WorldDef *small, int gpu)
{
    const struct rlimit no_core = {0, 0};
    Error none;
    WorldDef def = *small;
    setrlimit(RLIMIT_CORE, &no_core);
    for (int number = SIGHUP; number < SIGSYS; number++)
        signal(number, SIG_DFL); /* silent */
    Headless *context = headless_create(gpu, &none);
    for (const Named *backend = world_backends(); context && backend->name; backend++) {
        snprintf(def.backend, sizeof def.backend, "%s", backend->name);
        if (world_on_gpu(&def))
            world_fits(&def, &none);
    }
    _exit(0);
}

static bool driver_holds(const WorldDef *small, int gpu, Error *error)
{
    int status = 0;
    driver_error_install();
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0)
        try_driver(small, gpu);
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    return status == 0 || error_set(error, "the OpenGL driver crashes here; memory may be short (ulimit -v)");
}

static void put_backends(Info *info, const WorldDef *scene, int gpu)
{
    Error error = {{0}};
    const WorldDef small = small_def();
    Headless *context = driver_holds(&small, gpu, &error) ? headless_create(gpu, &error) : NULL;
    const char *renderer = context ? headless_renderer(context) : error.message;
    if (!info->quiet)
        printf("renderer\n  %s\n", renderer);
    json_object_set_new(info->json, "renderer", context ? json_string(renderer) : json_null());
    if (!context)
        json_object_set_new(info->json, "no_renderer", json_string(renderer));
    begin_list(info, "backends", "backends");
    for (const Named *backend = world_backends(); backend->name; backend++)
        put_backend(info, backend, scene ? scene : &small, context ? NULL : error.message);
    headless_destroy(context);
}

/* A feature of a scene: `set` asks for it in a def. */
typedef struct Feature {
    const char *name;
    void (*set)(WorldDef *def);
} Feature;

static void set_solid(WorldDef *def)
{
    def->solids[def->solid_count++] = (SolidDef){.kind = SOLID_SPHERE, .radius = 0.1, .axis = {0, 1, 0}};
}

static void set_emitters(WorldDef *def)
{
    def->pours = true;
}

static void set_drain(WorldDef *def)
{
    def->drain_count = 1;
}

static void set_periodic(WorldDef *def)
{
    def->periodic[0] = true;
}

static void set_no_slip(WorldDef *def)
{
    def->fluids[0].viscosity = 1;
    def->wall_slip = SLIP_NONE;
}

static void set_tension(WorldDef *def)
{
    def->fluids[0].surface_tension = 0.07;
    def->tension_model = TENSION_COLOUR_FIELD;
}

static void set_implicit(WorldDef *def)
{
    def->fluids[0].viscosity = 1;
    def->viscosity_solver = VISCOSITY_IMPLICIT;
}

static void set_acceleration(WorldDef *def)
{
    def->acceleration = true;
}

static const Feature features[] = {
    {"solids", set_solid},
    {"emitters", set_emitters},
    {"drains", set_drain},
    {"periodic sides", set_periodic},
    {"no-slip walls", set_no_slip},
    {"surface tension", set_tension},
    {"implicit viscosity", set_implicit},
    {"acceleration", set_acceleration},
};

/* A row: yes or no by backend. */
static void put_feature(Info *info, const char *name, const WorldDef *def)
{
    json_t *row = json_pack("{s:s}", "name", name);
    WorldDef on = *def;
    json_array_append_new(info->list, row);
    if (!info->quiet)
        printf("  %-20s", name);
    for (const Named *backend = world_backends(); backend->name; backend++) {
        snprintf(on.backend, sizeof on.backend, "%s", backend->name);
        const bool can = world_can(&on, NULL);
        json_object_set_new(row, backend->name, json_boolean(can));
        if (!info->quiet)
            printf("%-10s", can ? "yes" : "no");
    }
    if (!info->quiet)
        putchar('\n');
}

/* What each backend has, by world_can of a small world. All backends have the first method. */
static void put_features(Info *info)
{
    const WorldDef small = small_def();
    begin_list(info, "what the backends have", "features");
    if (!info->quiet) {
        printf("  %-20s", "");
        for (const Named *backend = world_backends(); backend->name; backend++)
            printf("%-10s", backend->name);
        putchar('\n');
    }
    for (const Named *method = world_methods(); method->name; method++) {
        char name[NAME_SIZE + 8];
        WorldDef def = small;
        snprintf(name, sizeof name, "method %s", method->name);
        snprintf(def.method, sizeof def.method, "%s", method->name);
        put_feature(info, name, &def);
    }
    for (size_t k = 0; k < sizeof features / sizeof *features; k++) {
        WorldDef def = small;
        snprintf(def.method, sizeof def.method, "%s", world_methods()->name);
        features[k].set(&def);
        put_feature(info, features[k].name, &def);
    }
}

static void put_methods(Info *info)
{
    put_named(info, "methods", "methods", world_methods());
    begin_list(info, "presets, by --preset", "recipes");
    for (const Preset *recipe = preset_list; recipe->name; recipe++)
        put_row(info, recipe->name, recipe->help);
    begin_list(info, "presets of the solver, solver.preset", "presets");
    for (const SolverPreset *preset = solver_preset_list; preset->name; preset++)
        put_row(info, preset->name, preset->help);
    begin_list(info, "density kernels", "density_kernels");
    for (const Kernel *kernel = density_kernels; kernel->name; kernel++)
        put_row(info, kernel->name, kernel->help);
    begin_list(info, "kernels of wcsph", "wcsph_kernels");
    for (const Kernel *kernel = shape_kernels; kernel->name; kernel++)
        put_row(info, kernel->name, kernel->help);
    begin_list(info, "models of surface tension", "surface_tension_models");
    for (const TensionKind *kind = tension_kinds; kind->name; kind++)
        put_row(info, kind->name, kind->help);
    begin_list(info, "forms of viscosity of wcsph", "viscosity_forms");
    for (const ViscosityKind *kind = viscosity_kinds; kind->name; kind++)
        put_row(info, kind->name, kind->help);
}

static void put_views(Info *info)
{
    begin_list(info, "views", "views");
    for (int i = 0; view_at(i); i++)
        put_row(info, view_at(i)->name, view_at(i)->help);
    put_row(info, "none", "draws nothing; for timing the solver alone");
    begin_list(info, "scalars", "scalars");
    for (int s = 0; s < SCALAR_COUNT; s++) {
        const char *name = scalar_name((Scalar)s), *unit = scalar_unit((Scalar)s);
        if (!info->quiet)
            printf("  %-12s %s\n", name, unit);
        add_row(info, name, "unit", unit);
    }
    begin_list(info, "exports", "exports");
    for (int i = 0; export_format_at(i); i++)
        put_row(info, export_format_at(i)->extension, export_format_at(i)->help);
    begin_list(info, "pictures", "pictures");
    for (int i = 0; picture_format_at(i); i++)
        put_row(info, *picture_format_at(i)->extension ? picture_format_at(i)->extension : "folder",
                picture_format_at(i)->help);
}

static void put_metrics(Info *info)
{
    begin_list(info, "metrics of a scene, which chart compares", "metrics");
    for (const MetricKind *metric = metric_kinds; metric->name; metric++) {
        if (!info->quiet)
            printf("  %-17s %s%s%s%s\n", metric->name, metric->help, *metric->unit ? " (" : "", metric->unit,
                   *metric->unit ? ")" : "");
        json_object_set_new(add_row(info, metric->name, "help", metric->help), "unit",
                            json_string(metric->unit));
    }
    begin_list(info, "motions of the box", "motions");
    for (int m = 0; m < MOTION_KIND_COUNT; m++)
        put_row(info, motion_name((MotionKind)m), motion_help((MotionKind)m));
}

/* Prints the numerical friction, where it exceeds the fluid's own friction. */
static void print_friction(const WorldDef *def)
{
    const StepFriction friction = step_friction(def);
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        const double numerical = friction.numerical * fluid->density,
                     artificial =
                         numerical_kinematic(def, step_alpha(def, friction.alpha, f)) * fluid->density;
        if (fmax(numerical, artificial) > fluid->viscosity)
            printf(
                "fluids[%d]: its viscosity is %g Pa s; it rubs as %.3g Pa s does, at this spacing, by %s\n",
                f, fluid->viscosity, fmax(numerical, artificial + fluid->viscosity),
                numerical > 0 ? friction.numerical_key : "solver.artificial_viscosity");
    }
}

static void put_scene(Info *info, const Scene *scene, const Notes *notes)
{
    const size_t count = seed_count(&scene->world, scene->world.spacing);
    json_t *lines = json_array();
    for (int i = 0; i < notes->count; i++)
        json_array_append_new(lines, json_string(notes->line[i]));
    json_object_set_new(info->json, "scene",
                        json_pack("{s:s, s:I, s:o, s:o}", "path", scene->path, "particles", (json_int_t)count,
                                  "notes", lines, "settings", scene_json(scene)));
    notes_print(notes, stderr);
    if (info->quiet)
        return;
    printf("%s: %zu particle%s\n", scene->path, count, plural(count));
    solver_preset_print(scene, stdout);
    print_friction(&scene->world);
    scene_print(scene, stdout);
}

static void put_all(Info *info, const Scene *scene, const Notes *notes, int gpu)
{
    put_backends(info, scene ? &scene->world : NULL, gpu);
    put_features(info);
    put_methods(info);
    put_views(info);
    put_metrics(info);
    if (!info->quiet)
        printf("threads\n  %d\n", world_processors());
    json_object_set_new(info->json, "threads", json_integer(world_processors()));
    if (scene)
        put_scene(info, scene, notes);
}

static int fail(int code, const Error *error)
{
    fprintf(stderr, "%s\n", error->message);
    return code;
}

typedef struct InfoOptions {
    const char *save; /* FILE, or NULL */
} InfoOptions;

static const InfoOptions *own(const Args *args)
{
    return args->own;
}

/* Saves the scene with the command line's settings as a file. */
static bool save(const Args *args, const Scene *scene, Error *error)
{
    char words[512];
    size_t size;
    SceneSaved saved = {.lost = false};
    char *text = scene_file_read(scene->path, &size, error);
    if (!text)
        return false;
    const SceneSource what = {.scene = scene, .path = scene->path, .text = text, .size = size};
    const bool ok = scene_save(&what, own(args)->save, &saved, error);
    scene_saved_words(&saved, words, sizeof words);
    if (ok && !args->quiet)
        fprintf(stderr, "%s\n", words);
    setting_list_free(&saved.changed);
    free(text);
    return ok;
}

static int run_command(const Args *args)
{
    Error error = {{0}};
    Notes notes;
    SceneSettings settings = args->settings;
    Scene scene;
    if (args->scene_count && recorded_is_file(args->scenes[0])) {
        if (!own(args)->save)
            return info_file(args);
        error_set(&error, "--save makes no sense for %s: the file is no scene", args->scenes[0]);
        return fail(EXIT_USAGE, &error);
    }
    if (args->scene_count && !scene_load(args->scenes[0], &settings, &scene, &notes, &error))
        return fail(EXIT_USAGE, &error);
    if (args->json && !json_file_check(args->json, &error))
        return fail(EXIT_FAILED, &error);
    if (own(args)->save && !args->scene_count)
        error_set(&error, "slosh info: --save writes a scene; name the one that it comes from");
    if (*error.message)
        return fail(EXIT_USAGE, &error);
    if (own(args)->save && !save(args, &scene, &error))
        return fail(EXIT_FAILED, &error);
    Info info = {.quiet = args->quiet,
                 .json = json_pack("{s:s, s:s}", "command", "info", "version", SLOSH_VERSION)};
    put_all(&info, args->scene_count ? &scene : NULL, &notes, args->gpu);
    const bool written = !args->json || json_file_write(info.json, args->json, &error);
    json_decref(info.json);
    return written ? 0 : fail(EXIT_FAILED, &error);
}

/* clang-format off */
static const OptionRow options[] = {
    ROWS_SCENE, ROW_VIEW, ROW_PRESET, ROWS_PROCESSOR, ROW_GPU,
    ROW_DEVICE_REFUSED("nothing is simulated; slosh devices lists what is in a recording"),
    {"--save", "FILE", OPTION_TEXT, OWN(InfoOptions, save), .files = files_new, .help = "write the scene with what --set and the like say into a new file FILE.yaml, comments and all"},
    ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_info = {
    .name = "info",
    .usage = "[SCENE|IN.h5part] [OPTIONS]",
    .help =
        "lists what there is to choose from, and a scene's settings; of a file of particles its steps and scalars",
    .takes = "scene",
    .takes_max = 1,
    .own_size = sizeof(InfoOptions),
    .argument_files = files_scene,
    .options = options,
    .run = run_command,
};
