#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/args/args.h"
#include "app/cli/cli_private.h"
#include "app/files/pictures.h"
#include "app/run/compare/compare.h"
#include "app/run/offscreen.h"
#include "app/run/playback/playback.h"
#include "app/run/session.h"
#include "render/frame/view.h"
#include "render/renderer.h"
#include "sim/world.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const size_t KEPT_BYTES = 256U << 20; /* for steps in memory */

/* A shown run: the file itself, or a run beside the file (`file` of a view). */
typedef struct ShownRun {
    char name[COMPARE_NAME_SIZE]; /* without the folder */
    double time;                  /* time of the states, s; below 0: the picture's */
    Recorded recorded;            /* with its reader until there is a reel */
    unsigned attributes;
    Prefetch *prefetch;
    PrefetchStatus at;
    ParticleBuffers state;
    size_t drawn; /* step in the last picture */
    PrefetchWatch watch;
} ShownRun;

typedef struct FileRender {
    const Args *args;
    Scene scene;
    Headless *context;
    Panels *panels; /* per view of the scene */
    MissingAttributes missing;
    int run_count;
    ShownRun runs[PANELS_MAX + 1]; /* the file first */
    int run_of[PANELS_MAX];        /* index of each panel's run */
    Pictures *pictures;
    Image image;               /* the last picture */
    size_t particles, steps;   /* of the file */
    double first, interval;    /* picture times, s: first, first + interval, ... */
    size_t wanted, taken;      /* pictures */
    double time;               /* of the step in the last picture, s */
    double began_ms, first_ms; /* wall time of the start and of the first picture */
} FileRender;

/* ---- the command line ---- */

static bool refuse(const Args *args, const char *option, const char *why, Error *error)
{
    return error_set(error, "%s makes no sense for %s: %s", option, args->scenes[0], why);
}

static bool check_options(const Args *args, Error *error)
{
    if (options_of_render(args)->interpolate)
        return refuse(args, "--interpolate", "a file has no states between its steps", error);
    if (args->device)
        return refuse(args, "--device", "the box moves as it did", error);
    if (args->sweep_count > 1 || (args->sweep_count == 1 && strcmp(args->sweeps[0].key, "view.time") != 0))
        return refuse(args, "--compare", "nothing is simulated; compare scenes, or times: --compare time=A,B",
                      error);
    return true;
}

static bool check_output(const Args *args, PicturesKind *kind, Error *error)
{
    if (!pictures_kind(args->output, kind, error))
        return false;
    return *kind != PICTURES_PNG || options_of_render(args)->frames == 0 ||
           error_set(error, "--frames makes no sense for one picture, %s", args->output);
}

/* A single picture: at --time, or of the last step. Several: from the first step to --time, or to the last
   step. */
static bool choose_times(FileRender *render, const Recorded *recorded, PicturesKind kind, Error *error)
{
    const Args *args = render->args;
    const RenderOptions *own = options_of_render(args);
    const double until = args_given(args, "--time") ? args->time : recorded->last;
    render->first = kind == PICTURES_PNG ? until : recorded->first;
    render->interval = kind == PICTURES_PNG ? 0 : 1 / own->fps;
    if (kind == PICTURES_PNG)
        render->wanted = 1;
    else if (own->frames > 0)
        render->wanted = (size_t)own->frames;
    else
        render->wanted = (size_t)fmin(fmax(ceil((until - recorded->first) * own->fps - 1e-6), 1), 1e7);
    const double end = recorded->last + 1e-9 * fmax(fabs(recorded->last), 1),
                 last = render->first + render->interval * (double)(render->wanted - 1);
    if (args_given(args, "--time") && args->time > end)
        return error_set(error, "%s: ends at %.9g s, before --time %.9g", recorded->path, recorded->last,
                         args->time);
    return own->frames == 0 || last <= end ||
           error_set(error, "%s: ends at %.9g s; the last of --frames %d would be at %.9g s", recorded->path,
                     recorded->last, (int)own->frames, last);
}

