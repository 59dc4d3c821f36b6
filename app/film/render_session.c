#include "app/base/file.h"
#include "app/base/program.h"
#include "app/files/pictures.h"
#include "app/film/render_file.h"
#include "app/film/render_report.h"
#include "app/run/compare/compare.h"
#include "app/run/compare/panel_pictures.h"
#include "app/run/session.h"
#include "app/session/args.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Films a recorded session: simulated like slosh replay, with pictures of the states on the way. */
typedef struct Film {
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
    bool ended;           /* the session is over */
    uint64_t hash;        /* world_hash at the end */
} Film;

static bool refuse(const Args *args, const char *option, const char *why, Error *error)
{
    return error_set(error, "%s makes no sense for %s: %s", option, args->scenes[0], why);
}

static bool check_options(const Args *args, Error *error)
{
    if (args->device)
        return refuse(args, "--device", "all that moved the box is in the session", error);
    if (args->sweep_count > 0)
        return refuse(args, "--compare", "the session has one setting", error);
    if (args->interpolate)
        return refuse(args, "--interpolate", "pictures are of the states that the session had", error);
    return recording_play_allows(args->scenes[0], &args->settings, error);
}

static bool choose_times(Film *film, Error *error)
{
    const Args *args = film->args;
    if (!pictures_kind(args->output, &film->kind, error))
        return false;
    if (film->kind == PICTURES_PNG && args->frames > 0)
        return error_set(error, "--frames makes no sense for one picture, %s", args->output);
    film->until = args->time_given ? args->time : INFINITY;
    film->wanted = film->kind == PICTURES_PNG ? 1 : (size_t)args->frames;
    if (film->wanted == 0 && args->time_given)
        film->wanted = (size_t)fmax(ceil(args->time * args->fps - 1e-6), 1);
    return true;
}

/* Returns the time of the next picture, s. */
static double next_time(const Film *film)
{
    return film->kind == PICTURES_PNG ? film->until : (double)film->taken / film->args->fps;
}

/* Opens the shoot, without panels beside the scene: their states were not recorded. */
static bool open_shoot(Film *film, Error *error)
{
    const Scene *scene = &film->session.scene;
    PicturePanel panels[PANELS_MAX];
    int count = 0;
    panel_pictures_close(&film->panel_pictures);
    for (int i = 0; i < scene_view_count(scene); i++)
        if (!compare_is_other(scene_view(scene, i)))
            panels[count++] = (PicturePanel){.session = &film->session, .view = scene_view(scene, i)};
    film->world = film->session.world;
    return count > 0 ? panel_pictures_open(&film->panel_pictures, panels, count, false, film->args->width,
                                           film->args->height, error)
                     : error_set(error, "%s: no view shows the session itself", film->args->scenes[0]);
}

static bool take_picture(Film *film, Error *error)
{
    if ((film->world != film->session.world && !open_shoot(film, error)) ||
        !panel_pictures_take(&film->panel_pictures, film->session.info.time, error) ||
        !panel_pictures_draw(&film->panel_pictures, error))
        return false;
    do {
        if (!pictures_add(film->pictures, &film->panel_pictures.image, error))
            return false;
        film->taken++;
    } while (film->kind != PICTURES_PNG && session_reached(&film->session, next_time(film)) &&
             (film->wanted == 0 || film->taken < film->wanted));
    return true;
}

static bool is_full(const Film *film)
{
    return film->wanted > 0 && film->taken == film->wanted;
}

/* Handles a state: applies the commands, and takes a picture if due. */
static bool look(Film *film, Error *error)
{
    const double due = next_time(film);
    return recording_play_apply(&film->play, &film->session, error) &&
           (is_full(film) || !session_reached(&film->session, due) || take_picture(film, error));
}

/* True if the film is complete, by the end of the session or earlier. */
static bool is_over(Film *film)
{
    film->ended = recording_play_ended(&film->play, &film->session);
    return film->ended || is_full(film) || interrupted();
}

/* Takes a picture of the last state, if there is none yet. */
static bool take_last(Film *film, Error *error)
{
    film->hash = world_hash(film->session.world);
    return film->taken > 0 || take_picture(film, error);
}

