/* From events to commands, the camera and the hand. */
#include "app/play/play_state.h"
#include "render/frame/legend.h"
#include "sim/base/stage.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <math.h>
#include <string.h>

static const double DRAG_TURN = 2 * M_PI; /* radians that a drag over the picture's height turns by */
static const double CAMERA_TURN = M_PI / 2, CAMERA_ZOOM = 10; /* radians, steps in a second, at rate 1 */

/* The camera as it is now, automatic or in the hand. */
static Orbit present_orbit(const Play *play)
{
    const ViewDef *view = &play->open.scene.view;
    const ParticleBuffers *particles = &play->particles;
    const Covered covered = {play_covered_left(play),
                             legend_width_pixels(view, &play->open.scene.world, play->height) / play->width};
    return play->orbiting && !view->camera_auto ? play->orbit
                                                : orbit_begin(view, particles->box_size, &particles->box,
                                                              (double)play->width / play->height, covered);
}

static void take_camera(Play *play)
{
    play->orbit = present_orbit(play);
    play->orbiting = true;
}

static void camera_moved(Play *play)
{
    orbit_apply(&play->orbit, &play->open.scene.view);
    play_view_changed(play);
}

static void hand_event(Play *play, const WindowEvent *event)
{
    if (play->input.hand_event_ms == 0)
        play->input.hand_event_ms = event->when_ms;
}

static PlayCommand drag_of(int button, int modifiers)
{
    if (button == GLFW_MOUSE_BUTTON_RIGHT || button == GLFW_MOUSE_BUTTON_MIDDLE)
        return PLAY_PAN;
    if (button != GLFW_MOUSE_BUTTON_LEFT)
        return PLAY_NONE;
    return modifiers & GLFW_MOD_SHIFT     ? PLAY_MOVE_DRAG
           : modifiers & GLFW_MOD_CONTROL ? PLAY_TURN_DRAG
                                          : PLAY_ORBIT;
}

static void on_button(Play *play, const WindowEvent *event)
{
    PlayInput *input = &play->input;
    if (!event->down && event->button == input->drag_button)
        input->drag = PLAY_NONE;
    if (!event->down || input->drag != PLAY_NONE)
        return;
    input->drag = drag_of(event->button, event->modifiers);
    input->drag_button = event->button;
    memcpy(input->mouse, (double[]){event->x, event->y}, sizeof input->mouse);
    if (input->drag == PLAY_PAN || input->drag == PLAY_ORBIT)
        take_camera(play);
}

static void on_move(Play *play, const WindowEvent *event)
{
    PlayInput *input = &play->input;
    const double right = event->x - input->mouse[0], up = input->mouse[1] - event->y;
    const double per_height = 1.0 / fmax(play->height, 1);
    memcpy(input->mouse, (double[]){event->x, event->y}, sizeof input->mouse);
    switch (input->drag) {
    case PLAY_ORBIT:
        orbit_turn(&play->orbit, DRAG_TURN * right * per_height, DRAG_TURN * up * per_height);
        camera_moved(play);
        break;
    case PLAY_PAN:
        orbit_pan(&play->orbit, right * per_height, up * per_height);
        camera_moved(play);
        break;
    case PLAY_MOVE_DRAG:
        input->move_drag[0] += right;
        input->move_drag[1] += up;
        hand_event(play, event);
        break;
    case PLAY_TURN_DRAG:
        input->turn_drag[0] += DRAG_TURN * right * per_height;
        input->turn_drag[1] += DRAG_TURN * up * per_height;
        hand_event(play, event);
        break;
    default:
        break;
    }
}

static void on_wheel(Play *play, const WindowEvent *event)
{
    take_camera(play);
    orbit_zoom(&play->orbit, event->y);
    camera_moved(play);
}

static bool is_held_key(int key)
{
    for (const PlayHeldKey *held = play_held_keys; held->key; held++)
        if (held->key == key)
            return true;
    return false;
}

static void on_key(Play *play, const WindowEvent *event)
{
    if (event->key < 0 || event->key >= PLAY_KEYS)
        return;
    play->input.down[event->key] = event->down;
    if (is_held_key(event->key) && !event->repeated)
        hand_event(play, event);
    const PlayCommand command = event->down ? play_command_of_key(event->key, event->modifiers) : PLAY_NONE;
    if (command != PLAY_NONE && (!event->repeated || play_command_rows[command].flags & PLAY_REPEATS))
        play_do(play, command);
}

/* Whether a drag or a key has the box. */
static bool holds_box(const PlayInput *input)
{
    bool holds = input->drag == PLAY_MOVE_DRAG || input->drag == PLAY_TURN_DRAG;
    for (const PlayHeldKey *held = play_held_keys; held->key; held++)
        holds |= input->down[held->key];
    return holds;
}

/* What was held is let go: the box stops where it is. */
static void let_go(Play *play)
{
    PlayInput *input = &play->input;
    const bool held = holds_box(input);
    memset(input->down, 0, sizeof input->down);
    memset(input->move_drag, 0, sizeof input->move_drag);
    memset(input->turn_drag, 0, sizeof input->turn_drag);
    input->drag = PLAY_NONE;
    if (!held)
        return;
    simulator_status(play->open.simulator, &play->status);
    hand_post_let_go(play->post, &play->status.hand);
}

/* Before the first picture there is nothing that a mouse could take. */
static bool too_early(const Play *play, WindowEventKind kind)
{
    return !play->has_particles && (kind == WINDOW_BUTTON || kind == WINDOW_MOVE || kind == WINDOW_WHEEL);
}