/* Finds the view's run: the run of an earlier panel, or a new one. */
static bool find_run(FileRender *render, int panel, Notes *notes, Error *error)
{
    const ViewDef *view = scene_view(&render->scene, panel);
    render->run_of[panel] = 0;
    if (!compare_is_other(view))
        return recorded_has(&render->runs[0].recorded, view, error);
    for (int i = 0; i < panel; i++)
        if (compare_is_same(scene_view(&render->scene, i), view)) {
            render->run_of[panel] = render->run_of[i];
            return recorded_has(&render->runs[render->run_of[i]].recorded, view, error);
        }
    ShownRun *run = &render->runs[render->run_count];
    compare_name(view, run->name);
    run->time = view->time;
    if (!compare_open_file(render->args->scenes[0], view, panel, &run->recorded, notes, error))
        return false;
    render->run_of[panel] = render->run_count++;
    return true;
}

/* The views at each time of --compare, a time a column. */
static bool spread_times(FileRender *render, Error *error)
{
    const Args *args = render->args;
    Scene *scene = &render->scene;
    const int views = scene_view_count(scene), times = args->sweep_count ? args->sweeps[0].count : 1;
    ViewDef of[PANELS_MAX];
    if (args->sweep_count == 0)
        return true;
    if (times * views > PANELS_MAX)
        return error_set(error,
                         "slosh render: %d times with %d views each are %d panels; at most %d have room",
                         times, views, times * views, PANELS_MAX);
    for (int i = 0; i < times * views; i++) {
        const char *value = args->sweeps[0].values[i % times];
        char *end;
        const double time = strtod(value, &end);
        of[i] = *scene_view(scene, i / times);
        of[i].time = of[i].time >= 0 ? of[i].time : time;
        if (*end || !(time >= 0 && time <= 1e6))
            return error_set(error, "--compare time: %s is no time in seconds", value);
    }
    memcpy(scene->views, of, (size_t)(times * views) * sizeof *of);
    scene->view_count = times * views;
    return true;
}

static bool find_runs(FileRender *render, Notes *notes, Error *error)
{
    bool ok = true;
    for (int i = 0; ok && i < scene_view_count(&render->scene); i++)
        ok = find_run(render, i, notes, error);
    return ok;
}

static bool understand(FileRender *render, PicturesKind *kind, Error *error)
{
    const Args *args = render->args;
    const char *slash = strrchr(args->scenes[0], '/');
    ShownRun *own = &render->runs[0];
    Recorded *recorded = &own->recorded;
    Notes notes = {.count = 0};
    if (!check_options(args, error) || !check_output(args, kind, error) ||
        !recorded_open(args->scenes[0], &args->settings, recorded, &notes, error))
        return false;
    snprintf(own->name, sizeof own->name, "%.150s", slash ? slash + 1 : args->scenes[0]);
    render->run_count = 1;
    render->scene = recorded->scene;
    render->steps = recorded->steps;
    own->time = -1;
    if (!spread_times(render, error) || !find_runs(render, &notes, error) ||
        !choose_times(render, recorded, *kind, error))
        return false;
    notes_print(&notes, stderr);
    bool shown = *kind != PICTURES_PNG;
    for (int i = 0; i < scene_view_count(&render->scene); i++)
        shown |= render->run_of[i] == 0;
    if (!shown && args_given(args, "--time"))
        fprintf(stderr, "--time %.9g has no effect: each view shows another run or time\n", args->time);
    if (args_given(args, "--time") && options_of_render(args)->frames > 0)
        fprintf(stderr, "--time %.9g has no effect: --frames says how long it lasts\n", args->time);
    return true;
}

/* ---- pictures ---- */

/* Opens the reels. Runs beside the file show their first step at or after the file's time. The scenes'
   data stays here. */
static bool open_prefetches(FileRender *render, Error *error)
{
    for (int i = 0; i < render->run_count; i++) {
        ShownRun *run = &render->runs[i];
        Recorded taken = run->recorded;
        const PrefetchSetup setup = {
            .recorded = &taken, .attributes = run->attributes, .bytes = KEPT_BYTES, .at_or_after = i > 0};
        run->drawn = SIZE_MAX;
        run->prefetch = prefetch_create(&setup, error);
        if (!run->prefetch)
            return false;
        run->recorded.reader = NULL;
    }
    return true;
}

