#define _DEFAULT_SOURCE /* on_exit */
#include "app/window/play.h"

#include "app/base/program.h"
#include "app/input/device/device.h"
#include "app/run/offscreen.h"
#include "app/scene/import/import.h"
#include "app/window/model.h"
#include "app/window/play_private.h"
#include "sim/gpu/gl.h"
#include "sim/world.h"

#include <math.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static const float PANEL_FROM_EM =
    56;                            /* the panel takes less than half of windows wider than so many letters */
static const double REST_MS = 300; /* before a picture at rest is drawn at best quality */
static const double IDLE_MS = 100, HELD_MS = 8, PATIENCE_MS = 1000, WORK_MS = 4;

/* The window's parts and resources. */
typedef struct PlaySession {
    Play play;
    const PlaySetup *setup;
    Devices *devices; /* NULL: not started, or not used */
    jmp_buf back;     /* jump to the end, from window functions after the display is gone */
} PlaySession;

/* A WindowClaimed: true if a BoxControl uses the device. */
static bool claimed(void *control, uint16_t vendor, uint16_t product)
{
    return box_control_uses(control, vendor, product);
}

static bool make_post(PlaySession *session, Error *error)
{
    Play *play = &session->play;
    Mapping mapping;
    mapping_default(&mapping);
    play->control =
        box_control_create(session->setup->mapping ? session->setup->mapping : &mapping, window_wake);
    if (!play->control)
        return error_set(error, "no memory for the hand");
    window_leave_gamepads(play->window, claimed, play->control);
    return true;
}

static bool make_window(PlaySession *session, Error *error)
{
    Play *play = &session->play;
    driver_error_install();
    play->window = window_create("slosh", session->setup->width, session->setup->height, error);
    if (!play->window)
        return false;
    renderer_tell(window_renderer(play->window));
    gl_context_begin();
    if (!picture_read_display(&play->picture, play->window, error))
        return false;
    gl_timer_between(play->picture.pauses, events_between_passes, play);
    return true;
}

static bool start(PlaySession *session, Error *error)
{
    Play *play = &session->play;
    const PlaySetup *setup = session->setup;
    if (!make_window(session, error) || !make_post(session, error))
        return false;
    play->model = (PlayModel){.window = play->window,
                              .guard = watchdog_create(setup->record, window_connection(play->window)),
                              .timer = play->picture.timer,
                              .control = play->control,
                              .notice = &play->notice,
                              .record = setup->record,
                              .history_bytes = setup->history_bytes,
                              .speed = 1};
    const float letters = picture_letters(play->window);
    play->overlay.panel =
        (float)play->picture.width > PANEL_FROM_EM * letters; /* beside the fluid, not above */
    play->overlay.opener = !play->overlay.panel;
    return requests_open_scene(play, setup->scene, setup->settings, error) &&
           picture_start(&play->picture, &play->model.open, error) &&
           play_overlay_start(&play->overlay, letters, error);
}

/* Starts motion devices when a box can be moved. */
static bool start_devices(PlaySession *session, Error *error)
{
    const PlaySetup *setup = session->setup;
    const DevicesSetup devices = {
        .source = setup->device, .listener = box_control_device_event, .user = session->play.control};
    if (session->devices || !setup->mapping || !session->play.model.has_particles)
        return true;
    session->devices = devices_start(&devices, error);
    return session->devices != NULL;
}

static void update_scale(Play *play)
{
    const float letters = picture_letters(play->window);
    if (picture_follow_scale(&play->picture, letters))
        play_overlay_set_letters(&play->overlay, letters);
}

/* With --shaders: rereads changed files. */
static void update_shaders(Play *play)
{
    Error error = {{0}};
    if (!picture_shaders_changed(&play->picture))
        return;
    if (picture_reload(&play->picture, &play->model.open, &error) &&
        (!play->model.open.simulator || simulator_reload(play->model.open.simulator, &error)) &&
        compare_reload(play->model.open.compared, &error))
        notice_tell(&play->notice, "the shaders were read again");
    else
        notice_error(&play->notice, error.message);
}

static bool hand_busy(const Play *play)
{
    WindowGamepad pad;
    return input_busy(&play->input) || window_gamepad(play->window, &pad);
}

/* Draws a picture if there are changes, at most at the display's rate. A solver on the GPU works in
   between. */
static void pause_or_draw(Play *play)
{
    const PlayPicture *picture = &play->picture;
    PlayScene *open = &play->model.open;
    const double work = open->source->work(open, WORK_MS);
    const double now = wall_ms(), due = picture->begun_ms + 900 / picture->refresh;
    const bool wanted = picture_visible(picture) && (picture->over || draw_needs_fluid(play));
    if (wanted && now >= due)
        draw_picture(play);
    else if (!wanted && now >= picture->drawn_ms + REST_MS && draw_rests(play))
        draw_best_picture(play);
    else if (wanted)
        window_wait(play->window, 1e-3 * fmin(fmax(due - now, 0.1), work));
    else
        window_wait(play->window, 1e-3 * fmin(hand_busy(play) ? HELD_MS : IDLE_MS, work));
}

/* Reports the figures on request. */
static void tell_figures(PlaySession *session)
{
    PlayFigures figures;
    Error error = {{0}};
    play_figures_fill(&session->play, &figures);
    if (!session->setup->json)
        play_figures_print(&figures, stderr);
    else if (!play_figures_write_json(&figures, session->setup->json, &error))
        notice_error(&session->play.notice, error.message);
}

