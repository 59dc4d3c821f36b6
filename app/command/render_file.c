#include "app/command/render_file.h"

#include "app/base/exit_code.h"
#include "app/base/interrupt.h"
#include "app/base/json_file.h"
#include "app/base/progress.h"
#include "app/output/pictures.h"
#include "app/playback/reel.h"
#include "app/session/headless.h"
#include "app/session/studio.h"
#include "render/panels.h"
#include "sim/base/stage.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const size_t KEPT_BYTES = 256U << 20; /* of steps in memory */

typedef struct FileRender {
    const Args *args;
    Scene scene;
    Headless *context;
    Panels *panels; /* one for each of the scene's views */
    Reel *reel;
    Pictures *pictures;
    Image image;                    /* the last picture, of step `drawn` */
    size_t drawn, particles, steps; /* `steps` of the file */
    double first, interval;         /* times of the pictures, s: first, first + interval, ... */
    size_t wanted, taken;           /* pictures */
    double time;                    /* of the step of the last picture, s */
    double began_ms, first_ms;      /* wall time of the start, of the first picture */
} FileRender;

/* ---- the command line ---- */

static bool refuse(const Args *args, const char *option, const char *why, Error *error)
{
    return error_set(error, "%s makes no sense for %s: %s", option, args->scenes[0], why);
}

static bool check_options(const Args *args, Error *error)
{
    if (args->interpolate)
        return refuse(args, "--interpolate", "a file has no states between its steps", error);
    if (args->device)
        return refuse(args, "--device", "the box moves as it did", error);
    if (args->sweep_count > 0)
        return refuse(args, "--compare", "nothing is simulated; compare scenes", error);
    return true;
}

static bool check_output(const Args *args, PicturesKind *kind, Error *error)
{
    if (!pictures_kind(args->output, kind, error))
        return false;
    return *kind != PICTURES_PNG || args->frames == 0 ||
           error_set(error, "--frames makes no sense for one picture, %s", args->output);
}

/* One picture: at --time, or of the last step. More: from the first step to --time, or to the last. */
static bool choose_times(FileRender *render, const Recorded *recorded, PicturesKind kind, Error *error)
{
    const Args *args = render->args;
    const double until = args->time_given ? args->time : recorded->last;
    render->first = kind == PICTURES_PNG ? until : recorded->first;
    render->interval = kind == PICTURES_PNG ? 0 : 1 / args->fps;
    if (kind == PICTURES_PNG)
        render->wanted = 1;
    else if (args->frames > 0)
        render->wanted = (size_t)args->frames;
    else
        render->wanted = (size_t)fmin(fmax(ceil((until - recorded->first) * args->fps - 1e-6), 1), 1e7);
    const double end = recorded->last + 1e-9 * fmax(fabs(recorded->last), 1),
                 last = render->first + render->interval * (double)(render->wanted - 1);
    if (args->time_given && args->time > end)
        return error_set(error, "%s: ends at %.9g s, before --time %.9g", recorded->path, recorded->last,
                         args->time);
    return args->frames == 0 || last <= end ||
           error_set(error, "%s: ends at %.9g s; the last of --frames %d would be at %.9g s", recorded->path,
                     recorded->last, (int)args->frames, last);
}

static bool check_views(const Recorded *recorded, const Scene *scene, Error *error)
{
    bool ok = true;
    for (int i = 0; ok && i < scene_view_count(scene); i++)
        ok = recorded_has(recorded, scene_view(scene, i), error);
    return ok;
}

static bool understand(FileRender *render, Recorded *recorded, PicturesKind *kind, Error *error)
{
    const Args *args = render->args;
    Notes notes = {.count = 0};
    if (!check_options(args, error) || !check_output(args, kind, error) ||
        !recorded_open(args->scenes[0], &args->settings, recorded, &notes, error))
        return false;
    render->scene = recorded->scene;
    render->steps = recorded->steps;
    if (!check_views(recorded, &render->scene, error) || !choose_times(render, recorded, *kind, error)) {
        recorded_close(recorded);
        return false;
    }
    notes_print(&notes, stderr);
    if (args->time_given && args->frames > 0)
        fprintf(stderr, "--time %.9g has no effect: --frames says how long it lasts\n", args->time);
    return true;
}

/* ---- pictures ---- */

static bool open_all(FileRender *render, Recorded *recorded, Error *error)
{
    const Args *args = render->args;
    const Scene *scene = &render->scene;
    const int count = scene_view_count(scene);
    Subject subjects[PANELS_MAX];
    ReelSetup setup = {.recorded = recorded, .bytes = KEPT_BYTES};
    for (int i = 0; i < count; i++) {
        subjects[i] = (Subject){scene_view(scene, i), &scene->world};
        setup.attributes |= renderer_attributes(subjects[i].def);
    }
    render->drawn = SIZE_MAX;
    if (!(render->context = headless_create(args->gpu, error)))
        return false;
    fprintf(stderr, "renderer: %s\n", headless_renderer(render->context));
    return (render->reel = reel_create(&setup, error)) &&
           (render->panels = panels_create(subjects, count, args->width, args->height, error)) &&
           (image_create(&render->image, args->width, args->height) ||
            error_set(error, "out of memory for a picture of %d x %d", args->width, args->height)) &&
           (render->pictures = pictures_create(args->output, args->width, args->height, args->fps, error));
}

