/* Input of the hand: mouse, keys, gamepad and motion devices. Moves box and finger at once, through the
   simulator's own queue; all other requests go to the window's queue. */
#include "app/window/play_private.h"
#include "render/picking/picking.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double CAMERA_TURN = M_PI / 2, CAMERA_ZOOM = 10; /* radians and steps per second, at rate 1 */

/* Steers the camera with motion devices. */
static void steer(RequestQueue *requests, const double rates[3])
{
    if (rates[0] == 0 && rates[1] == 0 && rates[2] == 0)
        return;
    request_add(requests, &(Request){.kind = REQUEST_STEER_CAMERA,
                                     .amount = {CAMERA_TURN * rates[0], CAMERA_TURN * rates[1],
                                                CAMERA_ZOOM * rates[2]}});
}

static bool differs(const double *a, const double *b, int count)
{
    bool differ = false;
    for (int i = 0; i < count; i++)
        differ |= a[i] != b[i];
    return differ;
}

/* Requests a new picture when the target moves, as needed while time is paused. */
static void follow_target(Play *play, const BoxTarget *target)
{
    play->picture.over |= differs(play->wanted.position, target->position, 3) ||
                          differs(play->wanted.orientation, target->orientation, 4);
    play->wanted = *target;
}

static void take_news(Play *play, const BoxControlNews *news)
{
    follow_target(play, &news->target);
    for (int i = 0; i < news->words_count; i++)
        if (news->words[i].wrong)
            notice_error(&play->notice, news->words[i].text);
        else
            notice_tell(&play->notice, "%s", news->words[i].text);
    for (int i = 0; i < news->sent_count && !play->model.paused; i++)
        frame_times_event(&play->frame_times, news->sent[i].when_ms, news->sent[i].number);
    if (!play->touch.on)
        steer(&play->requests, news->camera);
    for (int i = 0; i < news->action_count; i++)
        request_add_action(&play->requests, news->actions[i]);
}

void play_mouse_ray(const Play *play, const PanelViewport *look, SightRay *ray, double forward[3])
{
    const double *mouse = play->handle_tool.mouse;
    SightRay middle;
    sight_ray(&look->sight, (double[]){mouse[0] - look->at.x, mouse[1] - look->at.y}, ray);
    sight_ray(&look->sight, (double[]){0.5 * look->at.width, 0.5 * look->at.height}, &middle);
    memcpy(forward, middle.along, sizeof middle.along);
}

/* Lifts the pouring point above the fluid, to free space. */
static void lift(const ParticleBuffers *particles, const WorldDef *def, double at[3])
{
    static const double SPACINGS = 2;
    double down[3];
    quat_rotate_inverse(particles->box.orientation, def->gravity, down);
    const double length = sqrt(down[0] * down[0] + down[1] * down[1] + down[2] * down[2]);
    for (int k = 0; k < 3; k++)
        at[k] -= length > 0 ? SPACINGS * def->spacing * down[k] / length : 0;
}

/* True if the backend accepts new particles; otherwise reports the error. */
static bool may_pour(Play *play)
{
    Error error = {{0}};
    WorldDef def = play->model.open.scene.world;
    def.pours = true;
    if (world_can(&def, &error))
        return true;
    notice_error(&play->notice, error.message);
    return false;
}

/* Begins a press: at the fluid under the mouse, otherwise at the depth of the box's centre. */
static void press(Play *play, const SightRay *ray)
{
    TouchTool *tool = &play->touch;
    const FingerWay left = (FingerWay)(play->model.open.scene.touch.way + 1);
    double at[3] = {0, 0.5 * play->model.particles.box_size[1], 0};
    model_take_state(&play->model); /* a solver on the GPU has since written to the drawn buffers */
    const FingerWay way = play->input.drag == &action_pull ? touch_tool_other(left) : left;
    if (play->model.has_particles &&
        pick_position(&play->model.particles, ray, 0.5 * play->model.particles.spacing, at) &&
        way == FINGER_POUR)
        lift(&play->model.particles, &play->model.open.scene.world, at);
    touch_tool_press(tool, way, at);
    tool->spent = way == FINGER_POUR && !may_pour(play);
}

/* Moves the held solid with the mouse. */
static void hold(Play *play, const SightRay *ray, const double forward[3])
{
    SolidDrag *held = &play->touch.hold;
    SolidCommand command;
    const WorldDef *def = &play->model.open.scene.world;
    const double time = play->model.particles.time;
    if (!held->pressed && !solid_drag_press(held, def, time, play->model.particles.floating, ray, forward,
                                            play->input.drag == &action_pull))
        notice_tell(&play->notice, "there is no solid under the mouse; 1 puts a ball there, 2 a box");
    if (!solid_drag_move(held, ray, &command))
        return;
    play->picture.over = true;
    held->holds = model_solid(&play->model, &command);
}