static void take_event(Play *play, const WindowEvent *event)
{
    Error error = {{0}};
    play_panel_event(play, event);
    if (too_early(play, event->kind))
        return;
    if (play_panel_takes(play, event))
        return;
    switch (event->kind) {
    case WINDOW_KEY:
        on_key(play, event);
        break;
    case WINDOW_BUTTON:
        on_button(play, event);
        break;
    case WINDOW_MOVE:
        on_move(play, event);
        break;
    case WINDOW_WHEEL:
        on_wheel(play, event);
        break;
    case WINDOW_FOCUS:
        if (!event->down && play->has_particles)
            let_go(play);
        break;
    case WINDOW_DROP:
        if (!play_open(play, event->path, NULL, &error))
            play_error(play, error.message);
        break;
    case WINDOW_CLOSE:
        play->quit = true;
        break;
    case WINDOW_RESIZE:
    case WINDOW_EXPOSE:
    case WINDOW_TEXT:
        break;
    }
    play->dirty |= event->kind == WINDOW_RESIZE || event->kind == WINDOW_EXPOSE;
}

/* Letters and signs count as the user's keyboard has them. */
void play_event(Play *play, const WindowEvent *event)
{
    WindowEvent own = *event;
    if (own.kind == WINDOW_KEY)
        own.key = play_key_on_layout(own.key, own.label);
    take_event(play, &own);
}

static int modifiers_of(const bool *down)
{
    const bool shift = down[GLFW_KEY_LEFT_SHIFT] || down[GLFW_KEY_RIGHT_SHIFT];
    const bool control = down[GLFW_KEY_LEFT_CONTROL] || down[GLFW_KEY_RIGHT_CONTROL];
    return (shift ? GLFW_MOD_SHIFT : 0) | (control ? GLFW_MOD_CONTROL : 0);
}

static void add_keys(const PlayInput *input, HandInput *hand)
{
    const int modifiers = modifiers_of(input->down);
    for (const PlayHeldKey *held = play_held_keys; held->key; held++)
        if (input->down[held->key] && held->modifiers == modifiers)
            (held->command == PLAY_MOVE_KEYS ? hand->move_rate : hand->tilt_rate)[held->axis] += held->sign;
}

/* GLFW counts a stick's y downwards. */
static void add_gamepad(Play *play, HandInput *hand)
{
    WindowGamepad pad;
    double left[2], right[2];
    if (!window_gamepad(play->window, &pad)) {
        play->input.pad_buttons = 0;
        return;
    }
    hand_stick(pad.left, left);
    hand_stick(pad.right, right);
    hand->move_offset[0] += left[0];
    hand->move_offset[2] -= left[1];
    hand->tilt_offset[0] += right[0];
    hand->tilt_offset[1] -= right[1];
    const unsigned pressed = pad.buttons & ~play->input.pad_buttons;
    play->input.pad_buttons = pad.buttons;
    for (int button = 0; button <= GLFW_GAMEPAD_BUTTON_LAST; button++)
        if (pressed >> button & 1)
            play_do(play, play_command_of_gamepad(button));
}

/* What motion devices ask of the camera. */
static void move_camera(Play *play, const double rates[3])
{
    if (rates[0] == 0 && rates[1] == 0 && rates[2] == 0)
        return;
    take_camera(play);
    orbit_turn(&play->orbit, CAMERA_TURN * rates[0], CAMERA_TURN * rates[1]);
    orbit_zoom(&play->orbit, CAMERA_ZOOM * rates[2]);
    camera_moved(play);
}

static void take_news(Play *play, const HandNews *news)
{
    for (int i = 0; i < news->words_count; i++)
        if (news->words[i].wrong)
            play_error(play, news->words[i].text);
        else
            play_tell(play, "%s", news->words[i].text);
    for (int i = 0; i < news->sent_count && !play->paused; i++)
        meter_event(&play->meter, news->sent[i].when_ms, news->sent[i].number);
    move_camera(play, news->camera);
    for (int i = 0; i < news->command_count; i++)
        play_do(play, news->commands[i]);
}

/* Sums up what the window's devices say, and tells the simulator when the box shall be elsewhere. */
void play_hand(Play *play)
{
    PlayInput *input = &play->input;
    const Orbit orbit = present_orbit(play);
    const ParticleBuffers *particles = &play->particles;
    const double metres = orbit_metres_per_pixel(&orbit, particles->box_size, &particles->box, play->height);
    HandInput hand = {.dt = 0};
    HandNews news;
    orbit_axes(&orbit, hand.right, hand.up, hand.away);
    for (int k = 0; k < 2; k++) {
        hand.move_drag[k] = metres * input->move_drag[k];
        hand.turn_drag[k] = input->turn_drag[k];
        input->move_drag[k] = input->turn_drag[k] = 0;
    }
    add_keys(input, &hand);
    add_gamepad(play, &hand);
    const uint64_t number = hand_post_look(play->post, &hand, particles->box_size, &news);
    const double event_ms = input->hand_event_ms;
    input->hand_event_ms = 0;
    if (number && event_ms > 0 && !play->paused)
        meter_event(&play->meter, event_ms, number);
    take_news(play, &news);
}

void play_shake(Play *play)
{
    WindowEvent event;
    const double now = wall_ms();
    if (play->setup->shake_seconds <= 0 || !play->has_particles)
        return;
    while (window_shake_next(&play->script, now, play->width, play->height, &event))
        play_event(play, &event);
    if (now - play->script.began_ms >= 1000 * play->setup->shake_seconds)
        play->quit = true;
}

void play_events(Play *play)
{
    WindowEvent event;
    play_shake(play);
    window_poll(play->window);
    while (window_next(play->window, &event))
        play_event(play, &event);
    if (play->has_particles)
        play_hand(play);
}
