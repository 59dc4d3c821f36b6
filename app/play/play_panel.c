/* What the live window shows on its panel, and what comes back. */
#include "app/play/play_state.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

typedef struct EditingKey {
    int glfw;
    unsigned ui;
} EditingKey;

static const EditingKey editing_keys[] = {
    {GLFW_KEY_ENTER, UI_KEY_ENTER},
    {GLFW_KEY_KP_ENTER, UI_KEY_ENTER},
    {GLFW_KEY_ESCAPE, UI_KEY_ESCAPE},
    {GLFW_KEY_BACKSPACE, UI_KEY_BACKSPACE},
    {GLFW_KEY_DELETE, UI_KEY_DELETE},
    {GLFW_KEY_LEFT, UI_KEY_LEFT},
    {GLFW_KEY_RIGHT, UI_KEY_RIGHT},
    {GLFW_KEY_HOME, UI_KEY_HOME},
    {GLFW_KEY_END, UI_KEY_END},
    {GLFW_KEY_TAB, UI_KEY_TAB},
    {GLFW_KEY_A, UI_KEY_A},
    {GLFW_KEY_C, UI_KEY_C},
    {GLFW_KEY_V, UI_KEY_V},
    {GLFW_KEY_X, UI_KEY_X},
    {GLFW_KEY_LEFT_CONTROL, UI_KEY_CTRL},
    {GLFW_KEY_RIGHT_CONTROL, UI_KEY_CTRL},
    {GLFW_KEY_LEFT_SHIFT, UI_KEY_SHIFT},
    {GLFW_KEY_RIGHT_SHIFT, UI_KEY_SHIFT},
};

static double thread_cpu_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

/* A press and its release may come between two pictures: what was down at any time counts. */
static void take_key(PlayUi *ui, const WindowEvent *event)
{
    for (size_t i = 0; i < sizeof editing_keys / sizeof *editing_keys; i++) {
        if (editing_keys[i].glfw != event->key)
            continue;
        ui->keys_down =
            event->down ? ui->keys_down | editing_keys[i].ui : ui->keys_down & ~editing_keys[i].ui;
        ui->input.keys |= ui->keys_down;
    }
}

static void take_button(PlayUi *ui, const WindowEvent *event)
{
    if (event->button < 0 || event->button >= 3)
        return;
    ui->buttons_down[event->button] = event->down;
    ui->input.button[event->button] |= event->down;
}

void play_panel_event(Play *play, const WindowEvent *event)
{
    PlayUi *ui = &play->ui;
    const size_t used = strlen(ui->input.text);
    if (event->kind == WINDOW_BUTTON)
        take_button(ui, event);
    if (event->kind == WINDOW_KEY)
        take_key(ui, event);
    if (event->kind == WINDOW_WHEEL)
        ui->input.wheel += (float)event->y;
    if (event->kind == WINDOW_TEXT && event->codepoint < 128 && used + 1 < sizeof ui->input.text)
        ui->input.text[used] = (char)event->codepoint;
    if (event->kind == WINDOW_MOVE || event->kind == WINDOW_BUTTON) {
        ui->input.mouse[0] = (float)event->x;
        ui->input.mouse[1] = (float)event->y;
    }
    play->dirty |= play->panel || play->help;
}

bool play_panel_takes(const Play *play, const WindowEvent *event)
{
    const PlayUi *ui = &play->ui;
    if ((!play->panel && !play->help) || !play->has_particles || play->input.drag != PLAY_NONE)
        return false;
    switch (event->kind) {
    case WINDOW_BUTTON:
        return event->down && ui_covers(ui->ui, (float)event->x, (float)event->y);
    case WINDOW_MOVE:
        return ui_wants_mouse(ui->ui);
    case WINDOW_WHEEL:
        return ui_covers(ui->ui, ui->input.mouse[0], ui->input.mouse[1]);
    case WINDOW_KEY:
        return event->down && ui_wants_keys(ui->ui);
    default:
        return false;
    }
}

static void warn(PlayUi *ui, const char *words)
{
    if (ui->warning_count < (int)(sizeof ui->warnings / sizeof *ui->warnings))
        ui->warnings[ui->warning_count++] = words;
}

static void find_warnings(Play *play)
{
    const SimulatorStatus *status = &play->status;
    const bool runs = !play->paused && !status->failed && status->frames > 50;
    play->ui.warning_count = 0;
    if (status->failed)
        warn(&play->ui, "The simulation has stopped; reset begins anew.");
    if (runs && status->realtime && status->real_time_factor > 0 &&
        status->real_time_factor < 0.9 * play->speed)
        warn(&play->ui,
             "The solver does not keep up with the clock: fewer particles or substeps, or a lower speed.");
    if (runs && play->meter.pictures > 60 && play->meter.pictures_per_second < 20)
        warn(&play->ui, "Pictures are slow: a smaller window or fewer particles.");
    if (status->lost > 0) {
        snprintf(play->ui.lost, sizeof play->ui.lost, "%zu particle%s no place in the grid.", status->lost,
                 status->lost == 1 ? " finds" : "s find");
        warn(&play->ui, play->ui.lost);
    }
    for (int i = 0; i < play->open.notes.count; i++)
        warn(&play->ui, play->open.notes.line[i]);
    if (play->movie.video)
        warn(&play->ui, "A video is being recorded.");
}