static bool simulate(Film *film, Error *error)
{
    Session *session = &film->session;
    const double steps = (double)film->recording.steps;
    for (;;) {
        if (!look(film, error))
            return false;
        if (is_over(film))
            return take_last(film, error);
        if (film->world == session->world &&
            !panel_pictures_watch(&film->panel_pictures, session, next_time(film), error))
            return false;
        if (!session_substep(session, error)) {
            if (!recording_play_broke(&film->play, session))
                return false;
            progress_end(&film->progress);
            fprintf(stderr, "%s\n", error->message);
            film->ended = true;
            return take_last(film, error);
        }
        const double whole = film->wanted > 0 ? (double)film->taken / (double)film->wanted : 0;
        progress_update(&film->progress, fmax((double)session->info.step / steps, whole));
    }
}

static int judge(const Film *film)
{
    if (film->ended || interrupted())
        return recording_play_report(&film->play, &film->session, film->ended, film->hash, film->args->quiet);
    if (!film->args->quiet)
        fprintf(stderr, "the session goes on to step %" PRIu64 "; its end was not compared\n",
                film->recording.steps);
    return 0;
}

static bool write_json(const Film *film, Error *error)
{
    const Session *session = &film->session;
    char hash[17];
    if (!film->args->json)
        return true;
    snprintf(hash, sizeof hash, "%016" PRIx64, film->hash);
    json_t *json = json_pack("{s:s, s:s, s:s, s:I, s:I, s:I, s:f, s:f, s:s, s:b, s:b, s:s}", "command",
                             "render", "recording", film->play.path, "output", film->args->output, "pictures",
                             (json_int_t)film->taken, "particles", (json_int_t)session->info.count, "steps",
                             (json_int_t)session->info.step, "simulated_seconds", session->info.time,
                             "wall_seconds", 1e-3 * (wall_ms() - session->began_ms), "hash", hash, "same",
                             film->ended && recording_play_same(&film->play, film->hash), "stopped",
                             interrupted(), "renderer", headless_renderer(session->context));
    const bool written = json_file_write(json, film->args->json, error);
    json_decref(json);
    return written;
}

static int fail(const Film *film, int code, const Error *error)
{
    const Args *args = film->args;
    fprintf(stderr, "%s\n", error->message);
    if (code == EXIT_FAILED)
        failure_json_write(failure_json("render", "recording", args->scenes[0], args->output, error),
                           args->json);
    return code;
}

static int finish(Film *film, Error *error)
{
    const Args *args = film->args;
    Pictures *pictures = film->pictures;
    char older[1088];
    missing_attributes_print(&film->panel_pictures.missing, args->output, stderr);
    if (pictures_find_stale(pictures, older))
        fprintf(stderr, "%s and what follows is of an earlier run; remove it unless you want both\n", older);
    film->pictures = NULL;
    if (!pictures_finish(pictures, error))
        return fail(film, EXIT_FAILED, error);
    if (!args->quiet)
        fprintf(stderr, "%s: %zu picture%s up to t = %.4g s, %zu particle%s, from %s\n", args->output,
                film->taken, plural(film->taken), film->session.info.time, film->session.info.count,
                plural(film->session.info.count), args->scenes[0]);
    const int code = judge(film);
    return write_json(film, error) ? code : fail(film, EXIT_FAILED, error);
}

static int shoot_film(Film *film, Error *error)
{
    const Args *args = film->args;
    if ((args->json && !json_file_check(args->json, error)) || !open_shoot(film, error) ||
        !(film->pictures =
              pictures_create(args->output, args->width, args->height, args->fps, film->wanted, error)))
        return fail(film, EXIT_FAILED, error);
    progress_begin(&film->progress, stderr, "render", args->quiet);
    const bool done = simulate(film, error);
    progress_end(&film->progress);
    if (done)
        return finish(film, error);
    fail(film, EXIT_FAILED, error);
    render_tell_staying(args, pictures_kept(film->pictures));
    return EXIT_FAILED;
}

static int open_recording(Film *film, Error *error)
{
    const Args *args = film->args;
    if (!check_options(args, error) || !choose_times(film, error) ||
        !recording_read(args->scenes[0], &film->recording, error))
        return EXIT_USAGE;
    recording_play_warn_version(args->scenes[0], &film->recording);
    film->play = (RecordingPlay){.path = args->scenes[0], .recording = &film->recording};
    return recording_play_open(&film->play, &args->settings, args->gpu, true, &film->session, error);
}

int render_session(const Args *args)
{
    static Film film;
    Error error = {{0}};
    film = (Film){.args = args};
    interrupt_install();
    int code = open_recording(&film, &error);
    code = code == 0 ? shoot_film(&film, &error) : fail(&film, code, &error);
    pictures_discard(film.pictures);
    panel_pictures_close(&film.panel_pictures);
    session_close(&film.session);
    recording_destroy(&film.recording);
    return code;
}
