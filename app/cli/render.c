#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/files/pictures.h"
#include "app/run/compare/compare.h"
#include "app/run/playback/playback.h"
#include "app/run/recording/recording.h"
#include "app/scene/scene.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Times of the pictures: `count` pictures, `interval` seconds apart, from `first` on. */
typedef struct Schedule {
    double first, interval;
    size_t count;
} Schedule;

/* The state of a render command. */
typedef struct Render {
    const Args *args;
    RenderPlan plan;
    Session sessions[PANELS_MAX]; /* one per world; the first owns the context */
    PanelPictures panel_pictures;
    Pictures *pictures;
    Schedule schedule;
    bool between; /* render_between */
    Progress progress;
    RenderFigures figures;
    EmbeddedScene carried; /* in each PNG file */
    ImageText text;
} Render;

static Schedule make_schedule(const Args *args, PicturesKind kind)
{
    const RenderOptions *own = options_of_render(args);
    if (kind == PICTURES_PNG)
        return (Schedule){args->time, 0, 1};
    double count = own->frames ? own->frames : fmax(ceil(args->time * own->fps - 1e-6), 1);
    return (Schedule){0, 1 / own->fps, (size_t)count};
}

/* Time shown in a panel: the view's own, or the picture's. A panel beside a leading scene shows the time of
   the scene's state, as in the window, once the scene has reached its state; before, the time of the picture.
   Interpolated pictures have one time. */
static double shown_at(const Render *render, int panel, double time)
{
    const int leader = render->plan.leader_of[panel];
    const bool follows = leader >= 0 && leader != render->plan.world_of[panel] && !render->between;
    if (render->plan.views[panel]->time >= 0)
        return render->plan.views[panel]->time;
    return follows && session_reached(&render->sessions[leader], time)
               ? render->sessions[leader].run.info.time
               : time;
}

/* Facts of a panel's content; of a recorded run, known facts before its first picture. */
static PanelFacts facts_of(const Render *render, int panel, double time)
{
    const RenderPlan *plan = &render->plan;
    const int world = plan->world_of[panel], file = plan->file_of[panel];
    if (world >= 0) {
        const Session *session = &render->sessions[world];
        return (PanelFacts){.def = &session->run.scene.world,
                            .particles = session->run.info.count,
                            .spacing = session->run.info.spacing};
    }
    const Recorded *run = &plan->files[file];
    const PictureSource *source = &render->panel_pictures.sources[render->panel_pictures.source_of[panel]];
    return (PanelFacts){.def = &run->scene.world,
                        .particles = source->state.count,
                        .spacing = run->numbers.spacing,
                        .recorded = true,
                        .first = run->first,
                        .last = source->taken ? source->at.last : run->last,
                        .wanted = shown_at(render, panel, time)};
}

/* Settings for a panel's name: the values of --compare, and the view's own. */
static void said_of(const RenderPlan *plan, int panel, char lines[VIEW_SET_SIZE + TITLE_SIZE])
{
    const Args *args = plan->args;
    const size_t size = VIEW_SET_SIZE + TITLE_SIZE;
    size_t used = (size_t)snprintf(lines, size, "%s\n", text_or_empty(plan->views[panel]->set));
    for (int i = 0; i < args->sweep_count && used < size; i++)
        used += (size_t)snprintf(lines + used, size - used, "%s=\n", args->sweeps[i].key);
}

/* Makes a panel's title; none if all panels show the same states of one setting. */
static void make_title(const Render *render, int panel, double time, Title *title)
{
    const RenderPlan *plan = &render->plan;
    PanelFacts facts[PANELS_MAX];
    char names[PANELS_MAX][TITLE_SIZE], said[PANELS_MAX][VIEW_SET_SIZE + TITLE_SIZE];
    bool any = false;
    for (int i = 0; i < plan->panel_count; i++) {
        render_plan_name(plan, i, names[i]);
        said_of(plan, i, said[i]);
        facts[i] = facts_of(render, i, time);
        facts[i].words = names[i];
        facts[i].said = said[i];
        any |= *names[i] != 0;
    }
    *title = (Title){.words = ""};
    if (any)
        panel_title(facts, plan->panel_count, panel, "simulated", title);
}

static bool open_shoot(Render *render, Error *error)
{
    PicturePanel panels[PANELS_MAX];
    RenderPlan *plan = &render->plan;
    for (int i = 0; i < plan->panel_count; i++) {
        const int world = plan->world_of[i], file = plan->file_of[i];
        const bool follows = plan->leader_of[i] >= 0 && !render->between;
        panels[i] = (PicturePanel){.session = world >= 0 ? &render->sessions[world] : NULL,
                                   .recorded = file >= 0 ? &plan->files[file] : NULL,
                                   .scene = follows ? &render->sessions[plan->leader_of[i]] : NULL,
                                   .view = plan->views[i]};
    }
    return panel_pictures_open(&render->panel_pictures, panels, plan->panel_count, render->args->width,
                               render->args->height, error);
}

