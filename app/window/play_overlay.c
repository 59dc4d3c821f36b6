#include "app/window/play_private.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool play_overlay_start(PlayOverlay *overlay, float letters, Error *error)
{
    overlay->ui = ui_create(letters, error);
    overlay->widgets = panel_create();
    return overlay->ui && (overlay->widgets || error_set(error, "no memory for the panel"));
}

void play_overlay_end(PlayOverlay *overlay)
{
    scene_browser_close(&overlay->cards);
    panel_destroy(overlay->widgets);
    ui_destroy(overlay->ui);
}

void play_overlay_set_letters(PlayOverlay *overlay, float letters)
{
    Error error = {{0}};
    overlay->input.now.changed |= ui_set_pixels(overlay->ui, letters, &error);
}

void play_overlay_event(PlayOverlay *overlay, const WindowEvent *event)
{
    widget_input_add(&overlay->input, event);
    if (event->kind != WINDOW_MOVE && event->kind != WINDOW_BUTTON)
        return;
    memcpy(overlay->mouse, (float[]){(float)event->x, (float)event->y}, sizeof overlay->mouse);
    overlay->moved_ms = wall_ms();
    if (event->kind == WINDOW_BUTTON && event->button >= 0 && event->button < 32)
        overlay->held =
            event->down ? overlay->held | 1U << event->button : overlay->held & ~(1U << event->button);
}

/* True if the mouse was near the lower edge a moment ago; a mouse leaving the window is not reported. */
static bool mouse_is_near(const PlayOverlay *overlay)
{
    static const float NEAR = 1.5F; /* of the time line's height */
    static const double SOON_MS = 3000;
    const float up = (float)overlay->height - overlay->mouse[1];
    return overlay->height > 0 && up >= 0 && up < NEAR * timeline_height(overlay->ui) &&
           wall_ms() < overlay->moved_ms + SOON_MS;
}

/* True while paused or in the past, with the mouse near, or if always shown. */
static bool shows_timeline(const PlayOverlay *overlay, const PlayModel *model)
{
    const SimulatorHistory *timeline = &model->status.timeline;
    return model->has_particles && timeline->enabled &&
           (overlay->timeline || model->paused || timeline->rewound || overlay->scrubs ||
            mouse_is_near(overlay));
}

/* True if the opener button replaces the panel. */
static bool shows_opener(const PlayOverlay *overlay)
{
    return overlay->opener && !overlay->panel && !overlay->help && !overlay->scenes;
}

bool play_overlay_shown(const PlayOverlay *overlay, const PlayModel *model)
{
    return overlay->panel || shows_opener(overlay) || overlay->help || overlay->scenes ||
           shows_timeline(overlay, model);
}

float play_overlay_covered_below(const PlayOverlay *overlay, const PlayModel *model)
{
    return shows_timeline(overlay, model) ? timeline_height(overlay->ui) : 0;
}

bool play_overlay_takes(const PlayOverlay *overlay, const PlayModel *model, const WindowEvent *event)
{
    if (!play_overlay_shown(overlay, model))
        return false;
    switch (event->kind) {
    case WINDOW_BUTTON:
        return event->down && ui_covers(overlay->ui, (float)event->x, (float)event->y);
    case WINDOW_MOVE: /* as of the last picture: a mouse that has left the widgets is free */
        return overlay->held ? ui_wants_mouse(overlay->ui)
                             : ui_covers(overlay->ui, (float)event->x, (float)event->y);
    case WINDOW_WHEEL:
        return ui_covers(overlay->ui, overlay->mouse[0], overlay->mouse[1]);
    case WINDOW_KEY:
        return event->down && ui_wants_keys(overlay->ui);
    default:
        return false;
    }
}

static void warn(PlayOverlay *overlay, const char *words)
{
    if (overlay->warning_count < (int)(sizeof overlay->warnings / sizeof *overlay->warnings))
        overlay->warnings[overlay->warning_count++] = words;
}

