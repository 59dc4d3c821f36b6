#include "app/base/file.h"
#include "app/base/output.h"
#include "app/base/program.h"
#include "app/bench/gnuplot.h"
#include "app/cli/cli_private.h"
#include "app/lab/error_chart.h"
#include "app/lab/run_table.h"
#include "app/lab/view_benchmark.h"
#include "sim/gpu/program.h"

#include <math.h>
#include <string.h>

static const double DEFAULT_TIME = 0.5; /* s */

enum { DEFAULT_SIDE = 256 };

/* Rows of the plan in order, with unused rows for references; and all rows of the file. */
typedef struct ViewPictures {
    const Args *args;
    ViewPlan plan;
    char csv[1024];
    Headless *context;
    int factor;
    double time;
    int width, height;
    ViewRows kept, rows;
    bool made[VIEW_JOBS_MAX];
    int wanted, there; /* count of pictures without references */
    World *world;      /* at `time`; NULL: not needed yet */
    Scene scene;       /* of the world */
    LinearPicture reference;
    int reference_of; /* job of the reference; -1: none */
    bool told;        /* --json has been written, or cannot be */
} ViewPictures;

static bool name_csv(ViewPictures *gallery, Error *error)
{
    const char *output = gallery->args->output;
    if (!gnuplot_check_name(output, error))
        return false;
    if (strlen(output) >= sizeof gallery->csv)
        return error_set(error, "the name of the chart has more than %zu bytes; name a shorter one",
                         sizeof gallery->csv - 1);
    snprintf(gallery->csv, sizeof gallery->csv, "%s", output);
    memcpy(strrchr(gallery->csv, '.'), ".csv", sizeof ".csv");
    return true;
}