/* Called while a mesh is read, even during a request: the fluid is drawn and follows the hand; further
   requests wait. */
static void during_mesh_read(void *of_session)
{
    PlaySession *session = of_session;
    Play *play = &session->play;
    PlayScene *open = &play->model.open;
    if (play->drawing) {
        window_wait(play->window, 1e-3 * WORK_MS);
        return;
    }
    events_process_moves(play);
    open->source->status(open, &play->model.status); /* model_read_status would also change the scene */
    if (interrupt_progress_requested())
        tell_figures(session);
    pause_or_draw(play);
}

static const char GONE[] = "the display is gone";

static bool run(PlaySession *session, Error *error)
{
    Play *play = &session->play;
    mesh_file_on_wait(during_mesh_read, session);
    while (!play->quit && !interrupted()) {
        if (window_gone(play->window))
            return error_set(error, GONE);
        events_process(play);
        if (!start_devices(session, error))
            return false;
        model_read_status(&play->model);
        model_end_previous(&play->model, 0);
        update_scale(play);
        update_shaders(play);
        scene_watch_poll(play);
        if (!picture_follow_size(&play->picture, play->window, error))
            return false;
        play->picture.over |= notice_changed(&play->notice) | play_overlay_poll(&play->overlay) |
                              welcome_changed(&play->welcome);
        if (interrupt_progress_requested())
            tell_figures(session);
        if (!play->quit)
            pause_or_draw(play);
    }
    return true;
}

static void jump_back(void *of_session)
{
    PlaySession *session = of_session;
    longjmp(session->back, 1);
}

static bool run_while_there(PlaySession *session, Error *error)
{
    Window *window = session->play.window;
    if (setjmp(session->back) != 0) {
        window_when_gone(window, NULL, NULL);
        return error_set(error, GONE);
    }
    window_when_gone(window, jump_back, session);
    const bool ok = run(session, error);
    window_when_gone(window, NULL, NULL);
    return ok;
}

static bool save_session(PlaySession *session, Error *error)
{
    PlayModel *model = &session->play.model;
    const char *record = session->setup->record;
    const bool asked = !interrupted() && !window_gone(session->play.window); /* the user could have saved */
    char path[1024];
    if (!record && (asked || !model->open.source->simulates))
        return true;
    return !watchdog_session_path(record, model->status.unsaved, path) || model_save_now(model, path, error);
}

/* Hides the window at once, then finishes writing files. */
static bool finish(PlaySession *session, Error *error)
{
    Play *play = &session->play;
    if (play->capture.screenshot && !window_gone(play->window)) /* requested in the last moment */
        draw_picture(play);
    mesh_file_on_wait(NULL, NULL);
    window_hide(play->window);
    const bool saved = save_session(session, error);
    watchdog_destroy(play->model.guard);
    play->model.guard = NULL;
    const bool movie = capture_end(&play->capture, &play->notice);
    return saved && (movie || error_set(error, "the video was not written"));
}

/* Ends the process after all writes, before libraries free objects that the solver's thread still uses. */
static void end_at_once(int status, void *nothing)
{
    (void)nothing;
    fflush(NULL);
    _exit(status);
}

/* Returns false if the solver is in a frame of seconds, or the driver would wait for a lost display: then
   only the end of the process ends them. */
static bool close_all(PlaySession *session)
{
    Play *play = &session->play;
    devices_stop(session->devices);
    if (play->control)
        box_control_close(play->control);
    watchdog_destroy(play->model.guard);
    play->model.guard = NULL;
    if ((play->window && window_gone(play->window)) || !model_close(&play->model, PATIENCE_MS))
        return false;
    box_control_destroy(play->control);
    play_overlay_end(&play->overlay);
    picture_end(&play->picture);
    window_destroy(play->window);
    return true;
}

/* Prints the error; the first error stays in the figures. */
static void report_failure(const Error *error, PlayFigures *figures)
{
    fprintf(stderr, "%s\n", error->message);
    if (!*figures->failure.message)
        figures->failure = *error;
}

static bool play_session(PlaySession *session, PlayFigures *figures)
{
    Play *play = &session->play;
    Error error = {{0}};
    const bool started = start(session, &error);
    const bool ran = started && run_while_there(session, &error);
    if (started) {
        model_read_status(&play->model);
        play_figures_fill(play, figures);
    }
    if (!ran)
        report_failure(&error, figures);
    if (!started || finish(session, &error))
        return ran;
    report_failure(&error, figures);
    return false;
}

int play(const PlaySetup *setup, PlayFigures *figures)
{
    PlaySession *session = calloc(1, sizeof *session);
    if (!session) {
        fprintf(stderr, "no memory for the window\n");
        return EXIT_FAILED;
    }
    session->setup = setup;
    session->play.notice.quiet = setup->quiet;
    session->play.shake_seconds = setup->shake_seconds;
    input_begin(&session->play.input);
    interrupt_install();
    interrupt_enable_progress_request();
    snprintf(figures->scene, sizeof figures->scene, "%s", setup->scene);
    const bool ok = play_session(session, figures);
    if (close_all(session))
        free(session);
    else
        on_exit(end_at_once, NULL);
    return ok ? 0 : EXIT_FAILED;
}