/* The time due for a world, for a picture at `time`. */
static double due_at(const Render *render, int world, double time)
{
    int panel = 0;
    while (render->plan.world_of[panel] != world)
        panel++;
    return shown_at(render, panel, time);
}

/* Fraction of work done, by simulated time, as the solver takes most of the time. */
static double fraction_done(const Render *render)
{
    const Schedule *schedule = &render->schedule;
    const double last = schedule->first + schedule->interval * (double)(schedule->count - 1);
    double simulated = 0, due = 0;
    for (int i = 0; i < render->plan.world_count; i++) {
        simulated += render->sessions[i].run.info.time;
        due += due_at(render, i, last);
    }
    return due > 0 ? simulated / due : (double)render->figures.pictures / (double)schedule->count;
}

/* Puts the session's name before the reason; returns false. */
static bool blame(const Session *session, Error *error)
{
    const Error reason = *error;
    return error_set(error, "%s%s", session->prefix, reason.message);
}

/* Advances a world one step towards the picture at `time`. In mode cfl states fall on that time. */
static bool step(Render *render, int world, double time, Error *error)
{
    Session *session = &render->sessions[world];
    const bool between = render->between && session->run.scene.world.step_mode == STEP_FIXED;
    if (!panel_pictures_watch(&render->panel_pictures, session, time, error))
        return blame(session, error);
    const double began = wall_ms();
    if ((between && !panel_pictures_keep(&render->panel_pictures, session, time, error)) ||
        !session_step(session, error))
        return blame(session, error);
    render->figures.step_seconds[world] += 1e-3 * (wall_ms() - began);
    progress_update(&render->progress, fraction_done(render));
    return true;
}

/* Index of the unfinished world furthest behind; -1: all have finished. */
static int find_next(const Render *render, double time)
{
    int next = -1;
    for (int i = 0; i < render->plan.world_count; i++)
        if (!session_reached(&render->sessions[i], due_at(render, i, time)) &&
            (next < 0 || render->sessions[i].run.info.time < render->sessions[next].run.info.time))
            next = i;
    return next;
}

/* Advances all worlds side by side, so that a signal stops all at about one time. */
static bool advance(Render *render, double time, Error *error)
{
    int next;
    while ((next = find_next(render, time)) >= 0 && !interrupted()) {
        const double due = due_at(render, next, time);
        world_stop_at(render->sessions[next].run.world, due);
        if (!step(render, next, due, error))
            return false;
    }
    return true;
}

static bool take_picture(Render *render, double time, Error *error)
{
    const RenderPlan *plan = &render->plan;
    PanelPictures *panel_pictures = &render->panel_pictures;
    Title titles[PANELS_MAX];
    if (!panel_pictures_take(panel_pictures, time, error))
        return false;
    for (int i = 0; i < plan->panel_count; i++) {
        make_title(render, i, time, &titles[i]);
        if (!panel_pictures_set_title(panel_pictures, i, &titles[i], error))
            return false;
    }
    render->text.time = panel_pictures->sources[0].state.time;
    if (!panel_pictures_draw(panel_pictures, error) ||
        !pictures_add(render->pictures, &panel_pictures->image, error))
        return false;
    for (int i = 0; i < plan->panel_count; i++)
        for (int k = 0; k < i; k++)
            render->figures.differ[i][k] |= !panel_pictures_same(panel_pictures, i, k, titles);
    render->figures.pictures++;
    render->figures.apart = fmax(render->figures.apart, panel_pictures_spread(panel_pictures));
    render->figures.late = fmax(render->figures.late, panel_pictures_late(panel_pictures, time));
    progress_update(&render->progress, fraction_done(render));
    return true;
}

/* Takes each picture once each world has a state at or after its time. After a signal, takes one more picture
   only if there is none yet. */
static bool take_pictures(Render *render, Error *error)
{
    const Schedule *schedule = &render->schedule;
    while (render->figures.pictures < schedule->count) {
        const double time = schedule->first + schedule->interval * (double)render->figures.pictures;
        if (!advance(render, time, error))
            return false;
        if (interrupted() && render->figures.pictures > 0)
            break;
        if (!take_picture(render, time, error))
            return false;
    }
    return true;
}

/* Warns of frames of an earlier run in the folder, which would mix two films. */
static void warn_of_older(const Pictures *pictures, size_t taken)
{
    char frame[1088];
    if (taken > 0 && pictures_find_stale(pictures, frame))
        fprintf(stderr, "%s and what follows is of an earlier run; remove it unless you want both\n", frame);
}

