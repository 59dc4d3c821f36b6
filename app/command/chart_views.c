#include "app/command/chart_views.h"

#include "app/base/file.h"
#include "app/base/output.h"
#include "app/base/program.h"
#include "app/gallery/shot.h"
#include "app/gallery/view_plan.h"
#include "app/lab/chart.h"
#include "app/lab/run_key.h"
#include "sim/gl/shader_source.h"

#include <math.h>
#include <string.h>

static const double DEFAULT_TIME = 0.5; /* s */

enum { DEFAULT_SIDE = 256 };

/* Rows of the plan in order, with unused rows for references; and all rows of the file. */
typedef struct Gallery {
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
} Gallery;

static bool name_csv(Gallery *gallery, Error *error)
{
    const char *output = gallery->args->output;
    if (!chart_name(output, error))
        return false;
    if (strlen(output) >= sizeof gallery->csv)
        return error_set(error, "the name of the chart has more than %zu bytes; name a shorter one",
                         sizeof gallery->csv - 1);
    snprintf(gallery->csv, sizeof gallery->csv, "%s", output);
    memcpy(strrchr(gallery->csv, '.'), ".csv", sizeof ".csv");
    return true;
}

static bool gallery_check(Gallery *gallery, Error *error)
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
static bool make_rows(Gallery *gallery, Error *error)
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
static bool simulate(Gallery *gallery, Error *error)
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
static bool need_reference(Gallery *gallery, int job, Error *error)
{
    static Scene scene;
    Shot shot;
    int at = job;
    while (!gallery->plan.jobs[at].reference)
        at--;
    if (gallery->reference_of == at)
        return true;
    linear_picture_free(&gallery->reference);
    gallery->reference_of = -1;
    const bool ok =
        view_job_scene(&gallery->plan, &gallery->plan.jobs[at], &scene, error) &&
        shoot(&scene, gallery->world, gallery->width, gallery->height, gallery->factor, false, &shot, error);
    if (ok)
        gallery->reference = shot.picture;
    gallery->reference_of = ok ? at : -1;
    return ok;
}

/* Draws a picture; a failing picture is reported, and its row has no figures. */
static bool draw_one(Gallery *gallery, int job, Error *error)
{
    static Scene scene;
    Shot shot = {0};
    Error why = {{0}};
    ViewRow *row = &gallery->rows.row[job];
    if (!simulate(gallery, error))
        return false;
    if (!need_reference(gallery, job, &why) ||
        !view_job_scene(&gallery->plan, &gallery->plan.jobs[job], &scene, &why) ||
        !shoot(&scene, gallery->world, gallery->width, gallery->height, 1, true, &shot, &why)) {
        fprintf(stderr, "%s, %s: %s\n", row->view, row->settings, why.message);
        linear_picture_free(&shot.picture);
        return true;
    }
    row->ms = shot.ms;
    row->error = picture_rms(&shot.picture, &gallery->reference);
    row->structure = picture_structure(&shot.picture, &gallery->reference);
    memcpy(row->clock, shot.clock, sizeof row->clock);
    linear_picture_free(&shot.picture);
    gallery->there++;
    view_rows_add(&gallery->kept, row);
    return view_rows_write(&gallery->kept, gallery->csv, error);
}

static bool draw_all(Gallery *gallery, Error *error)
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
static void drop_references(Gallery *gallery)
{
    ViewRows *rows = &gallery->rows;
    int kept = 0;
    for (int i = 0; i < rows->count; i++)
        if (!gallery->plan.jobs[i].reference)
            rows->row[kept++] = rows->row[i];
    rows->count = kept;
}

static bool finish(Gallery *gallery, Error *error)
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

static bool gallery_open(Gallery *gallery, Error *error)
{
    const Args *args = gallery->args;
    if (!output_check(args->output, error) || !output_check(gallery->csv, error) ||
        (args->json && !json_file_check(args->json, error)) || !chart_check(args->output, error) ||
        !view_rows_read(&gallery->kept, gallery->csv, stderr, error) ||
        !(gallery->context = headless_create(args->gpu, error)))
        return false;
    fprintf(stderr, "renderer: %s\n", headless_renderer(gallery->context));
    gallery->factor = shot_factor(gallery->width, gallery->height);
    if (gallery->factor < 2)
        return error_set(error,
                         "slosh chart: a picture of %d x %d is too large to be supersampled here; use a "
                         "smaller --size",
                         gallery->width, gallery->height);
    if (gallery->factor < SHOT_FACTOR)
        fprintf(
            stderr,
            "references are supersampled %d x %d in place of %d x %d: a picture of %d x %d allows no more\n",
            gallery->factor, gallery->factor, SHOT_FACTOR, SHOT_FACTOR, gallery->width, gallery->height);
    return true;
}

/* Writes JSON for a failure or a stop before all figures existed. */
static void write_failure(const Gallery *gallery, const Error *error)
{
    const Args *args = gallery->args;
    Error no_json;
    if (args->json && !gallery->told && json_file_check(args->json, &no_json))
        failure_json_write(failure_json("chart", "scene", args->scenes[0], args->output, error), args->json);
}

int chart_views(const Args *args)
{
    static Gallery gallery;
    Error error = {{0}};
    gallery = (Gallery){.args = args, .reference_of = -1};
    if (!gallery_check(&gallery, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    const bool ok = gallery_open(&gallery, &error) && make_rows(&gallery, &error) &&
                    draw_all(&gallery, &error) && finish(&gallery, &error);
    linear_picture_free(&gallery.reference);
    world_destroy(gallery.world);
    if (interrupted())
        error_set(&error, "stopped after %d of %d pictures; the same command goes on", gallery.there,
                  gallery.wanted);
    if (interrupted() || !ok) {
        fprintf(stderr, "%s\n", error.message);
        write_failure(&gallery, &error);
    }
    headless_destroy(gallery.context);
    return interrupted() ? EXIT_INTERRUPTED : ok ? 0 : EXIT_FAILED;
}
