#include "app/play/play.h"

#include "app/base/exit_code.h"
#include "app/base/interrupt.h"
#include "app/play/play_state.h"
#include "app/scene/live.h"
#include "render/frame/legend.h"
#include "sim/base/stage.h"
#include "sim/gl/debug.h"
#include "sim/gl/shader_source.h"
#include "sim/world/world.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double LETTERS = 14; /* pixels high at scale 1 */
static const double NOTICE_MS = 4000, IDLE_MS = 100, HELD_MS = 8, PATIENCE_MS = 1000, SHADERS_MS = 300,
                    WORK_MS = 4;

static void show_notice(Play *play, const char *words)
{
    snprintf(play->notice, sizeof play->notice, "%.300s", words);
    play->notice_until_ms = wall_ms() + NOTICE_MS;
    play->dirty = true;
}

void play_tell(Play *play, const char *format, ...)
{
    char words[sizeof(Error)];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(words, sizeof words, format, arguments);
    va_end(arguments);
    show_notice(play, words);
    if (!play->setup->quiet)
        fprintf(stderr, "%s\n", words);
}

void play_error(Play *play, const char *message)
{
    show_notice(play, message);
    fprintf(stderr, "%s\n", message);
}

void play_view_changed(Play *play)
{
    Error error = {{0}};
    play->dirty = true;
    if (!renderer_set_def(play->renderer, &play->open.scene.view, &play->open.scene.world, &error))
        play_error(play, error.message);
}

_Static_assert((int)PANEL_SETTING_SIZE == SIM_SETTING_SIZE, "what the panel asks for fits into a command");

static void advise_anew(Play *play, const char *setting)
{
    Notes fresh = {.count = 0};
    play_scene_advise(&play->open, setting, &fresh);
    for (int i = fresh.count - 1; i >= 0; i--)
        play_tell(play, "%s", fresh.line[i]);
}

void play_set(Play *play, const char *setting)
{
    Error error = {{0}};
    bool concerns_world;
    SimCommand command = {.kind = SIM_SET};
    char backend[NAME_SIZE];
    snprintf(backend, sizeof backend, "%s", play->open.scene.world.backend);
    if (!scene_set_live(&play->open.scene, setting, &concerns_world, &error)) {
        play_error(play, error.message);
        return;
    }
    simulator_set_realtime(play->open.simulator, play->open.scene.realtime);
    play_view_changed(play);
    advise_anew(play, setting);
    snprintf(command.setting, sizeof command.setting, "%s", setting);
    if (sim_command_moves(&command)) {
        if (!play_scene_move(&play->open, &command, &error)) {
            snprintf(play->open.scene.world.backend, sizeof backend, "%s", backend);
            play_error(play, error.message);
        }
        return;
    }
    if (concerns_world && !simulator_send(play->open.simulator, &command))
        play_error(play, "too many changes wait for the next step; let the time run");
}

static double cpu_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static bool follow_size(Play *play, Error *error)
{
    int width, height;
    window_size(play->window, &width, &height);
    if (width == play->width && height == play->height)
        return true;
    play->width = width;
    play->height = height;
    play->dirty = true;
    return width < 1 || height < 1 || renderer_resize(play->renderer, width, height, error);
}

/* The letters follow the display's scale; where that fails they stay as they are. */
static void follow_scale(Play *play)
{
    Error error = {{0}};
    const float pixels = (float)(LETTERS * window_scale(play->window));
    if (pixels == text_height(play->text))
        return;
    Text *text = text_create(pixels, &error);
    if (text && ui_set_pixels(play->ui.ui, pixels, &error)) {
        text_destroy(play->text);
        play->text = text;
        play->ui.input.changed = play->dirty = true;
        return;
    }
    text_destroy(text);
}

/* With --shaders: those that have changed are read again; where one is wrong, the last good ones stay. */
static void follow_shaders(Play *play)
{
    Error error = {{0}};
    if (wall_ms() < play->shaders_due_ms)
        return;
    play->shaders_due_ms = wall_ms() + SHADERS_MS;
    const uint64_t stamp = shader_source_stamp();
    if (stamp == play->shaders_stamp || play->width < 1 || play->height < 1)
        return;
    play->shaders_stamp = stamp;
    Renderer *renderer =
        renderer_create(&play->open.scene.view, &play->open.scene.world, play->width, play->height, &error);
    if (!renderer) {
        play_error(play, error.message);
        return;
    }
    renderer_destroy(play->renderer);
    play->renderer = renderer;
    if (simulator_reload(play->open.simulator, &error))
        play_tell(play, "the shaders were read again");
    else
        play_error(play, error.message);
}