/* Reports the failure; pictures so far are useless. */
static int fail(const Render *render, const Error *error)
{
    const Session *first = &render->sessions[0];
    const Summary summary = {.command = "render",
                             .product = "pictures",
                             .renderer = first->context ? headless_renderer(first->context) : NULL};
    return session_fail(first, render->args, &summary, error);
}

static int report(Render *render, Error *error)
{
    RenderFigures *figures = &render->figures;
    const Schedule *schedule = &render->schedule;
    figures->stopped = figures->pictures < schedule->count;
    for (int i = 0; schedule->count == 1 && i < render->plan.world_count; i++)
        figures->stopped |= !session_reached(&render->sessions[i], due_at(render, i, schedule->first));
    render_report(&render->plan, render->sessions, figures);
    if (render_write_json(&render->plan, render->sessions, &render->panel_pictures, figures, error))
        return figures->stopped ? EXIT_INTERRUPTED : 0;
    fprintf(stderr, "%s\n", error->message);
    return EXIT_FAILED;
}

/* Warns of surprises in the times of pictures. */
static void tell_times(const Render *render)
{
    bool own = render->schedule.count == 1;
    for (int i = 0; i < render->plan.panel_count; i++)
        own &= render->plan.views[i]->time >= 0;
    if (own && args_given(render->args, "--time"))
        fprintf(stderr, "--time %.9g has no effect: each view shows a time of its own\n", render->args->time);
    for (int i = 0; i < render->plan.world_count; i++) {
        const Session *session = &render->sessions[i];
        if (options_of_render(render->args)->interpolate && session->run.scene.world.step_mode == STEP_CFL)
            fprintf(stderr, "%s--interpolate has no effect: in mode cfl states fall on the pictures' times\n",
                    session->prefix);
        if (render->schedule.count > 1 && !render->between && due_at(render, i, 0) == 0)
            session_warn_uneven(session, "pictures", render->schedule.interval,
                                render->schedule.interval * (render->schedule.count - 1));
    }
}

/* Makes the scene to embed, as given, unless the scene forbids embedding. */
static bool make_carried(const Args *args, Scene *scene, EmbeddedScene *out, Error *error)
{
    SceneSettings settings = args->settings;
    size_t size = 0;
    if (!scene_load(args->scenes[0], &settings, scene, NULL, error))
        return false;
    char *text = scene->view.carries_scene ? scene_file_read(scene->path, &size, error) : NULL;
    if (!text)
        return !scene->view.carries_scene;
    const SceneSource save = {.scene = scene, .path = scene->path, .text = text, .size = size};
    const bool ok = embedded_scene_make(&save, out, error);
    free(text);
    return ok;
}

/* Embeds the scene in the pictures, without the settings of --compare, which differ between panels. */
static void carry(Render *render, PicturesKind kind)
{
    Scene *scene = kind == PICTURES_VIDEO ? NULL : calloc(1, sizeof *scene);
    EmbeddedScene *carried = &render->carried;
    Error error = {{0}};
    if (!scene)
        return;
    if (!make_carried(render->args, scene, carried, &error))
        fprintf(stderr, "%s; the pictures carry no scene\n", error.message);
    render->text = embedded_scene_text(carried, 0);
    if (carried->scene)
        pictures_embed(render->pictures, &render->text);
    if (carried->scene && render->args->sweep_count > 0)
        fprintf(stderr, "--compare: pictures carry the scene without what it compares\n");
    free(scene);
}

static int shoot_all(Render *render, PicturesKind kind, Error *error)
{
    bool taken = false;
    render->schedule = make_schedule(render->args, kind);
    render->between = render_between(render->args, kind != PICTURES_PNG);
    carry(render, kind);
    tell_times(render);
    if (open_shoot(render, error)) {
        progress_begin(&render->progress, stderr, "render", render->args->quiet);
        taken = take_pictures(render, error);
        progress_end(&render->progress);
    }
    const size_t count = taken ? render->figures.pictures : 0, staying = pictures_kept(render->pictures);
    warn_of_older(render->pictures, count);
    missing_attributes_print(&render->panel_pictures.missing, render->args->output, stderr);
    if (!taken)
        pictures_discard(render->pictures);
    else
        taken = pictures_finish(render->pictures, error);
    const int code = taken ? report(render, error) : fail(render, error);
    if (!taken)
        render_report_kept(render->args, staying);
    panel_pictures_close(&render->panel_pictures);
    return code;
}