/* Moves the finger with the mouse. Returns the command's number, or 0. */
static uint64_t touch(Play *play)
{
    TouchTool *tool = &play->touch;
    const Scene *scene = &play->model.open.scene;
    Finger finger;
    const unsigned travels = tool->travels;
    touch_tool_travel(tool, play->model.travels, play->model.last_script == SCRIPT_PLAYS);
    if (!input_touches(&play->input) || !picture_visible(&play->picture)) {
        touch_tool_release(tool, play->model.status.timeline.rewound);
        solid_drag_release(&tool->hold);
    } else if (renderer_is_flat(panels_renderer(play->picture.panels, play->picture.chosen))) {
        if (!tool->spent)
            notice_tell(&play->notice, "a flat picture has no depth to touch; use another view");
        tool->spent = true;
    } else {
        const PanelViewport look = play_viewport(play, play->picture.chosen);
        SightRay ray;
        double forward[3];
        play_mouse_ray(play, &look, &ray, forward);
        tool->hold.holds &= travels == tool->travels;
        if (scene->touch.way == TOUCH_TOOL_SOLIDS) {
            hold(play, &ray, forward);
        } else {
            if (!tool->holds)
                press(play, &ray);
            touch_tool_move(tool, &ray, forward, scene->world.dimensions);
        }
    }
    TouchDef def = scene->touch;
    if (def.fluid >= scene->world.fluid_count)
        def.fluid = scene->world.fluid_count - 1;
    def.strength *= tool->holds ? play->input.pressed : 1;
    if (!touch_tool_finger(tool, &def, scene->world.spacing, &finger))
        return 0;
    play->picture.over = true;
    return model_touch(&play->model, &finger);
}

/* The ray of the mouse in the chosen view; false, with a message, in a flat view. */
static bool looks(Play *play, SightRay *ray)
{
    double forward[3];
    if (!play->model.has_particles || !picture_visible(&play->picture))
        return false;
    if (renderer_is_flat(panels_renderer(play->picture.panels, play->picture.chosen))) {
        notice_tell(&play->notice, "a flat picture has no depth to put a solid in; use another view");
        return false;
    }
    const PanelViewport look = play_viewport(play, play->picture.chosen);
    play_mouse_ray(play, &look, ray, forward);
    return true;
}

/* Half the density of the lightest fluid; 0 where nothing can float. */
static double light(const WorldDef *def)
{
    double least = INFINITY;
    for (int f = 0; f < def->fluid_count; f++)
        least = fmin(least, def->fluids[f].density);
    return def->periodic[0] || def->periodic[1] || def->periodic[2] ? 0 : 0.5 * least;
}

static void tell_put(Notice *notice, bool wished, bool floats)
{
    if (floats)
        notice_tell(notice, "it falls from above the fluid; 0 over it takes it out");
    else
        notice_tell(notice, "a solid is put there, above the fluid; touch: hold moves it (Q)%s",
                    wished ? "; nothing floats in a box with open sides" : "");
}

void play_put_solid(Play *play, int like, bool floats)
{
    static const double OF_RING = 1.0 / 3, LEAST = 1.6; /* of the ring of the touch; spacings */
    const Scene *scene = &play->model.open.scene;
    const double spacing = scene->world.spacing, ring = touch_radius(&scene->touch, FINGER_STIR, spacing);
    SolidCommand command = {.act = SOLID_ACTION_PUT,
                            .like = like,
                            .size = fmax(OF_RING * ring, LEAST * spacing),
                            .at = {0, 0.5 * scene->world.box_size[1], 0},
                            .density = floats ? light(&scene->world) : 0};
    SightRay ray;
    double there[3];
    if (!looks(play, &ray))
        return;
    const int solid = solid_drag_under(&scene->world, play->model.particles.time,
                                       play->model.particles.floating, &ray, there);
    if (like == SOLID_LIKE && solid < 0) {
        notice_tell(&play->notice, "there is no solid under the mouse to be put once more");
        return;
    }
    if (like == SOLID_LIKE) {
        command.like += solid;
        command.density = scene->world.solids[solid].density;
    }
    model_take_state(&play->model); /* as for a press */
    if (solid >= 0)
        memcpy(command.at, there, sizeof there);
    else if (play->model.has_particles)
        pick_position(&play->model.particles, &ray, 0.5 * play->model.particles.spacing, command.at);
    if (model_solid(&play->model, &command))
        tell_put(&play->notice, floats && like != SOLID_LIKE, command.density > 0);
}