static void find_warnings(PlayOverlay *overlay, const PlayModel *model, const PlayOverlayFacts *facts)
{
    const SimulatorStatus *status = &model->status;
    const FrameTimes *frame_times = facts->frame_times;
    const bool runs = !model->paused && !status->failed && status->frames > 50;
    overlay->warning_count = 0;
    if (status->failed)
        warn(overlay, "The simulation has stopped; reset begins anew.");
    if (runs && status->realtime && status->real_time_factor > 0 &&
        status->real_time_factor < 0.9 * model->speed)
        warn(overlay,
             "The solver does not keep up with the clock: fewer particles or substeps, or a lower speed.");
    if (runs && frame_times->pictures > 60 && frame_times->pictures_per_second < 20)
        warn(overlay, "Pictures are slow: a smaller window or fewer particles.");
    if (status->lost > 0) {
        snprintf(overlay->lost, sizeof overlay->lost, "%zu particle%s no place in the grid.", status->lost,
                 status->lost == 1 ? " finds" : "s find");
        warn(overlay, overlay->lost);
    }
    for (int i = 0; i < model->open.notes.count; i++)
        warn(overlay, model->open.notes.line[i]);
    if (facts->movie)
        warn(overlay, "A video is being recorded.");
}

static void collect_stages(const PlayModel *model, const PlayOverlayFacts *facts, PanelData *data)
{
    const SimulatorStatus *status = &model->status;
    const bool here = model->open.simulator && simulator_on_gpu(model->open.simulator);
    static const StageTimes none;
    for (int s = 0; s < STAGE_COUNT; s++) {
        const bool on_gpu = stage_part((Stage)s) == PART_RENDER || here;
        const StageTimes *gl_times = facts->gl_times ? facts->gl_times : &none;
        const StageTimes *times = on_gpu ? gl_times : &status->stages;
        data->stage_ms[s] = times->ms[s];
        data->stage_ran[s] = times->ran[s];
        data->sim_ms += stage_part((Stage)s) == PART_SIM ? times->ms[s] : 0;
    }
    data->substep_calls = status->calls;
    data->picture_calls = *facts->calls;
    if (!facts->gl_times && here && status->history_count > 0)
        data->sim_ms = status->history[status->history_count - 1];
}

static void collect(PlayOverlay *overlay, PlayModel *model, const PlayOverlayFacts *facts,
                    float pictures[FRAME_TIMES_HISTORY], PanelData *data)
{
    const SimulatorStatus *status = &model->status;
    const ParticleBuffers *particles = &model->particles;
    find_warnings(overlay, model, facts);
    overlay->device_count = box_control_devices(model->control, overlay->devices);
    world_def_at(&model->open.scene.world, particles->time); /* present values of tables */
    *data = (PanelData){.scene = &model->open.scene,
                        .about = facts->about,
                        .recorded = !model->open.source->simulates,
                        .render_stages_known = facts->gl_times != NULL,
                        .render_ms = facts->frame_times->last_drawn_ms,
                        .frame_history = pictures,
                        .step_history = status->history,
                        .frame_count = frame_times_history(facts->frame_times, pictures),
                        .step_count = status->history_count,
                        .gauges = status->gauges,
                        .gauge_count = status->gauge_count,
                        .probes = status->probes,
                        .probe_count = status->probe_count,
                        .closed_gates = model->closed_gates,
                        .box_most =
                            fmax(model->file_scene.world.box_size[0], model->file_scene.world.box_size[1]),
                        .particles = particles->count,
                        .particles_at_start = model->seeded,
                        .particles_wished = overlay->particles,
                        .opened = model->scenes_opened,
                        .time = particles->time,
                        .dt = status->dt,
                        .limit = status->limit,
                        .solved = status->solved,
                        .real_time_factor = status->real_time_factor,
                        .speed = model->speed,
                        .pictures_per_second = facts->frame_times->pictures_per_second,
                        .paused = model->paused,
                        .realtime = status->realtime,
                        .renderer = facts->renderer,
                        .warnings = overlay->warnings,
                        .warning_count = overlay->warning_count,
                        .devices = overlay->devices,
                        .device_count = overlay->device_count,
                        .panel_ms = frame_times_panel_mean(facts->frame_times)};
    memcpy(data->box_wanted, status->resizing ? status->box_wanted : particles->box_size,
           sizeof data->box_wanted);
    for (int k = 0; k < SOLVES_MAX; k++)
        data->iterations += status->solves[k].iterations;
    collect_stages(model, facts, data);
    memcpy(data->scalar_range, facts->range, sizeof facts->range);
    memcpy(data->opacity_range, facts->opacity_range, sizeof facts->opacity_range);
    memcpy(data->size_range, facts->size_range, sizeof facts->size_range);
}