static bool understand(const Args *args, PicturesKind *kind, Error *error)
{
    if (!pictures_kind(args->output, kind, error) || !render_options_agree(args, error))
        return false;
    return *kind != PICTURES_PNG || options_of_render(args)->frames == 0 ||
           error_set(error,
                     "--frames makes no sense for one picture, %s; name a FILE.mp4 or a folder, or "
                     "leave --frames out",
                     args->output);
}

/* Opens a session per world, all in the context of the first. */
static int open_sessions(Render *render, Error *error)
{
    RenderPlan *plan = &render->plan;
    for (int i = 0; i < plan->world_count; i++) {
        const int code =
            session_open_scene(&render->sessions[i], render->args, plan->scene_of[i], plan->worlds[i],
                               i > 0 ? render->sessions[0].context : NULL, error);
        if (code == 0)
            continue;
        blame(&render->sessions[i], error);
        return code;
    }
    return 0;
}

static int open_all(Render *render, PicturesKind *kind, Error *error)
{
    const Args *args = render->args;
    if (!understand(args, kind, error) || !render_plan_make(args, &render->plan, error))
        return EXIT_USAGE;
    return open_sessions(render, error);
}

static void files_pictures(CommandFiles *files, const OptionRow *row, const char *output)
{
    PicturesKind kind;
    const bool folder = pictures_kind(output, &kind, NULL) && kind == PICTURES_FOLDER;
    command_files_add(files, FILE_REPLACED, row->name, output, folder ? "frame_[0-9]*.png" : NULL);
}

static void files_argument(CommandFiles *files, const Args *args, const char *name)
{
    (recording_is_file(name) ? files_recording : files_scene)(files, args, name);
}

static int run_command(const Args *args)
{
    if (recorded_is_file(args->scenes[0]))
        return render_file(args);
    if (recording_is_file(args->scenes[0]))
        return render_session(args);
    Render *render = calloc(1, sizeof *render);
    Error error = {{0}};
    PicturesKind kind;
    interrupt_install();
    if (!render) {
        fprintf(stderr, "no memory for the scene\n");
        return EXIT_FAILED;
    }
    render->args = args;
    int code = open_all(render, &kind, &error);
    if (code == EXIT_USAGE || (code == 0 && args->json && !json_file_check(args->json, &error))) {
        fprintf(stderr, "%s\n", error.message);
        code = code == 0 ? EXIT_FAILED : code;
    } else if (code != 0 || !(render->pictures = pictures_create(args->output, args->width, args->height,
                                                                 options_of_render(args)->fps,
                                                                 make_schedule(args, kind).count, &error))) {
        code = fail(render, &error);
    } else {
        code = shoot_all(render, kind, &error);
    }
    for (int i = PANELS_MAX; i-- > 0;)
        session_close(&render->sessions[i]);
    render_plan_close(&render->plan);
    embedded_scene_free(&render->carried);
    free(render);
    return code;
}

/* clang-format off */
static const OptionRow options[] = {
    ROW_OUTPUT("OUT", .files = files_pictures, .help = "the file or folder to write"),
    ROW_TIME(5, "simulated seconds (5; of a recorded run or session all of it, and the one picture of its end)"),
    {"--interpolate", NULL, OPTION_FLAG, OWN(RenderOptions, interpolate),
     .help = "one picture too is at its very time, between two steps of a fixed length; videos and folders are by themselves"},
    {"--steps", NULL, OPTION_FLAG, OWN(RenderOptions, steps),
     .help = "pictures of a video or folder show steps, the first at or after each one's time, and nothing in between"},
    ROW_FRAMES(RenderOptions),
    {"--fps", "N", OPTION_NUMBER, OWN(RenderOptions, fps), .initial = 30, .min = 0.001, .max = 1000, .help = "frames in a second (30)"},
    ROW_PICTURE_SIZE,
    {"--compare", "KEY=A,B,...", OPTION_SWEEP, AT(sweeps),
     .help = "two or four settings side by side in one picture: particles, backend, method, view, time or any scene key; twice with two values each for all four"},
    ROWS_SCENE, ROW_VIEW, ROW_PRESET, ROWS_PROCESSOR, ROW_GPU, ROW_SHADERS, ROWS_DEVICE_MOVES, ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_render = {
    .name = "render",
    .usage = "SCENE|IN.h5part|SESSION -o OUT.png|OUT.mp4|OUT.gif|FOLDER ...",
    .help =
        "a scene, a recorded run or a recorded session as a picture, a video or a folder of pictures; needs no display",
    .takes = "scene",
    .takes_min = 1,
    .takes_max = 1,
    .output = "OUT.png, OUT.mp4, OUT.gif or a folder",
    .width = 1280,
    .height = 720,
    .own_size = sizeof(RenderOptions),
    .argument_files = files_argument,
    .options = options,
    .run = run_command,
};