static void close_all(FileRender *render)
{
    image_destroy(&render->image);
    panels_destroy(render->panels);
    reel_destroy(render->reel);
    headless_destroy(render->context);
}

/* A step that serves two pictures is drawn once. */
static bool draw(FileRender *render, double time, Error *error)
{
    ReelStatus status;
    ParticleBuffers particles;
    reel_seek(render->reel, time, render->interval);
    if (!reel_wait(render->reel, &status, error))
        return false;
    if (status.index == render->drawn)
        return true;
    if (!reel_take(render->reel, &particles))
        return error_set(error, "%s: Step#%zu is not shown", render->args->scenes[0], status.index);
    const ParticleBuffers *const states[PANELS_MAX] = {&particles, &particles, &particles, &particles};
    panels_draw(render->panels, states, NULL);
    if (!panels_read(render->panels, render->image.rgb, error))
        return false;
    render->drawn = status.index;
    render->particles = particles.count;
    render->time = status.time;
    return true;
}

/* After a signal only a file that has no picture yet gets one. */
static bool take_pictures(FileRender *render, Error *error)
{
    Progress progress;
    bool ok = true;
    progress_begin(&progress, stderr, "render", render->args->quiet);
    while (ok && render->taken < render->wanted && !(interrupted() && render->taken > 0)) {
        ok = draw(render, render->first + render->interval * (double)render->taken, error) &&
             pictures_add(render->pictures, &render->image, error);
        if (ok && render->taken++ == 0)
            render->first_ms = wall_ms();
        progress_update(&progress, (double)render->taken / (double)render->wanted);
    }
    progress_end(&progress);
    return ok;
}

/* ---- what is said ---- */

static json_t *summary(const FileRender *render)
{
    const Args *args = render->args;
    return json_pack("{s:s, s:s, s:s, s:I, s:I, s:I, s:f, s:f, s:f, s:b, s:s}", "command", "render", "input",
                     args->scenes[0], "output", args->output, "pictures", (json_int_t)render->taken,
                     "particles", (json_int_t)render->particles, "snapshots", (json_int_t)render->steps,
                     "simulated_seconds", render->time, "wall_seconds", 1e-3 * (wall_ms() - render->began_ms),
                     "first_picture_seconds", 1e-3 * (render->first_ms - render->began_ms), "stopped",
                     render->taken < render->wanted, "renderer", headless_renderer(render->context));
}

static int fail(const FileRender *render, const Error *error)
{
    const Args *args = render->args;
    fprintf(stderr, "%s\n", error->message);
    failure_json_write(failure_json("render", "input", args->scenes[0], args->output, error), args->json);
    return EXIT_FAILED;
}

static void report(const FileRender *render)
{
    const Args *args = render->args;
    char older[1088];
    reel_print_flaws(render->reel, stderr);
    if (render->taken < render->wanted)
        fprintf(stderr, "stopped at t = %.4g s; %s is whole\n", render->time, args->output);
    if (pictures_has_older(render->pictures, older))
        fprintf(stderr, "%s and what follows is of an earlier run; remove it unless you want both\n", older);
    if (!args->quiet)
        fprintf(stderr, "%s: %zu picture%s up to t = %.4g s, %zu particle%s, from %s\n", args->output,
                render->taken, plural(render->taken), render->time, render->particles,
                plural(render->particles), args->scenes[0]);
}

static int finish(FileRender *render, Error *error)
{
    report(render);
    if (!pictures_finish(render->pictures, error))
        return fail(render, error);
    if (!render->args->json)
        return render->taken < render->wanted ? EXIT_INTERRUPTED : 0;
    json_t *json = summary(render);
    const bool written = json_file_write(json, render->args->json, error);
    json_decref(json);
    if (written)
        return render->taken < render->wanted ? EXIT_INTERRUPTED : 0;
    fprintf(stderr, "%s\n", error->message);
    return EXIT_FAILED;
}

static int show(FileRender *render, Recorded *recorded, Error *error)
{
    int code = EXIT_FAILED;
    if (open_all(render, recorded, error) && take_pictures(render, error)) {
        code = finish(render, error);
    } else {
        if (render->reel)
            reel_print_flaws(render->reel, stderr);
        fail(render, error);
        pictures_discard(render->pictures);
    }
    close_all(render);
    recorded_close(recorded); /* where the reel has not taken it over */
    return code;
}

int render_file(const Args *args)
{
    FileRender render = {.args = args, .began_ms = wall_ms()};
    Recorded recorded;
    Error error = {{0}};
    PicturesKind kind;
    interrupt_install();
    if (!understand(&render, &recorded, &kind, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    if (args->json && !json_file_check(args->json, &error)) {
        fprintf(stderr, "%s\n", error.message);
        recorded_close(&recorded);
        return EXIT_FAILED;
    }
    return show(&render, &recorded, &error);
}
