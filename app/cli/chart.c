#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/lab/error_chart.h"
#include "app/lab/view_benchmark.h"
#include "sim/gpu/gl.h"

#include <math.h>
#include <string.h>

static const double DEFAULT_TIME = 0.5; /* s */

enum { DEFAULT_SIDE = 256 };

/* ---- pictures ---- */

typedef struct ViewState {
    ViewPlan plan;
    int factor;
    double time;
    int width, height;
    World *world; /* at `time`; NULL: not needed yet */
    Scene scene;  /* of the world */
    LinearPicture reference;
    int reference_of; /* place in the plan + 1; 0: none */
} ViewState;

static bool pictures_plan(ExperimentRun *run, Error *error)
{
    const Args *args = run->args;
    ViewState *views = run->state;
    views->time = args_given(args, "--time") ? args->time : DEFAULT_TIME;
    views->width = args->width > 0 ? args->width : DEFAULT_SIDE;
    views->height = args->height > 0 ? args->height : DEFAULT_SIDE;
    if (args->sweep_count > 0)
        return error_set(error, "slosh chart: --views has a plan of its own; leave --sweep out, or name one "
                                "view by --set view.kind=...");
    if (!experiment_name_files(run, error) || !view_plan_make(args, &views->plan, error))
        return false;
    run->wanted = views->plan.count;
    return true;
}

/* Adds the shaders of --shaders to the key, each with its includes. */
static uint64_t shaders_key(const char *directory, uint64_t key)
{
    for (const EmbeddedShader *shader = embedded_shaders; directory && shader->path; shader++) {
        ShaderSource source = {0};
        Error none;
        if (shader_source_load(&source, shader->path, NULL, &none))
            key = run_key_text(run_key_text(key, shader->path), source.text);
        shader_source_free(&source);
    }
    return key;
}

static bool picture_prepare(ExperimentRun *run, int i, void *of, Error *error)
{
    Scene scene;
    char more[512];
    ViewState *views = run->state;
    const ViewJob *job = &views->plan.jobs[i];
    ViewRow *row = of;
    snprintf(more, sizeof more, "%s %.9g %d %d %d %s", SLOSH_VERSION, views->time, views->width,
             views->height, views->factor, headless_renderer(run->context));
    *row = (ViewRow){.ms = (double)NAN, .error = (double)NAN, .structure = (double)NAN};
    snprintf(row->view, sizeof row->view, "%s", job->kind->name);
    memcpy(row->settings, job->name, sizeof row->settings);
    row->key = shaders_key(run->args->shaders, run_key_text(RUN_KEY, more));
    return view_job_scene(&views->plan, job, &scene, error) && run_key_scene(&scene, true, &row->key, error);
}

/* The name of the plan stays: two jobs may mean the same picture. */
static bool picture_take(void *of, const void *older)
{
    ViewRow *row = of, name = *row;
    *row = *(const ViewRow *)older;
    memcpy(row->settings, name.settings, sizeof row->settings);
    return true;
}

/* Simulates the state of all pictures. */
static bool simulate(ViewState *views, bool quiet, Error *error)
{
    WorldInfo info;
    Progress progress;
    if (views->world)
        return true;
    if (!view_job_scene(&views->plan, &views->plan.references[0], &views->scene, error) ||
        !(views->world = world_create(&views->scene.world, error)))
        return false;
    bool ok = true;
    progress_begin(&progress, stderr, "simulate", quiet);
    for (world_info(views->world, &info); ok && info.time < views->time && !interrupted();
         world_info(views->world, &info)) {
        ok = world_step(views->world, NULL, error);
        progress_update(&progress, info.time / views->time);
    }
    progress_end(&progress);
    return ok && !interrupted();
}

static bool draw_job(ViewState *views, const ViewJob *job, int factor, bool timed, ViewPicture *out,
                     Error *error)
{
    Scene scene;
    return view_job_scene(&views->plan, job, &scene, error) &&
           view_picture_draw(&scene, views->world, views->width, views->height, factor, timed, out, error);
}

static bool need_reference(ViewState *views, int reference, Error *error)
{
    ViewPicture out = {0};
    if (views->reference_of == reference + 1)
        return true;
    linear_picture_free(&views->reference);
    const bool ok = draw_job(views, &views->plan.references[reference], views->factor, false, &out, error);
    if (ok)
        views->reference = out.picture;
    else
        linear_picture_free(&out.picture);
    views->reference_of = ok ? reference + 1 : 0;
    return ok;
}