static bool open_all(FileRender *render, Error *error)
{
    const Args *args = render->args;
    const int count = scene_view_count(&render->scene);
    Subject subjects[PANELS_MAX];
    ViewDef views[PANELS_MAX];
    for (int i = 0; i < render->run_count; i++) {
        render->runs[i].watch = (PrefetchWatch){.every = INFINITY, .watched = -INFINITY};
    }
    for (int i = 0; i < count; i++) {
        ShownRun *run = &render->runs[render->run_of[i]];
        views[i] = view_in_file(scene_view(&render->scene, i));
        subjects[i] = (Subject){&views[i], &run->recorded.scene.world};
        run->attributes |= renderer_attributes(subjects[i].def);
        double before;
        run->watch.every = fmin(run->watch.every, overlays_every(subjects[i].def, &before));
        run->watch.before = fmax(run->watch.before, before);
    }
    if (!(render->context = headless_create(args->gpu, error)))
        return false;
    renderer_tell(headless_renderer(render->context));
    return open_prefetches(render, error) &&
           (render->panels = panels_create(subjects, count, args->width, args->height, error)) &&
           (image_create(&render->image, args->width, args->height) ||
            error_set(error, "out of memory for a picture of %d x %d", args->width, args->height)) &&
           (render->pictures = pictures_create(args->output, args->width, args->height,
                                               options_of_render(args)->fps, render->wanted, error));
}

static void close_all(FileRender *render)
{
    image_destroy(&render->image);
    panels_destroy(render->panels);
    for (int i = 0; i < render->run_count; i++) {
        prefetch_destroy(render->runs[i].prefetch);
        recorded_close(&render->runs[i].recorded); /* if not taken over by a reel */
    }
    headless_destroy(render->context);
}

/* A run watched for overlays. */
typedef struct RenderedState {
    FileRender *render;
    ShownRun *run;
} RenderedState;

static void see(void *user, const ParticleBuffers *particles)
{
    const RenderedState *watched = user;
    const FileRender *render = watched->render;
    for (int i = 0; i < panels_count(render->panels); i++)
        if (&render->runs[render->run_of[i]] == watched->run)
            panels_add_state(render->panels, i, particles);
    watched->run->drawn = SIZE_MAX; /* the buffers now hold the seen step */
}

/* Takes a run's state; `fresh` is set if the step has changed. */
static bool take(FileRender *render, ShownRun *run, double time, bool *fresh, Error *error)
{
    RenderedState watched = {render, run};
    if (!prefetch_watch(&run->watch, run->prefetch, time, &(PrefetchObserver){see, &watched}, &run->at,
                        error))
        return false;
    prefetch_seek(run->prefetch, time, render->interval);
    if (!prefetch_wait(run->prefetch, &run->at, error))
        return false;
    if (run->at.index == run->drawn)
        return true;
    *fresh = true;
    run->drawn = run->at.index;
    return prefetch_take(run->prefetch, &run->state) ||
           error_set(error, "%s: Step#%zu is not shown", run->recorded.path, run->at.index);
}

static PanelFacts facts_of(const ShownRun *run, bool own, double time)
{
    return (PanelFacts){.words = run->name,
                        .said = "",
                        .def = &run->recorded.scene.world,
                        .particles = run->state.count,
                        .spacing = run->recorded.numbers.spacing,
                        .recorded = true,
                        .first = own ? -INFINITY : run->at.first,
                        .last = own ? INFINITY : run->at.last,
                        .wanted = time};
}

static double time_of(const FileRender *render, int run, double time)
{
    return render->runs[run].time >= 0 ? render->runs[run].time : run == 0 ? time : render->runs[0].at.time;
}

/* Sets titles if there is more than one run. */
static bool set_titles(const FileRender *render, Error *error)
{
    const int count = panels_count(render->panels);
    PanelFacts facts[PANELS_MAX];
    bool ok = true;
    for (int i = 0; i < count; i++)
        facts[i] = facts_of(&render->runs[render->run_of[i]], render->run_of[i] == 0,
                            time_of(render, render->run_of[i], render->runs[0].at.time));
    for (int i = 0; ok && render->run_count > 1 && i < count; i++) {
        Title title;
        panel_title(facts, count, i, "", &title);
        ok = panels_set_title(render->panels, i, &title, error);
    }
    return ok;
}