static void collect(Play *play, float pictures[METER_HISTORY], PanelData *data)
{
    const ViewDef *view = &play->open.scene.view;
    const SimulatorStatus *status = &play->status;
    find_warnings(play);
    play->ui.device_count = hand_post_devices(play->post, play->ui.devices);
    world_def_at(&play->open.scene.world, play->particles.time); /* what tables say now */
    *data = (PanelData){.scene = &play->open.scene,
                        .render_stages_known = play->timer != NULL,
                        .render_ms = play->last_render_ms,
                        .frame_history = pictures,
                        .step_history = status->history,
                        .frame_count = meter_history(&play->meter, pictures),
                        .step_count = status->history_count,
                        .gauges = status->gauges,
                        .gauge_count = status->gauge_count,
                        .particles = play->particles.count,
                        .time = play->particles.time,
                        .dt = status->dt,
                        .limit = status->limit,
                        .real_time_factor = status->real_time_factor,
                        .speed = play->speed,
                        .pictures_per_second = play->meter.pictures_per_second,
                        .paused = play->paused,
                        .realtime = status->realtime,
                        .renderer = window_renderer(play->window),
                        .warnings = play->ui.warnings,
                        .warning_count = play->ui.warning_count,
                        .devices = play->ui.devices,
                        .device_count = play->ui.device_count,
                        .panel_ms = play->panels ? play->panel_ms / (double)play->panels : 0};
    for (int s = 0; s < STAGE_COUNT; s++) {
        const bool render = stage_part((Stage)s) == PART_RENDER;
        const bool on_gpu = render || simulator_here(play->open.simulator);
        const StageTimes *times = on_gpu ? &play->gl_times : &status->stages;
        data->stage_ms[s] = times->ms[s];
        data->stage_ran[s] = times->ran[s];
        data->sim_ms += stage_part((Stage)s) == PART_SIM ? times->ms[s] : 0;
    }
    if (!play->timer && simulator_here(play->open.simulator) && status->history_count > 0)
        data->sim_ms = status->history[status->history_count - 1];
    data->scalar_range[0] = view->range_auto ? play->particles.scalar_min[view->color_by] : view->range[0];
    data->scalar_range[1] = view->range_auto ? play->particles.scalar_max[view->color_by] : view->range[1];
}

/* What is held stays, what has come once has been seen. Whether something was let go, which the next picture
   sees first. */
static bool input_seen(PlayUi *ui)
{
    const bool let_go = memcmp(ui->input.button, ui->buttons_down, sizeof ui->input.button) != 0 ||
                        ui->input.keys != ui->keys_down;
    memcpy(ui->input.button, ui->buttons_down, sizeof ui->input.button);
    ui->input.keys = ui->keys_down;
    ui->input.wheel = 0;
    memset(ui->input.text, 0, sizeof ui->input.text);
    ui->input.changed = false;
    return let_go;
}

double play_covered_left(const Play *play)
{
    const double part = play->panel ? panel_width(play->ui.ui, play->width) / fmax(play->width, 1) : 0;
    return part < 0.5 ? part : 0;
}

/* Bars of a motion device are live, as often as an eye can tell. */
static void follow_devices(Play *play, double now)
{
    static const double BARS_MS = 50;
    const uint64_t reports = hand_post_reports(play->post);
    if (reports == play->reports_shown || now < play->bars_ms + BARS_MS)
        return;
    play->ui.input.changed = true;
    play->reports_shown = reports;
    play->bars_ms = now;
}

void play_panel_draw(Play *play)
{
    PlayUi *ui = &play->ui;
    PanelEvents events = {.command = PLAY_NONE};
    float pictures[METER_HISTORY];
    PanelData data;
    const double began = thread_cpu_ms(), now = wall_ms();
    const int shown = play->panel + 2 * play->help;
    simulator_watch(play->open.simulator, play->panel && ui->watches);
    if (!shown)
        return;
    follow_devices(play, now);
    ui->input.dt = 1e-3 * fmin(now - ui->drawn_ms, 1000);
    ui->input.changed |= shown != ui->shown;
    ui->drawn_ms = now;
    ui->shown = shown;
    if (ui_begin(ui->ui, play->width, play->height, &ui->input)) {
        collect(play, pictures, &data);
        if (play->panel)
            panel_draw(ui->panel, ui->ui, play->width, play->height, &data, &events);
        ui->watches = events.watches;
        if (play->help)
            panel_help_draw(ui->ui, play->width, play->height);
        play->dirty |= input_seen(ui);
    }
    ui_end(ui->ui);
    play->panel_ms += thread_cpu_ms() - began;
    play->panels++;
    for (int i = 0; i < events.setting_count; i++)
        play_set(play, events.settings[i]);
    if (events.tuned)
        hand_post_tune(play->post, events.tuned, events.gain, events.dead_zone);
    if (events.command != PLAY_NONE)
        play_do(play, (PlayCommand)events.command);
}