/* Draws a picture; a failing picture is reported, and its row has no figures. */
static bool picture_make(ExperimentRun *run, int i, void *of, const ProgressPart *part, Error *error)
{
    ViewPicture out = {0};
    Error why = {{0}};
    ViewState *views = run->state;
    ViewRow *row = of;
    (void)part;
    if (!simulate(views, run->args->quiet, error))
        return false;
    if (need_reference(views, views->plan.jobs[i].reference, &why) &&
        draw_job(views, &views->plan.jobs[i], 1, true, &out, &why)) {
        row->ms = out.ms;
        row->error = picture_rms(&out.picture, &views->reference);
        row->structure = picture_structure(&out.picture, &views->reference);
        memcpy(row->clock, out.clock, sizeof row->clock);
    } else {
        fprintf(stderr, "%s, %s: %s\n", row->view, row->settings, why.message);
    }
    linear_picture_free(&out.picture);
    return true;
}

static bool pictures_run(ExperimentRun *run, Error *error)
{
    ViewState *views = run->state;
    if (!experiment_context(run, error))
        return false;
    views->factor = view_picture_factor(views->width, views->height);
    if (views->factor < 2)
        return error_set(error,
                         "slosh chart: a picture of %d x %d is too large to be supersampled here; use a "
                         "smaller --size",
                         views->width, views->height);
    if (views->factor < VIEW_PICTURE_FACTOR)
        fprintf(
            stderr,
            "references are supersampled %d x %d in place of %d x %d: a picture of %d x %d allows no more\n",
            views->factor, views->factor, VIEW_PICTURE_FACTOR, VIEW_PICTURE_FACTOR, views->width,
            views->height);
    return experiment_trials(run, error);
}

static bool pictures_report(ExperimentRun *run, Error *error)
{
    char title[256], note[256], renderer[256];
    ViewState *views = run->state;
    int drawn = 0;
    snprintf(title, sizeof title, "%.120s at %g s: pictures of %d x %d", run->args->scenes[0], views->time,
             views->width, views->height);
    snprintf(
        note, sizeof note,
        "error: rms of linear light over white, against each view's finest settings, %d x %d supersampled",
        views->factor, views->factor);
    snprintf(renderer, sizeof renderer, "renderer: %.200s", headless_renderer(run->context));
    const ViewWords words = {title, note, renderer};
    run->has_figures = true;
    if (!run->args->quiet)
        view_rows_print(&run->rows, &words, stdout);
    for (int i = 0; i < run->rows.count; i++)
        drawn += isfinite(view_row(&run->rows, i)->ms);
    return (drawn > 0 || error_set(error, "no picture could be drawn: no error is known")) &&
           view_rows_draw(&run->rows, &words, run->output, error);
}

static json_t *pictures_json(const ExperimentRun *run, const char *failure)
{
    const ViewState *views = run->state;
    json_t *runs = json_array();
    for (int i = 0; i < run->rows.count; i++)
        json_array_append_new(runs, view_row_json(&run->rows, i));
    return json_pack("{s:s, s:s, s:[i, i], s:i, s:f, s:o, s:s*}", "views", run->args->scenes[0], "renderer",
                     headless_renderer(run->context), "size", views->width, views->height, "supersampled",
                     views->factor, "time", views->time, "runs", runs, "error", failure);
}

static void pictures_close(ExperimentRun *run)
{
    ViewState *views = run->state;
    linear_picture_free(&views->reference);
    world_destroy(views->world);
}

static const Experiment view_experiment = {
    .table = &view_table,
    .size = sizeof(ViewState),
    .plan = pictures_plan,
    .run = pictures_run,
    .prepare = picture_prepare,
    .take = picture_take,
    .make = picture_make,
    .report = pictures_report,
    .json = pictures_json,
    .close = pictures_close,
};

/* ---- runs ---- */

typedef struct ChartState {
    ChartPlan plan;
    ChartRows rows; /* of the run */
    double floor;   /* spread of the repeats; NaN: unknown */
    char error_of[256];
} ChartState;

static bool chart_plan(ExperimentRun *run, Error *error)
{
    ChartState *chart = run->state;
    if (run->args->width > 0)
        return error_set(error, "slosh chart: --size is of the pictures of --views; leave it out");
    const bool ok = experiment_name_files(run, error) && chart_plan_make(run->args, &chart->plan, error);
    run->context = chart->plan.context;
    if (!ok)
        return false;
    chart->rows = chart_rows_of(&run->rows, &chart->plan.scene);
    run->wanted = chart->plan.count;
    notes_print(&chart->plan.notes, stderr);
    if (*chart->plan.note)
        fprintf(stderr, "%s\n", chart->plan.note);
    return true;
}

static bool chart_prepare_row(ExperimentRun *run, int i, void *row, Error *error)
{
    Scene scene;
    ChartState *chart = run->state;
    return chart_prepare(&chart->plan.subject, &chart->plan.jobs[i], &scene, row, NULL, error);
}

static bool chart_take(void *row, const void *older)
{
    const ChartRow *from = older;
    if (from->outcome.kind == OUTCOME_NONE) /* other failures run again */
        return false;
    memcpy(row, older, sizeof(ChartRow));
    return true;
}