/* A HandPost whose devices the window leaves to it. */
static bool claimed(void *post, uint16_t vendor, uint16_t product)
{
    return hand_post_claims(post, vendor, product);
}

static bool start_devices(Play *play, Error *error)
{
    const PlaySetup *setup = play->setup;
    const DevicesSetup devices = {.source = setup->device, .listener = hand_post_hear, .user = play->post};
    window_leave_gamepads(play->window, claimed, play->post);
    if (!setup->mapping)
        return true;
    play->devices = devices_start(&devices, error);
    return play->devices != NULL;
}

static bool make_post(Play *play, Error *error)
{
    Mapping mapping;
    mapping_default(&mapping);
    play->post = hand_post_create(play->setup->mapping ? play->setup->mapping : &mapping, window_wake);
    return play->post || error_set(error, "no memory for the hand");
}

static bool start(Play *play, Error *error)
{
    const PlaySetup *setup = play->setup;
    play->window = window_create("slosh", setup->width, setup->height, error);
    if (!play->window)
        return false;
    fprintf(stderr, "renderer: %s\n", window_renderer(play->window));
    gl_debug_install();
    play->refresh = window_refresh(play->window);
    window_size(play->window, &play->width, &play->height);
    if (!gl_renderer_is_software())
        play->timer = gl_timer_create(GL_CLOCK_QUERY);
    if (!make_post(play, error) || !play_open(play, setup->scene, setup->settings, error) ||
        !start_devices(play, error))
        return false;
    play->renderer = renderer_create(&play->open.scene.view, &play->open.scene.world,
                                     (int)fmax(play->width, 1), (int)fmax(play->height, 1), error);
    if (!play->renderer)
        return false;
    const double letters = LETTERS * window_scale(play->window);
    play->shaders_stamp = shader_source_stamp();
    play->text = text_create((float)letters, error);
    play->panel = play->width > 60 * letters; /* beside the fluid, not over it */
    play->ui.ui = play->text ? ui_create((float)letters, error) : NULL;
    play->ui.panel = panel_create();
    return play->ui.ui && (play->ui.panel || error_set(error, "no memory for the panel"));
}

void play_listen(Play *play)
{
    SimulatorStatus *status = &play->status;
    simulator_status(play->open.simulator, status);
    if (status->messages != play->messages) {
        play->messages = status->messages;
        play_error(play, status->message);
    }
    if (status->saves == play->saves)
        return;
    play->saves = status->saves;
    if (status->saved)
        play_tell(play, "%s", status->save_message);
    else
        play_error(play, status->save_message);
}

static bool hand_busy(const Play *play)
{
    bool busy = play->input.drag != PLAY_NONE;
    WindowGamepad pad;
    for (const PlayHeldKey *held = play_held_keys; held->key; held++)
        busy |= play->input.down[held->key];
    return busy || window_gamepad(play->window, &pad);
}

/* A picture when there is something new to see, and no more than the display shows. A solver on the GPU has
   its turns in between. */
static void pause_or_draw(Play *play)
{
    const double work = simulator_work(play->open.simulator, WORK_MS);
    const double now = wall_ms(), due = play->drew_ms + 900 / play->refresh;
    const bool visible = play->width > 0 && play->height > 0;
    const bool wanted = visible && (play->dirty || play_scene_fresh(&play->open) || play_movie_due(play));
    if (wanted && now >= due)
        play_draw(play);
    else if (wanted)
        window_wait(play->window, 1e-3 * fmin(fmax(due - now, 0.1), work));
    else
        window_wait(play->window, 1e-3 * fmin(hand_busy(play) ? HELD_MS : IDLE_MS, work));
}

static bool run(Play *play, Error *error)
{
    bool noticed = false;
    while (!play->quit && !interrupted()) {
        play_events(play);
        play_listen(play);
        play_leave(play, 0);
        follow_scale(play);
        follow_shaders(play);
        if (!follow_size(play, error))
            return false;
        const bool notice = wall_ms() < play->notice_until_ms;
        play->dirty |= noticed && !notice;
        noticed = notice;
        if (!play->quit)
            pause_or_draw(play);
    }
    return true;
}

/* The window goes at once; what is being written is finished behind it. */
static bool finish(Play *play, Error *error)
{
    if (play->shoot) /* asked for in the last moment */
        play_draw(play);
    window_hide(play->window);
    const bool movie = play_movie_end(play);
    return (!play->setup->record || play_save_now(play, play->setup->record, error)) &&
           (movie || error_set(error, "the video was not written"));
}