/* Draws a picture; a step used for two pictures is drawn once. */
static bool draw(FileRender *render, double time, Error *error)
{
    const ParticleBuffers *states[PANELS_MAX];
    bool fresh = false;
    for (int i = 0; i < render->run_count; i++) /* the runs beside use the time of the file's step */
        if (!take(render, &render->runs[i], time_of(render, i, time), &fresh, error))
            return false;
    if (!fresh)
        return true;
    for (int i = 0; i < panels_count(render->panels); i++)
        states[i] = &render->runs[render->run_of[i]].state;
    if (!set_titles(render, error))
        return false;
    panels_draw(render->panels, states, NULL);
    missing_attributes_add(&render->missing, render->panels, states);
    if (!panels_read(render->panels, render->image.rgb, error))
        return false;
    render->particles = render->runs[0].state.count;
    render->time = render->runs[0].at.time;
    return true;
}

/* After a signal, stops as soon as there is one picture. */
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

/* ---- report ---- */

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

static void print_flaws(const FileRender *render)
{
    for (int i = 0; i < render->run_count; i++)
        if (render->runs[i].prefetch)
            prefetch_print_flaws(render->runs[i].prefetch, stderr);
}

static void report(const FileRender *render)
{
    const Args *args = render->args;
    char older[1088];
    print_flaws(render);
    missing_attributes_print(&render->missing, args->output, stderr);
    if (render->taken < render->wanted)
        fprintf(stderr, "stopped at t = %.4g s; %s is whole\n", render->time, args->output);
    if (pictures_find_stale(render->pictures, older))
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

static int show(FileRender *render, Error *error)
{
    int code = EXIT_FAILED;
    if (open_all(render, error) && take_pictures(render, error)) {
        code = finish(render, error);
    } else {
        print_flaws(render);
        fail(render, error);
        render_report_kept(render->args, pictures_kept(render->pictures));
        pictures_discard(render->pictures);
    }
    return code;
}

int render_file(const Args *args)
{
    FileRender render = {.args = args, .began_ms = wall_ms()};
    Error error = {{0}};
    PicturesKind kind;
    int code = EXIT_USAGE;
    interrupt_install();
    if (!understand(&render, &kind, &error)) {
        fprintf(stderr, "%s\n", error.message);
    } else if (args->json && !json_file_check(args->json, &error)) {
        fprintf(stderr, "%s\n", error.message);
        code = EXIT_FAILED;
    } else {
        code = show(&render, &error);
    }
    close_all(&render);
    return code;
}

/* Films a recorded session: simulated like slosh replay, with pictures of the states on the way. */
typedef struct SessionRender {
    const Args *args;
    PicturesKind kind;
    Recording recording;
    RecordingPlay play;
    Session session;
    const World *world; /* used by the shoot: the session may move to another backend */
    PanelPictures panel_pictures;
    Pictures *pictures;
    Progress progress;
    double until;         /* time of the last picture, s; INFINITY: end of the session */
    size_t taken, wanted; /* pictures; wanted 0: up to the end */
    double late;          /* greatest delay of a state after the time of its picture, s */
    bool ended;           /* the session is over */
    uint64_t hash;        /* world_hash at the end */
} SessionRender;

static bool refuse_option(const Args *args, const char *option, const char *why, Error *error)
{
    return error_set(error, "%s makes no sense for %s: %s", option, args->scenes[0], why);
}

static bool check_session_options(const Args *args, Error *error)
{
    if (args->device)
        return refuse_option(args, "--device", "all that moved the box is in the session", error);
    if (args->sweep_count > 0)
        return refuse_option(args, "--compare", "the session has one setting", error);
    return render_options_agree(args, error) &&
           recording_play_allows(args->scenes[0], &args->settings, error);
}

static bool choose_session_times(SessionRender *render, Error *error)
{
    const Args *args = render->args;
    const RenderOptions *own = options_of_render(args);
    if (!pictures_kind(args->output, &render->kind, error))
        return false;
    if (render->kind == PICTURES_PNG && own->frames > 0)
        return error_set(error, "--frames makes no sense for one picture, %s", args->output);
    render->until = args_given(args, "--time") ? args->time : INFINITY;
    render->wanted = render->kind == PICTURES_PNG ? 1 : (size_t)own->frames;
    if (render->wanted == 0 && args_given(args, "--time"))
        render->wanted = (size_t)fmax(ceil(args->time * own->fps - 1e-6), 1);
    return true;
}

/* Returns the time of the next picture, s. */
static double next_time(const SessionRender *render)
{
    return render->kind == PICTURES_PNG ? render->until
                                        : (double)render->taken / options_of_render(render->args)->fps;
}

/* Opens the shoot, without panels beside the scene: their states were not recorded. */
static bool open_shoot(SessionRender *render, Error *error)
{
    const Scene *scene = &render->session.run.scene;
    PicturePanel panels[PANELS_MAX];
    int count = 0;
    panel_pictures_close(&render->panel_pictures);
    for (int i = 0; i < scene_view_count(scene); i++)
        if (!compare_is_other(scene_view(scene, i)))
            panels[count++] = (PicturePanel){.session = &render->session, .view = scene_view(scene, i)};
    render->world = render->session.run.world;
    return count > 0 ? panel_pictures_open(&render->panel_pictures, panels, count, render->args->width,
                                           render->args->height, error)
                     : error_set(error, "%s: no view shows the session itself", render->args->scenes[0]);
}

static bool is_full(const SessionRender *render)
{
    return render->wanted > 0 && render->taken == render->wanted;
}

static bool take_picture(SessionRender *render, Error *error)
{
    if (render->world != render->session.run.world && !open_shoot(render, error))
        return false;
    do {
        const double time = fmin(next_time(render), render->session.run.info.time);
        if (!panel_pictures_take(&render->panel_pictures, time, error) ||
            !panel_pictures_draw(&render->panel_pictures, error) ||
            !pictures_add(render->pictures, &render->panel_pictures.image, error))
            return false;
        render->late = fmax(render->late, panel_pictures_late(&render->panel_pictures, time));
        render->taken++;
    } while (render->kind != PICTURES_PNG && session_reached(&render->session, next_time(render)) &&
             !is_full(render));
    return true;
}

/* Handles a state: applies the commands, and takes a picture if due. */
static bool look(SessionRender *render, Error *error)
{
    const double due = next_time(render);
    return recording_play_apply(&render->play, &render->session, error) &&
           (is_full(render) || !session_reached(&render->session, due) || take_picture(render, error));
}

/* True if the film is complete, by the end of the session or earlier. */
static bool is_over(SessionRender *render)
{
    render->ended = recording_play_ended(&render->play, &render->session);
    return render->ended || is_full(render) || interrupted();
}

/* Takes a picture of the last state, if there is none yet. */
static bool take_last(SessionRender *render, Error *error)
{
    render->hash = world_hash(render->session.run.world);
    return render->taken > 0 || take_picture(render, error);
}

/* Prepares a step: shows the state to overlays, and keeps the state if a picture may be due within the step.
 */
static bool foresee(SessionRender *render, Error *error)
{
    const Session *session = &render->session;
    const double time = next_time(render);
    return panel_pictures_watch(&render->panel_pictures, session, time, error) &&
           (!render_between(render->args, render->kind != PICTURES_PNG) ||
            panel_pictures_keep(&render->panel_pictures, session, time, error));
}

static bool simulate(SessionRender *render, Error *error)
{
    Session *session = &render->session;
    const double steps = (double)render->recording.steps;
    for (;;) {
        if (!look(render, error))
            return false;
        if (is_over(render))
            return take_last(render, error);
        if (render->world == session->run.world && !foresee(render, error))
            return false;
        if (!session_substep(session, error)) {
            if (!recording_play_broke(&render->play, session))
                return false;
            progress_end(&render->progress);
            fprintf(stderr, "%s\n", error->message);
            render->ended = true;
            return take_last(render, error);
        }
        const double whole = render->wanted > 0 ? (double)render->taken / (double)render->wanted : 0;
        progress_update(&render->progress, fmax((double)session->run.info.step / steps, whole));
    }
}

static int judge(const SessionRender *render)
{
    if (render->ended || interrupted())
        return recording_play_report(&render->play, &render->session, render->ended, render->hash,
                                     render->args->quiet);
    if (!render->args->quiet)
        fprintf(stderr, "the session goes on to step %" PRIu64 "; its end was not compared\n",
                render->recording.steps);
    return 0;
}

static bool write_json(const SessionRender *render, Error *error)
{
    const Session *session = &render->session;
    char hash[17];
    if (!render->args->json)
        return true;
    snprintf(hash, sizeof hash, "%016" PRIx64, render->hash);
    json_t *json = json_pack("{s:s, s:s, s:s, s:I, s:f, s:I, s:I, s:f, s:f, s:s, s:b, s:b, s:s}", "command",
                             "render", "recording", render->play.path, "output", render->args->output,
                             "pictures", (json_int_t)render->taken, "picture_late_seconds", render->late,
                             "particles", (json_int_t)session->run.info.count, "steps",
                             (json_int_t)session->run.info.step, "simulated_seconds", session->run.info.time,
                             "wall_seconds", 1e-3 * (wall_ms() - session->began_ms), "hash", hash, "same",
                             render->ended && recording_play_same(&render->play, render->hash), "stopped",
                             interrupted(), "renderer", headless_renderer(session->context));
    const bool written = json_file_write(json, render->args->json, error);
    json_decref(json);
    return written;
}

static int fail_session(const SessionRender *render, int code, const Error *error)
{
    const Args *args = render->args;
    fprintf(stderr, "%s\n", error->message);
    if (code == EXIT_FAILED)
        failure_json_write(failure_json("render", "recording", args->scenes[0], args->output, error),
                           args->json);
    return code;
}

static int finish_session(SessionRender *render, Error *error)
{
    const Args *args = render->args;
    Pictures *pictures = render->pictures;
    char older[1088];
    missing_attributes_print(&render->panel_pictures.missing, args->output, stderr);
    if (pictures_find_stale(pictures, older))
        fprintf(stderr, "%s and what follows is of an earlier run; remove it unless you want both\n", older);
    render->pictures = NULL;
    if (!pictures_finish(pictures, error))
        return fail_session(render, EXIT_FAILED, error);
    if (!args->quiet)
        fprintf(stderr, "%s: %zu picture%s up to t = %.4g s, %zu particle%s, from %s\n", args->output,
                render->taken, plural(render->taken), render->session.run.info.time,
                render->session.run.info.count, plural(render->session.run.info.count), args->scenes[0]);
    const int code = judge(render);
    return write_json(render, error) ? code : fail_session(render, EXIT_FAILED, error);
}

static int render_recorded_run(SessionRender *render, Error *error)
{
    const Args *args = render->args;
    if ((args->json && !json_file_check(args->json, error)) || !open_shoot(render, error) ||
        !(render->pictures = pictures_create(args->output, args->width, args->height,
                                             options_of_render(args)->fps, render->wanted, error)))
        return fail_session(render, EXIT_FAILED, error);
    progress_begin(&render->progress, stderr, "render", args->quiet);
    const bool done = simulate(render, error);
    progress_end(&render->progress);
    if (done)
        return finish_session(render, error);
    fail_session(render, EXIT_FAILED, error);
    render_report_kept(args, pictures_kept(render->pictures));
    return EXIT_FAILED;
}

static int open_recording(SessionRender *render, Error *error)
{
    const Args *args = render->args;
    if (!check_session_options(args, error) || !choose_session_times(render, error) ||
        !recording_read(args->scenes[0], &render->recording, error))
        return EXIT_USAGE;
    recording_play_warn_version(args->scenes[0], &render->recording);
    render->play = (RecordingPlay){.path = args->scenes[0], .recording = &render->recording};
    return recording_play_open(&render->play, &args->settings, args->gpu, true, &render->session, error);
}

int render_session(const Args *args)
{
    SessionRender render = {.args = args};
    Error error = {{0}};
    interrupt_install();
    int code = open_recording(&render, &error);
    code = code == 0 ? render_recorded_run(&render, &error) : fail_session(&render, code, &error);
    pictures_discard(render.pictures);
    panel_pictures_close(&render.panel_pictures);
    session_close(&render.session);
    recording_destroy(&render.recording);
    return code;
}