double play_overlay_covered_left(const PlayOverlay *overlay, int width)
{
    const double part = overlay->panel ? panel_width(overlay->ui, width) / fmax(width, 1) : 0;
    return part < 0.6 ? part : 0;
}

/* Redraws the bars of motion devices, as often as visible. */
static void follow_devices(PlayOverlay *overlay, BoxControl *control, double now)
{
    static const double BARS_MS = 50;
    const uint64_t reports = box_control_reports(control);
    if (reports == overlay->reports_shown || now < overlay->bars_ms + BARS_MS)
        return;
    overlay->input.now.changed = true;
    overlay->reports_shown = reports;
    overlay->bars_ms = now;
}

static void queue_events(const PanelEvents *events, RequestQueue *requests)
{
    for (int i = 0; i < events->value_count; i++)
        request_add(requests, &(Request){.kind = REQUEST_VALUE, .value = events->values[i]});
    if (*events->term) {
        Request request = {.kind = REQUEST_SETTING};
        snprintf(request.text, sizeof request.text, "%s", events->term);
        request_add(requests, &request);
    }
    if (events->tuned)
        request_add(requests, &(Request){.kind = REQUEST_TUNE_DEVICE,
                                         .device = events->tuned,
                                         .amount = {events->gain, events->dead_zone}});
    if (events->gated)
        request_add(requests, &(Request){.kind = REQUEST_SET_GATES, .gates = events->closed_gates});
    if (events->sized)
        request_add(requests, &(Request){.kind = REQUEST_RESIZE_BOX,
                                         .amount = {events->size[0], events->size[1], events->size[2]}});
    if (*events->restart) {
        Request request = {.kind = REQUEST_RESTART};
        snprintf(request.text, sizeof request.text, "%s", events->restart);
        request_add(requests, &request);
    }
    if (events->action)
        request_add_action(requests, events->action);
}

/* Requests the new count of particles once after a drag, as the scene restarts. */
static void queue_particles(PlayOverlay *overlay, RequestQueue *requests)
{
    if (overlay->particles > 0 && overlay->held == 0)
        request_add(requests, &(Request){.kind = REQUEST_PARTICLES, .amount = {overlay->particles}});
    overlay->particles = overlay->held ? overlay->particles : 0;
}

/* Played part of a recorded session, 0 .. 1. */
static double script_done(const SimulatorStatus *status)
{
    if (status->script != SCRIPT_PLAYS || status->script_steps == 0)
        return 0;
    return fmin((double)status->step / (double)status->script_steps, 1);
}

static void draw_timeline(PlayOverlay *overlay, const PlayModel *model, const PlayOverlayFacts *facts,
                          RequestQueue *requests)
{
    const SimulatorHistory *timeline = &model->status.timeline;
    const TimelineData data = {.from = timeline->from,
                               .to = timeline->to,
                               .now = model->particles.time,
                               .playing = !model->paused,
                               .done = script_done(&model->status),
                               .grows = model->open.source->simulates};
    TimelineEvents events;
    const float left = overlay->panel ? panel_width(overlay->ui, facts->width) : 0;
    timeline_draw(overlay->ui, facts->width, facts->height, left < 0.6F * (float)facts->width ? left : 0,
                  &data, &events);
    if (events.wants_time && (!overlay->scrubs || events.time != overlay->wished))
        request_add(requests, &(Request){.kind = REQUEST_GO_TO_TIME, .amount = {events.time}});
    overlay->scrubs = events.wants_time;
    overlay->wished = events.time;
    if (events.action)
        request_add_action(requests, events.action);
}