static bool gallery_check(ViewPictures *gallery, Error *error)
{
    const Args *args = gallery->args;
    gallery->time = args->time_given ? args->time : DEFAULT_TIME;
    gallery->width = args->width > 0 ? args->width : DEFAULT_SIDE;
    gallery->height = args->height > 0 ? args->height : DEFAULT_SIDE;
    if (args->sweep_count > 0)
        return error_set(error, "slosh chart: --views has a plan of its own; leave --sweep out, or name one "
                                "view by --set view.kind=...");
    return name_csv(gallery, error) && view_plan_make(args, &gallery->plan, error);
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

/* Makes the rows of the plan; takes figures of kept rows. */
static bool make_view_rows(ViewPictures *gallery, Error *error)
{
    static Scene scene;
    char more[512];
    const Args *args = gallery->args;
    snprintf(more, sizeof more, "%s %.9g %d %d %d %s", SLOSH_VERSION, gallery->time, gallery->width,
             gallery->height, gallery->factor, headless_renderer(gallery->context));
    const uint64_t common = shaders_key(args->shaders, run_key_text(RUN_KEY, more));
    for (int i = 0; i < gallery->plan.count; i++) {
        const ViewJob *job = &gallery->plan.jobs[i];
        ViewRow *row = &gallery->rows.row[gallery->rows.count++];
        *row = (ViewRow){.ms = (double)NAN, .error = (double)NAN, .structure = (double)NAN};
        snprintf(row->view, sizeof row->view, "%s", job->kind->name);
        memcpy(row->settings, job->name, sizeof row->settings);
        row->key = common;
        if (!view_job_scene(&gallery->plan, job, &scene, error) ||
            !run_key_scene(&scene, true, &row->key, error))
            return false;
        const ViewRow *old = job->reference ? NULL : view_rows_find(&gallery->kept, row->key);
        gallery->made[i] = old != NULL;
        gallery->there += old != NULL;
        gallery->wanted += !job->reference;
        if (old) { /* the name is from the plan: two jobs may mean the same picture */
            row->ms = old->ms;
            row->error = old->error;
            row->structure = old->structure;
            memcpy(row->clock, old->clock, sizeof row->clock);
        }
    }
    if (!args->quiet && gallery->there > 0)
        fprintf(stderr, "%d of %d pictures %s in %s already\n", gallery->there, gallery->wanted,
                gallery->there == 1 ? "is" : "are", gallery->csv);
    return true;
}

/* Simulates the state of all pictures. */
static bool simulate(ViewPictures *gallery, Error *error)
{
    WorldInfo info;
    Progress progress;
    if (gallery->world)
        return true;
    if (!view_job_scene(&gallery->plan, &gallery->plan.jobs[0], &gallery->scene, error) ||
        !(gallery->world = world_create(&gallery->scene.world, error)))
        return false;
    bool ok = true;
    progress_begin(&progress, stderr, "simulate", gallery->args->quiet);
    for (world_info(gallery->world, &info); ok && info.time < gallery->time && !interrupted();
         world_info(gallery->world, &info)) {
        ok = world_step(gallery->world, NULL, error);
        progress_update(&progress, info.time / gallery->time);
    }
    progress_end(&progress);
    return ok && !interrupted();
}

/* Draws the reference of a picture: the last reference job before the picture in the plan. */
static bool need_reference(ViewPictures *gallery, int job, Error *error)
{
    static Scene scene;
    ViewPicture out;
    int at = job;
    while (!gallery->plan.jobs[at].reference)
        at--;
    if (gallery->reference_of == at)
        return true;
    linear_picture_free(&gallery->reference);
    gallery->reference_of = -1;
    const bool ok = view_job_scene(&gallery->plan, &gallery->plan.jobs[at], &scene, error) &&
                    view_picture_draw(&scene, gallery->world, gallery->width, gallery->height,
                                      gallery->factor, false, &out, error);
    if (ok)
        gallery->reference = out.picture;
    gallery->reference_of = ok ? at : -1;
    return ok;
}

/* Draws a picture; a failing picture is reported, and its row has no figures. */
static bool draw_one(ViewPictures *gallery, int job, Error *error)
{
    static Scene scene;
    ViewPicture out = {0};
    Error why = {{0}};
    ViewRow *row = &gallery->rows.row[job];
    if (!simulate(gallery, error))
        return false;
    if (!need_reference(gallery, job, &why) ||
        !view_job_scene(&gallery->plan, &gallery->plan.jobs[job], &scene, &why) ||
        !view_picture_draw(&scene, gallery->world, gallery->width, gallery->height, 1, true, &out, &why)) {
        fprintf(stderr, "%s, %s: %s\n", row->view, row->settings, why.message);
        linear_picture_free(&out.picture);
        return true;
    }
    row->ms = out.ms;
    row->error = picture_rms(&out.picture, &gallery->reference);
    row->structure = picture_structure(&out.picture, &gallery->reference);
    memcpy(row->clock, out.clock, sizeof row->clock);
    linear_picture_free(&out.picture);
    gallery->there++;
    view_rows_add(&gallery->kept, row);
    return view_rows_write(&gallery->kept, gallery->csv, error);
}

static bool draw_all(ViewPictures *gallery, Error *error)
{
    Progress progress;
    bool ok = true;
    progress_begin(&progress, stderr, "views", gallery->args->quiet);
    for (int i = 0; ok && i < gallery->plan.count && !interrupted(); i++) {
        ok = gallery->plan.jobs[i].reference || gallery->made[i] || draw_one(gallery, i, error);
        progress_update(&progress, (i + 1.0) / gallery->plan.count);
    }
    progress_end(&progress);
    return ok && !interrupted();
}

/* Removes reference rows, which are not for people. */
static void drop_references(ViewPictures *gallery)
{
    ViewRows *rows = &gallery->rows;
    int kept = 0;
    for (int i = 0; i < rows->count; i++)
        if (!gallery->plan.jobs[i].reference)
            rows->row[kept++] = rows->row[i];
    rows->count = kept;
}

static bool finish_views(ViewPictures *gallery, Error *error)
{
    char title[256], note[256], renderer[256];
    const Args *args = gallery->args;
    drop_references(gallery);
    snprintf(title, sizeof title, "%.120s at %g s: pictures of %d x %d", args->scenes[0], gallery->time,
             gallery->width, gallery->height);
    snprintf(
        note, sizeof note,
        "error: rms of linear light over white, against each view's finest settings, %d x %d supersampled",
        gallery->factor, gallery->factor);
    snprintf(renderer, sizeof renderer, "renderer: %.200s", headless_renderer(gallery->context));
    const ViewWords words = {title, note, renderer};
    const ViewFacts facts = {args->scenes[0], headless_renderer(gallery->context),
                             gallery->width,  gallery->height,
                             gallery->factor, gallery->time};
    if (!args->quiet)
        view_rows_print(&gallery->rows, &words, stdout);
    bool ok = gallery->there > 0 || error_set(error, "no picture could be drawn: no error is known");
    ok = ok && view_rows_draw(&gallery->rows, &words, args->output, error);
    Error no_json;
    gallery->told = true;
    if (args->json &&
        !view_rows_write_json(&gallery->rows, &facts, ok ? NULL : error->message, args->json, &no_json)) {
        *error = ok ? no_json : *error;
        return false;
    }
    return ok;
}

static bool gallery_open(ViewPictures *gallery, Error *error)
{
    const Args *args = gallery->args;
    if (!output_check(args->output, error) || !output_check(gallery->csv, error) ||
        (args->json && !json_file_check(args->json, error)) || !gnuplot_check(args->output, error) ||
        !view_rows_read(&gallery->kept, gallery->csv, stderr, error) ||
        !(gallery->context = headless_create(args->gpu, error)))
        return false;
    fprintf(stderr, "renderer: %s\n", headless_renderer(gallery->context));
    gallery->factor = view_picture_factor(gallery->width, gallery->height);
    if (gallery->factor < 2)
        return error_set(error,
                         "slosh chart: a picture of %d x %d is too large to be supersampled here; use a "
                         "smaller --size",
                         gallery->width, gallery->height);
    if (gallery->factor < VIEW_PICTURE_FACTOR)
        fprintf(
            stderr,
            "references are supersampled %d x %d in place of %d x %d: a picture of %d x %d allows no more\n",
            gallery->factor, gallery->factor, VIEW_PICTURE_FACTOR, VIEW_PICTURE_FACTOR, gallery->width,
            gallery->height);
    return true;
}

/* Writes JSON for a failure or a stop before all figures existed. */
static void write_views_failure(const ViewPictures *gallery, const Error *error)
{
    const Args *args = gallery->args;
    Error no_json;
    if (args->json && !gallery->told && json_file_check(args->json, &no_json))
        failure_json_write(failure_json("chart", "scene", args->scenes[0], args->output, error), args->json);
}

/* Makes the chart of a scene's pictures; returns the exit code. */
static int chart_views(const Args *args)
{
    static ViewPictures gallery;
    Error error = {{0}};
    gallery = (ViewPictures){.args = args, .reference_of = -1};
    if (!gallery_check(&gallery, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    const bool ok = gallery_open(&gallery, &error) && make_view_rows(&gallery, &error) &&
                    draw_all(&gallery, &error) && finish_views(&gallery, &error);
    linear_picture_free(&gallery.reference);
    world_destroy(gallery.world);
    if (interrupted())
        error_set(&error, "stopped after %d of %d pictures; the same command goes on", gallery.there,
                  gallery.wanted);
    if (interrupted() || !ok) {
        fprintf(stderr, "%s\n", error.message);
        write_views_failure(&gallery, &error);
    }
    headless_destroy(gallery.context);
    return interrupted() ? EXIT_INTERRUPTED : ok ? 0 : EXIT_FAILED;
}

/* Rows of the plan, in order, and all rows of the file, where runs of different settings stay. */
typedef struct Runs {
    ChartRows kept, rows;
    bool made[CHART_JOBS_MAX]; /* made by an older run */
    bool written;              /* --json is written */
    int there;                 /* count of the plan's rows with figures */
} Runs;

/* Makes the rows of the plan; takes figures of kept rows. */
static bool make_rows(const ChartPlan *plan, Runs *runs, Error *error)
{
    static Scene scene;
    ChartRows *rows = &runs->rows;
    rows->metric_count = plan->scene.metric_count;
    memcpy(rows->metrics, plan->scene.metrics, sizeof rows->metrics);
    rows->probe_count = plan->scene.probes.count;
    for (rows->count = 0; rows->count < plan->count; rows->count++) {
        const int i = rows->count;
        if (!chart_prepare(&plan->subject, &plan->jobs[i], &scene, &rows->row[i], NULL, error))
            return false;
        const ChartRow *old = chart_rows_find(&runs->kept, rows->row[i].key);
        runs->made[i] = old && old->outcome.kind != OUTCOME_NONE; /* other failures run again */
        runs->there += runs->made[i];
        if (runs->made[i])
            rows->row[i] = *old;
    }
    if (!plan->args->quiet && runs->there > 0)
        fprintf(stderr, "%d of %d runs %s in %s already\n", runs->there, plan->count,
                runs->there == 1 ? "is" : "are", plan->csv);
    return true;
}

/* Shares of the work to do: done before a job, and the job itself. */
static void shares(const ChartPlan *plan, const Runs *runs, int job, double *done, double *part)
{
    double all = 0;
    *done = *part = 0;
    for (int i = 0; i < plan->count; i++) {
        const double seconds = runs->made[i] ? 0 : chart_plan_seconds(plan, i, &runs->kept);
        all += seconds;
        *done += i < job ? seconds : 0;
        *part += i == job ? seconds : 0;
    }
    *done /= all;
    *part /= all;
}

static bool run_one(const ChartPlan *plan, Runs *runs, int job, Progress *progress, Error *error)
{
    double done, part;
    ChartRow *row = &runs->rows.row[job];
    shares(plan, runs, job, &done, &part);
    if (!chart_run(&plan->subject, &plan->jobs[job], row, progress, done, part, error))
        return false;
    runs->there++;
    chart_rows_add(&runs->kept, row, &runs->rows);
    chart_rows_merge(&runs->kept, plan->csv, &runs->rows);
    return chart_rows_write(&runs->kept, plan->csv, error);
}

/* Runs the missing jobs; writes the file after each job. */
static bool run_all(const ChartPlan *plan, Runs *runs, Error *error)
{
    Progress progress;
    bool ok = true;
    progress_begin(&progress, stderr, "chart", plan->args->quiet);
    for (int i = 0; ok && i < plan->count && !interrupted(); i++)
        ok = runs->made[i] || run_one(plan, runs, i, &progress, error);
    progress_end(&progress);
    return ok && !interrupted();
}

/* Updates the errors of kept rows; older runs of different settings stay in the file. */
static void keep_errors(ChartRows *kept, const ChartRows *rows)
{
    for (int i = 0; i < kept->count; i++) {
        const ChartRow *row = chart_rows_find(rows, kept->row[i].key);
        if (row)
            kept->row[i].error = row->error;
    }
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
    for (int i = 0; i < rows->count; i++)
        known += rows->row[i].role == CHART_POINT && isfinite(rows->row[i].error);
    return known > 0 || error_set(error, "every run broke: no error is known; use a smaller step");
}

static bool finish(const ChartPlan *plan, Runs *runs, Error *error)
{
    char title[256], name[256 + sizeof "error: "];
    const Args *args = plan->args;
    const Case *of = plan->subject.of;
    ChartRows *rows = &runs->rows;
    const double floor = chart_rows_compare(rows);
    keep_errors(&runs->kept, rows);
    if (!args->quiet)
        chart_print(rows, floor, stdout);
    snprintf(title, sizeof title, "%.120s%s", of ? of->help : args->scenes[0],
             of ? "" : ": the finest run is the reference");
    chart_error_name(&plan->subject, &plan->scene, name + snprintf(name, sizeof name, "error: "));
    const ChartWords words = {title, name, plan->note};
    chart_rows_merge(&runs->kept, plan->csv, rows);
    const bool drawn = chart_rows_write(&runs->kept, plan->csv, error) &&
                       chart_draw(rows, &words, floor, args->output, error) && check_rows(plan, rows, error);
    if (!args->json)
        return drawn;
    Error no_json;
    runs->written = true;
    if (chart_write_json(rows, args->scenes[0], name + strlen("error: "), floor,
                         drawn ? NULL : error->message, args->json, &no_json))
        return drawn;
    *error = drawn ? no_json : *error;
    return false;
}

/* Writes JSON for a failure before all figures existed. */
static void write_failure(const ChartPlan *plan, const Runs *runs, const Error *error)
{
    const Args *args = plan->args;
    Error no_json;
    if (args->json && !runs->written && json_file_check(args->json, &no_json))
        failure_json_write(failure_json("chart", "scene", args->scenes[0], args->output, error), args->json);
}

static bool check_outputs(const ChartPlan *plan, ChartRows *kept, Error *error)
{
    const Args *args = plan->args;
    return gnuplot_check(args->output, error) && output_check(args->output, error) &&
           output_check(plan->csv, error) && (!args->json || json_file_check(args->json, error)) &&
           chart_rows_read(kept, plan->csv, stderr, error);
}

/* Makes a context if a missing run is on a GPU. */
static bool make_context(ChartPlan *plan, const Runs *runs, Error *error)
{
    if (!plan->wants_context || runs->there == plan->count)
        return true;
    if (!plan->context && !(plan->context = headless_create(plan->args->gpu, error)))
        return false;
    fprintf(stderr, "renderer: %s\n", headless_renderer(plan->context));
    return true;
}

static int chart(ChartPlan *plan, Error *error)
{
    static Runs runs;
    notes_print(&plan->notes, stderr);
    if (*plan->note)
        fprintf(stderr, "%s\n", plan->note);
    const bool ok = check_outputs(plan, &runs.kept, error) && make_rows(plan, &runs, error) &&
                    make_context(plan, &runs, error) && run_all(plan, &runs, error) &&
                    finish(plan, &runs, error);
    if (interrupted()) {
        fprintf(stderr, "stopped after %d of %d runs; the same command goes on\n", runs.there, plan->count);
        return EXIT_INTERRUPTED;
    }
    if (ok)
        return 0;
    fprintf(stderr, "%s\n", error->message);
    write_failure(plan, &runs, error);
    return EXIT_FAILED;
}

int cmd_chart(const Args *args)
{
    static ChartPlan plan;
    Error error = {{0}};
    int code = EXIT_USAGE;
    interrupt_install();
    if (args->views)
        return chart_views(args);
    if (args->width > 0) {
        fprintf(stderr, "slosh chart: --size is of the pictures of --views; leave it out\n");
        return EXIT_USAGE;
    }
    if (chart_plan_make(args, &plan, &error))
        code = chart(&plan, &error);
    else
        fprintf(stderr, "%s\n", error.message);
    chart_plan_end(&plan);
    return code;
}