void play_remove_solid(Play *play)
{
    const WorldDef *def = &play->model.open.scene.world;
    SightRay ray;
    double there[3];
    if (!looks(play, &ray))
        return;
    const SolidCommand command = {.act = SOLID_ACTION_TAKE,
                                  .solid = solid_drag_under(def, play->model.particles.time,
                                                            play->model.particles.floating, &ray, there)};
    if (command.solid < 0) {
        notice_tell(&play->notice, "there is no solid under the mouse");
    } else if (model_solid(&play->model, &command)) {
        play->touch.hold.holds = false; /* the numbers of solids have changed */
        notice_tell(&play->notice, "the %s is taken out", solid_name(def->solids[command.solid].kind));
    }
}

void play_set_gravity(Play *play, const double gravity[3])
{
    const double *g = gravity, size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    char setting[96];
    if (play->model.open.scene.world.dimensions == 2)
        snprintf(setting, sizeof setting, "gravity=[%.6g, %.6g]", g[0], g[1]);
    else
        snprintf(setting, sizeof setting, "gravity=[%.6g, %.6g, %.6g]", g[0], g[1], g[2]);
    if (model_set(&play->model, setting))
        notice_tell(&play->notice, "gravity: %.3g m/s2, %.0f degrees off down", size,
                    size > 0 ? acos(fmax(-1, fmin(-g[1] / size, 1))) * 180 / M_PI : 0);
    play->picture.dirty = true;
}

void play_tilt_gravity(Play *play, const double amount[2])
{
    const WorldDef *def = &play->model.open.scene.world;
    const CameraSight sight = play_sight(play);
    const Orbit orbit = camera_now(&play->camera, &play->model, &sight);
    double right[3], up[3], away[3], turn[3], tilted[3], q[4] = {0, 0, 0, 1};
    orbit_axes(&orbit, right, up, away);
    const bool plane = def->dimensions == 2;
    for (int k = 0; k < 3; k++)
        turn[k] = plane ? (k == 2 ? -away[2] * amount[0] : 0) : -away[k] * amount[0] + right[k] * amount[1];
    quat_turn(turn, q);
    quat_rotate(q, def->gravity, tilted);
    if (def->gravity[0] == 0 && def->gravity[1] == 0 && def->gravity[2] == 0)
        notice_tell(&play->notice, "there is no gravity to be tilted; the panel gives some");
    else
        play_set_gravity(play, tilted);
}

/* While touching, free sticks move the finger, and triggers press: a gamepad's sticks, and the axes of a
   motion device meant for the camera; `camera`: rates of 1 times their seconds. */
static void follow_pad(Play *play, const WindowGamepad *pad, const double camera[3])
{
    static const double HEIGHTS = 0.7, LONGEST = 0.1, HOLDS_MS = 150; /* picture heights per second; s; ms */
    GamepadFinger *finger = &play->pad;
    const double now = wall_ms(), dt = fmin(1e-3 * (now - finger->looked_ms), LONGEST);
    double move[2] = {camera[0], camera[1]}, press = 0;
    finger->looked_ms = now;
    if (!play->touch.on) {
        finger->until_ms = 0;
        return;
    }
    if (camera[2] != 0)
        *finger = (GamepadFinger){now, camera[2] > 0 ? 1 : -1, now + HOLDS_MS};
    if (now < finger->until_ms)
        press = finger->press;
    if (pad) {
        double stick[2];
        hand_stick(pad->right, stick);
        move[0] += stick[0] * dt;
        move[1] -= stick[1] * dt;
        press += pad->triggers[1] - pad->triggers[0];
    }
    if (move[0] != 0 || move[1] != 0) {
        double *mouse = play->handle_tool.mouse;
        const int width = play->picture.width, height = play->picture.height;
        mouse[0] = fmax(0, fmin(mouse[0] + HEIGHTS * height * move[0], width - 1));
        mouse[1] = fmax(0, fmin(mouse[1] - HEIGHTS * height * move[1], height - 1));
        play->picture.over = true;
    }
    input_press(&play->input, press);
}

void play_apply_hand(Play *play)
{
    const CameraSight sight = play_sight(play);
    const Orbit orbit = camera_now(&play->camera, &play->model, &sight);
    const ParticleBuffers *particles = model_state(&play->model, &play->model.open.scene.view);
    const double metres = orbit_metres_per_pixel(&orbit, particles->box_size, &particles->box, sight.height);
    WindowGamepad pad;
    const bool has_pad = window_gamepad(play->window, &pad);
    HandInput hand = {.dt = 0};
    BoxControlNews news;
    orbit_axes(&orbit, hand.right, hand.up, hand.away);
    const double event_ms =
        input_fill_hand(&play->input, has_pad ? &pad : NULL, metres, &hand, &play->requests);
    const uint64_t number = box_control_update(play->control, &hand, particles->box_size, &news);
    follow_pad(play, has_pad ? &pad : NULL, news.camera);
    const uint64_t touched = touch(play);
    if ((number || touched) && event_ms > 0 && !play->model.paused)
        frame_times_event(&play->frame_times, event_ms, touched ? touched : number);
    take_news(play, &news);
}
