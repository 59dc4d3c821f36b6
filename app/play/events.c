/* Turns window events into requests. */
#include "app/play/parts.h"
#include "sim/base/stage.h"

/* True for mouse events before the first picture. */
static bool too_early(const Play *play, WindowEventKind kind)
{
    return !play->model.has_particles &&
           (kind == WINDOW_BUTTON || kind == WINDOW_MOVE || kind == WINDOW_WHEEL || kind == WINDOW_FOCUS);
}

static bool overlay_has(const Play *play, const WindowEvent *event)
{
    return play->model.has_particles && play->input.drag == PLAY_NONE &&
           overlay_takes(&play->overlay, &play->model, event);
}

/* The panel for the mouse: the panel below, or for a held handle the chosen view's. */
static int panel_of_mouse(const Play *play)
{
    const double *mouse = play->grip.mouse;
    return play->grip.taken ? play->picture.chosen : picture_panel_at(&play->picture, mouse[0], mouse[1]);
}

/* Passes the event to the handles, if the mouse is free. */
static bool grip_has(Play *play, const WindowEvent *event, bool free)
{
    const Grip before = play->grip;
    if (!play->model.has_particles || !picture_visible(&play->picture))
        return false;
    const Look look = play_look(play, panel_of_mouse(play));
    const bool has = grip_event(&play->grip, &look, event, free && play->input.drag == PLAY_NONE);
    if (play->grip.taken && play->grip.wall && !before.taken) {
        play->wall_messages = play->model.status.messages;
        ask_add(&play->asks, &(Ask){.kind = ASK_GRAB}); /* the camera stays while the box changes */
    }
    play->picture.over |= play->grip.over != before.over || play->grip.panel != before.panel;
    return has;
}

/* Requests the view under the mouse as the chosen view, before the event's other effects. */
static void choose_view(Play *play, const WindowEvent *event)
{
    const double *mouse = play->grip.mouse;
    const bool acts = (event->kind == WINDOW_BUTTON && event->down) || event->kind == WINDOW_WHEEL;
    if (acts && play->input.drag == PLAY_NONE && play->model.open.scene.view_count > 0)
        ask_add(&play->asks, &(Ask){.kind = ASK_CHOOSE, .amount = {mouse[0], mouse[1]}});
}

static void take_event(Play *play, const WindowEvent *event)
{
    const bool redraw = event->kind == WINDOW_RESIZE || event->kind == WINDOW_EXPOSE;
    const bool held = play->grip.taken;
    overlay_event(&play->overlay, event);
    grip_follow(&play->grip, event);
    play->picture.dirty |= redraw;
    play->picture.over |= play->touch.on && event->kind == WINDOW_MOVE;
    play->picture.over |= overlay_shown(&play->overlay, &play->model);
    const bool covered = overlay_has(play, event), gripped = grip_has(play, event, !covered);
    play->picture.over |=
        readout_event(&play->readout, play->picture.panels, event, !covered && !play->grip.taken);
    if (too_early(play, event->kind) || covered)
        return;
    if (!held)
        choose_view(play, event);
    if (!gripped)
        input_take(&play->input, event, play_sight(play).height, &play->asks);
}

/* Translates letters and signs to the user's keyboard layout. */
static WindowEvent on_layout(const WindowEvent *event)
{
    WindowEvent own = *event;
    if (own.kind == WINDOW_KEY)
        own.key = play_key_on_layout(own.key, own.label);
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
static void drag_wall(Play *play, const Look *look)
{
    Ask ask = {.kind = ASK_SIZE};
    Grip *grip = &play->grip;
    if (play->model.status.messages != play->wall_messages)
        grip->taken = false;
    else if (grip_size(grip, look, ask.amount))
        ask_add(&play->asks, &ask);
}

/* Applies the mouse's drag of a handle since the last picture. */
static void drag_grip(Play *play)
{
    ViewSetting settings[VIEW_SETTINGS_MAX];
    if (!play->grip.taken || !play->model.has_particles || !picture_visible(&play->picture))
        return;
    const Look look = play_look(play, play->picture.chosen);
    if (play->grip.wall)
        drag_wall(play, &look);
    else
        ask_settings(&play->asks, settings, grip_settings(&play->grip, &look, settings));
}

/* Presses and releases of fingers and solids use the mouse position of the event, not the present one. */
static void take_and_act(Play *play, const WindowEvent *event)
{
    const bool touches = event->kind == WINDOW_BUTTON && play->touch.on && play->model.has_particles;
    if (touches)
        hands_look(play);
    take_event(play, event);
    act_all(play);
    if (touches)
        hands_look(play);
}

void events_take(Play *play)
{
    WindowEvent event;
    const double began = meter_thread_cpu_ms();
    act_all(play); /* requests of the panel and the hand during the last picture */
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
        hands_look(play);
    act_all(play);
    meter_events(&play->meter, meter_thread_cpu_ms() - began);
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
    const double began = meter_thread_cpu_ms();
    play->looked_ms = wall_ms();
    if (moves)
        take_moves(play);
    if (play->model.has_particles)
        hands_look(play);
    meter_events(&play->meter, meter_thread_cpu_ms() - began);
}

void events_follow_hand(Play *play)
{
    follow_hand(play, input_holds_box(&play->input) || input_touches(&play->input));
}

void events_take_moves(Play *play)
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
        events_follow_hand(play);
}