/* Draws the list; a pressed scene opens, and the list closes. */
static void draw_scenes(PlayOverlay *overlay, const PlayModel *model, const PlayOverlayFacts *facts,
                        RequestQueue *requests)
{
    Request request = {.kind = REQUEST_OPEN_SCENE};
    PanelCard *cards = overlay->cards.cards;
    for (int i = 0; i < overlay->cards.count; i++)
        cards[i].lit = strcmp(cards[i].path, model->open.scene.path) == 0;
    const int pressed =
        panel_scenes_draw(overlay->ui, facts->width, facts->height, cards, overlay->cards.count);
    if (pressed < 0)
        return;
    snprintf(request.text, sizeof request.text, "%s", cards[pressed].path);
    request_add(requests, &request);
    request_add_action(requests, &action_scenes);
}

bool play_overlay_toggle_scenes(PlayOverlay *overlay, const PlayModel *model, Error *error)
{
    overlay->scenes = !overlay->scenes;
    overlay->help &= !overlay->scenes;
    if (overlay->scenes)
        return scene_browser_open(&overlay->cards, model->open.scene.path, error);
    scene_browser_close(&overlay->cards);
    return true;
}

bool play_overlay_poll(PlayOverlay *overlay)
{
    const bool more = overlay->scenes && scene_browser_poll(&overlay->cards);
    overlay->input.now.changed |= more;
    return more;
}

/* Height of titles, which views side by side may have in that corner. */
static float title_height(const PlayOverlay *overlay, const PlayModel *model)
{
    static const float TITLE_EM = 5;
    return model->open.scene.view_count > 0 ? TITLE_EM * ui_pixels(overlay->ui) : 0;
}

/* Draws the widgets, if any has changed. */
static void draw_widgets(PlayOverlay *overlay, PlayModel *model, const PlayOverlayFacts *facts,
                         RequestQueue *requests)
{
    PanelEvents events = {.action = NULL};
    float pictures[FRAME_TIMES_HISTORY];
    PanelData data;
    if (!ui_begin(overlay->ui, facts->width, facts->height, &overlay->input.now))
        return;
    collect(overlay, model, facts, pictures, &data);
    if (overlay->panel)
        panel_draw(overlay->widgets, overlay->ui, facts->width, facts->height, &data, &events);
    overlay->watches = events.watches;
    overlay->watches_probes = events.watches_probes;
    if (overlay->help)
        panel_help_draw(overlay->ui, facts->width, facts->height);
    if (overlay->scenes)
        draw_scenes(overlay, model, facts, requests);
    if (shows_opener(overlay) && panel_opener_draw(overlay->ui, title_height(overlay, model)))
        events.action = &action_panel;
    queue_events(&events, requests);
    overlay->particles = events.particles > 0 ? events.particles : overlay->particles;
    if (shows_timeline(overlay, model))
        draw_timeline(overlay, model, facts, requests);
    overlay->input.now.changed = false;
}

bool play_overlay_draw(PlayOverlay *overlay, PlayModel *model, const PlayOverlayFacts *facts,
                       RequestQueue *requests)
{
    const double now = wall_ms();
    const bool timeline = shows_timeline(overlay, model);
    const int shown =
        overlay->panel + 2 * overlay->help + 4 * timeline + 8 * overlay->scenes + 16 * shows_opener(overlay);
    overlay->height = facts->height;
    if (model->open.simulator)
        simulator_watch(model->open.simulator, overlay->panel && overlay->watches,
                        overlay->panel && overlay->watches_probes);
    if (!shown) {
        widget_input_skip(&overlay->input);
        return false;
    }
    follow_devices(overlay, model->control, now);
    overlay->input.now.dt = 1e-3 * fmin(now - overlay->drawn_ms, 1000);
    overlay->input.now.changed |= shown != overlay->shown;
    overlay->input.now.changed |= timeline && model->paused && model->particles.time != overlay->time;
    overlay->time = model->particles.time;
    overlay->drawn_ms = now;
    overlay->shown = shown;
    widget_input_next(&overlay->input);
    draw_widgets(overlay, model, facts, requests);
    queue_particles(overlay, requests);
    ui_end(overlay->ui);
    return overlay->input.count > 0 || ui_needs_redraw(overlay->ui);
}