static void describe(const Play *play, PlayFigures *figures)
{
    const Scene *scene = &play->open.scene;
    const double wall = 1e-3 * (wall_ms() - play->began_ms);
    *figures = (PlayFigures){
        .width = play->width,
        .height = play->height,
        .threads = world_on_gpu(&scene->world) ? 0
                   : scene->world.threads      ? scene->world.threads
                                               : world_processors(),
        .substeps = scene->world.substeps,
        .dt = scene->world.dt,
        .particles = play->particles.count,
        .pictures = play->meter.pictures,
        .scenes_opened = play->scenes_opened,
        .step = play->status.step,
        .time = play->status.time,
        .simulated_s = play->simulated_s + play->status.simulated_s,
        .wall_s = play->began_ms > 0 ? wall : 0,
        .first_picture_ms = play->meter.first_ms,
        .sim_ms = play->status.frames ? play->status.solved_ms / (double)play->status.frames : 0,
        .render_ms = play->rendered ? play->render_ms / (double)play->rendered : 0,
        .latency_median_ms = meter_latency(&play->meter, 0.5),
        .latency_p95_ms = meter_latency(&play->meter, 0.95),
        .latency_events = play->meter.latencies,
        .device_reports = hand_post_reports(play->post),
        .report_median_ms = hand_post_latency(play->post, 0.5),
        .report_p99_ms = hand_post_latency(play->post, 0.99),
        .panel_ms = play->panels ? play->panel_ms / (double)play->panels : 0,
        .display_scale = window_scale(play->window),
        .speed = play->speed,
        .paused = play->paused,
        .fullscreen = window_is_fullscreen(play->window),
        .camera_auto = scene->view.camera_auto,
        .panel = play->panel,
        .help = play->help,
        .gl_errors = gl_debug_errors()};
    if (play->began_ms > 0) {
        figures->real_time_factor = figures->simulated_s / wall;
        figures->pictures_per_second = (double)(play->meter.pictures - 1) / wall;
        figures->frame_ms = 1000 / fmax(figures->pictures_per_second, 1e-3);
        figures->cpus_busy = 1e-3 * (cpu_ms() - play->began_cpu_ms) / wall;
    }
    memcpy(figures->box_position, play->status.hand.position, sizeof figures->box_position);
    memcpy(figures->box_orientation, play->status.hand.orientation, sizeof figures->box_orientation);
    memcpy(figures->camera_from, scene->view.camera.from, sizeof figures->camera_from);
    memcpy(figures->camera_to, scene->view.camera.to, sizeof figures->camera_to);
    snprintf(figures->scene, sizeof figures->scene, "%s", scene->path);
    snprintf(figures->renderer, sizeof figures->renderer, "%s", window_renderer(play->window));
    snprintf(figures->view, sizeof figures->view, "%s", scene->view.kind);
    snprintf(figures->color_by, sizeof figures->color_by, "%s", scalar_name(scene->view.color_by));
    snprintf(figures->colormap, sizeof figures->colormap, "%s", scene->view.colormap);
    snprintf(figures->backend, sizeof figures->backend, "%s", scene->world.backend);
    snprintf(figures->method, sizeof figures->method, "%s", scene->world.method);
}

static void close_all(Play *play)
{
    devices_stop(play->devices);
    if (play->post)
        hand_post_close(play->post);
    play->stuck = !play_scene_close(&play->open, PATIENCE_MS) || !play_leave(play, PATIENCE_MS);
    if (play->stuck) /* in a frame that lasts seconds: the end of the process ends it */
        return;
    hand_post_destroy(play->post);
    panel_destroy(play->ui.panel);
    ui_destroy(play->ui.ui);
    text_destroy(play->text);
    gl_timer_destroy(play->timer);
    renderer_destroy(play->renderer);
    window_destroy(play->window);
}

int play(const PlaySetup *setup, PlayFigures *figures)
{
    Error error = {{0}};
    Play *play = calloc(1, sizeof *play);
    if (!play) {
        fprintf(stderr, "no memory for the window\n");
        return EXIT_FAILED;
    }
    *play = (Play){.setup = setup, .speed = 1, .input = {.drag = PLAY_NONE}};
    interrupt_install();
    const bool started = start(play, &error);
    bool ok = started && run(play, &error);
    if (!ok)
        fprintf(stderr, "%s\n", error.message);
    if (started) {
        simulator_status(play->open.simulator, &play->status);
        describe(play, figures);
        if (!finish(play, &error)) {
            fprintf(stderr, "%s\n", error.message);
            ok = false;
        }
    }
    close_all(play);
    if (!play->stuck)
        free(play);
    return ok ? 0 : EXIT_FAILED;
}