static bool chart_make(ExperimentRun *run, int i, void *row, const ProgressPart *part, Error *error)
{
    ChartState *chart = run->state;
    return (!chart->plan.wants_context || experiment_context(run, error)) &&
           chart_run(&chart->plan.subject, &chart->plan.jobs[i], row, part, error);
}

static double chart_seconds(const ExperimentRun *run, int i)
{
    const ChartState *chart = run->state;
    return chart_plan_seconds(&chart->plan, i, &run->file);
}

/* Checks that the chart has at least one error value. */
static bool check_rows(const ChartPlan *plan, const ChartRows *rows, Error *error)
{
    int known = 0;
    const ChartRow *reference = chart_rows_reference(rows);
    if (reference && !chart_changes(rows, reference))
        return error_set(error, CHART_NO_CHANGE);
    if (!plan->subject.of && !reference)
        return error_set(error, "the finest run, which all are compared with, broke: no error is known; use "
                                "a smaller step or a larger spacing");
    for (int i = 0; i < rows->trials->count; i++)
        known += chart_row(rows, i)->role == CHART_POINT && isfinite(chart_row(rows, i)->error);
    return known > 0 || error_set(error, "every run broke: no error is known; use a smaller step");
}

static bool chart_report(ExperimentRun *run, Error *error)
{
    char title[256], name[256 + sizeof "error: "];
    ChartState *chart = run->state;
    const Case *of = chart->plan.subject.of;
    ChartRows *rows = &chart->rows;
    chart->floor = chart_rows_compare(rows);
    for (int i = 0; i < rows->trials->count; i++) { /* kept rows get today's errors */
        ChartRow *kept = trials_find(&run->file, chart_row(rows, i)->key);
        if (kept)
            kept->error = chart_row(rows, i)->error;
    }
    if (!run->args->quiet)
        chart_print(rows, chart->floor, stdout);
    snprintf(title, sizeof title, "%.120s%s", of ? of->help : run->args->scenes[0],
             of ? "" : ": the finest run is the reference");
    chart_error_name(&chart->plan.subject, &chart->plan.scene, chart->error_of);
    snprintf(name, sizeof name, "error: %s", chart->error_of);
    const ChartWords words = {title, name, chart->plan.note};
    run->has_figures = true;
    return trials_keep(&run->file, run->csv, rows->trials, error) &&
           chart_draw(rows, &words, chart->floor, run->output, error) &&
           check_rows(&chart->plan, rows, error);
}

static json_t *chart_figures(const ExperimentRun *run, const char *failure)
{
    const ChartState *chart = run->state;
    return chart_json(&chart->rows, run->args->scenes[0], chart->error_of, chart->floor, failure);
}

static const Experiment chart_experiment = {
    .table = &chart_table,
    .size = sizeof(ChartState),
    .plan = chart_plan,
    .prepare = chart_prepare_row,
    .take = chart_take,
    .make = chart_make,
    .seconds = chart_seconds,
    .report = chart_report,
    .json = chart_figures,
};

typedef struct ChartOptions {
    bool views; /* pictures instead of runs */
} ChartOptions;

static int run_command(const Args *args)
{
    const ChartOptions *own = args->own;
    return experiment_run(own->views ? &view_experiment : &chart_experiment, args);
}

/* clang-format off */
static const OptionRow options[] = {
    ROW_OUTPUT("OUT", .files = files_chart, .help = "the chart, OUT.svg or OUT.png; its figures in OUT.csv, which a later run goes on with"),
    ROW_TIME(0, "simulated seconds of a scene (2; of --views 0.5); a case has its own"),
    {"--views", NULL, OPTION_FLAG, OWN(ChartOptions, views), .help = "instead: of each view and each of its settings the time of a picture against its error, at --time; --set view.kind=NAME: of that view"},
    {"--sweep", "KEY=A,B,...", OPTION_SWEEP, AT(sweeps), .help = "method=... or backend=...: those, in place of all methods, of the scene's backend and cpu, and of those on a GPU where there is one; particles.spacing=...: those, in place of 2, 1.5 and 1 of the scene's; any other scene key: a series each value; repeat for a product"},
    ROW_SIZE("size of a picture of --views in pixels (256x256)"),
    ROWS_SCENE, ROWS_PROCESSOR, ROW_GPU, ROW_SHADERS, ROW_DEVICE_REFUSED("what is compared moves as the scene says, and no other way"),
    ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_chart = {
    .name = "chart",
    .usage = "SCENE|CASE -o OUT.svg|.png [OPTIONS]",
    .help = "speed against accuracy over methods, steps and resolutions",
    .takes = "scene or case",
    .takes_min = 1,
    .takes_max = 1,
    .output = "OUT.svg or OUT.png",
    .own_size = sizeof(ChartOptions),
    .argument_files = files_scene,
    .options = options,
    .run = run_command,
};
