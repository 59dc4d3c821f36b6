/* Turns window events into requests. */
#include "app/window/play_private.h"
#include "sim/world.h"

/* True for mouse events before the first picture. */
static bool too_early(const Play *play, WindowEventKind kind)
{
    return !play->model.has_particles &&
           (kind == WINDOW_BUTTON || kind == WINDOW_MOVE || kind == WINDOW_WHEEL || kind == WINDOW_FOCUS);
}

static bool overlay_has(const Play *play, const WindowEvent *event)
{
    return play->model.has_particles && !play->input.drag &&
           play_overlay_takes(&play->overlay, &play->model, event);
}

/* The panel for the mouse: the panel below, or for a held handle the chosen view's. */
static int panel_of_mouse(const Play *play)
{
    const double *mouse = play->handle_tool.mouse;
    return play->handle_tool.taken ? play->picture.chosen
                                   : picture_panel_at(&play->picture, mouse[0], mouse[1]);
}

/* Passes the event to the handles, if the mouse is free. */
static bool grip_has(Play *play, const WindowEvent *event, bool free)
{
    const HandleTool before = play->handle_tool;
    if (!play->model.has_particles || !picture_visible(&play->picture))
        return false;
    const PanelViewport look = play_viewport(play, panel_of_mouse(play));
    const bool has = handle_tool_event(&play->handle_tool, &look, event, free && !play->input.drag);
    if (play->handle_tool.taken && play->handle_tool.wall && !before.taken) {
        play->wall_messages = play->model.status.messages;
        request_add(&play->requests,
                    &(Request){.kind = REQUEST_GRAB_CAMERA}); /* the camera stays while the box changes */
    }
    play->picture.over |= play->handle_tool.over != before.over || play->handle_tool.panel != before.panel;
    return has;
}

/* Requests the view under the mouse as the chosen view, before the event's other effects. */
static void choose_view(Play *play, const WindowEvent *event)
{
    const double *mouse = play->handle_tool.mouse;
    const bool acts = (event->kind == WINDOW_BUTTON && event->down) || event->kind == WINDOW_WHEEL;
    if (acts && !play->input.drag && play->model.open.scene.view_count > 0)
        request_add(&play->requests, &(Request){.kind = REQUEST_CHOOSE_VIEW, .amount = {mouse[0], mouse[1]}});
}

static void take_event(Play *play, const WindowEvent *event)
{
    const bool redraw = event->kind == WINDOW_RESIZE || event->kind == WINDOW_EXPOSE;
    const bool held = play->handle_tool.taken;
    play_overlay_event(&play->overlay, event);
    handle_tool_move(&play->handle_tool, event);
    play->picture.dirty |= redraw;
    play->picture.over |= play->touch.on && event->kind == WINDOW_MOVE;
    play->picture.over |= play_overlay_shown(&play->overlay, &play->model);
    play->picture.over |= welcome_event(&play->welcome, event);
    const bool covered = overlay_has(play, event), gripped = grip_has(play, event, !covered);
    play->picture.over |=
        readout_event(&play->readout, play->picture.panels, event, !covered && !play->handle_tool.taken);
    if (too_early(play, event->kind) || covered)
        return;
    if (!held)
        choose_view(play, event);
    if (!gripped)
        input_event(&play->input, event, play_sight(play).height, &play->requests);
}

/* Translates letters and signs to the user's keyboard layout. */
static WindowEvent on_layout(const WindowEvent *event)
{
    WindowEvent own = *event;
    if (own.kind == WINDOW_KEY)
        own.key = key_on_layout(own.key, own.label);
    return own;
}

/* Takes the next due event of the shake script. */
static bool next_shake(Play *play, WindowEvent *event)
{
    return play->shake_seconds > 0 && play->model.has_particles &&
           window_shake_next(&play->shake, wall_ms(), play->picture.width, play->picture.height, event);
}

static bool shaken_enough(const Play *play)
{
    const double began = play->shake.began_ms, seconds = play->shake_seconds;
    return seconds > 0 && began > 0 && wall_ms() - began >= 1000 * seconds;
}

/* Drags a wall; releases a blocked wall, for which the simulator reports the reason once. */
static void drag_wall(Play *play, const PanelViewport *look)
{
    Request request = {.kind = REQUEST_RESIZE_BOX};
    HandleTool *handle_tool = &play->handle_tool;
    if (play->model.status.messages != play->wall_messages)
        handle_tool->taken = false;
    else if (handle_tool_box_size(handle_tool, look, request.amount))
        request_add(&play->requests, &request);
}

/* Applies the mouse's drag of a handle since the last picture. */
static void drag_grip(Play *play)
{
    ViewSetting settings[VIEW_SETTINGS_MAX];
    if (!play->handle_tool.taken || !play->model.has_particles || !picture_visible(&play->picture))
        return;
    const PanelViewport look = play_viewport(play, play->picture.chosen);
    if (play->handle_tool.wall)
        drag_wall(play, &look);
    else
        request_add_settings(&play->requests, settings,
                             handle_tool_settings(&play->handle_tool, &look, settings));
}

/* Presses and releases of fingers and solids use the mouse position of the event, not the present one. */
static void take_and_act(Play *play, const WindowEvent *event)
{
    const bool touches = event->kind == WINDOW_BUTTON && play->touch.on && play->model.has_particles;
    if (touches)
        play_apply_hand(play);
    take_event(play, event);
    requests_execute(play);
    if (touches)
        play_apply_hand(play);
}

void events_process(Play *play)
{
    WindowEvent event;
    const double began = thread_cpu_ms();
    requests_execute(play); /* requests of the panel and the hand during the last picture */
    while (next_shake(play, &event))
        take_and_act(play, &event);
    play->quit |= shaken_enough(play);
    window_poll(play->window);
    while (window_next(play->window, &event)) {
        event = on_layout(&event);
        take_and_act(play, &event);
    }
    drag_grip(play);
    if (play->model.has_particles)
        play_apply_hand(play);
    requests_execute(play);
    frame_times_events(&play->frame_times, thread_cpu_ms() - began);
}

/* Takes events that move the held box or finger. The first event with a request stays in the queue, with all
   later events. */
static void take_moves(Play *play)
{
    WindowEvent event;
    while (next_shake(play, &event))
        take_event(play, &event);
    window_poll(play->window);
    while (window_peek(play->window, &event)) {
        event = on_layout(&event);
        if (!input_only_holds(&play->input, &event))
            break;
        take_event(play, &event);
        window_next(play->window, &event);
    }
}

static void follow_hand(Play *play, bool moves)
{
    const double began = thread_cpu_ms();
    play->looked_ms = wall_ms();
    if (moves)
        take_moves(play);
    if (play->model.has_particles)
        play_apply_hand(play);
    frame_times_events(&play->frame_times, thread_cpu_ms() - began);
}

void events_poll_hand(Play *play)
{
    follow_hand(play, input_holds_box(&play->input) || input_touches(&play->input));
}

void events_process_moves(Play *play)
{
    follow_hand(play, true);
}

void events_between_passes(void *of_play)
{
    static const double APART_MS = 2; /* a look takes about 0.1 ms */
    Play *play = of_play;
    const bool box =
        input_holds_box(&play->input) && (!play->touch.on || play->touch.holds); /* otherwise may press */
    const bool holds = box || (play->touch.holds && input_touches(&play->input)) || play->touch.hold.holds;
    if (holds && wall_ms() - play->looked_ms >= APART_MS)
        events_poll_hand(play);
}
