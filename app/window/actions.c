/* Executes the requests to the window, between two pictures. */
#include "app/input/touch.h"
#include "app/window/model.h"
#include "app/window/play_private.h"
#include "render/frame/frame.h"
#include "render/frame/view.h"
#include "render/picking/picking.h"
#include "slosh/world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void view_changed(Play *play)
{
    Scene *scene = &play->model.open.scene;
    model_follow_views(&play->model);
    views_follow(&play->views, scene);
    picture_set_view(&play->picture, &play->model.open, views_panel(&play->views, scene), &play->notice);
}

static void title_window(const Play *play)
{
    char title[192];
    snprintf(title, sizeof title, "%s - slosh", play->model.open.scene.title);
    window_title(play->window, title);
}

/* Resets hand, touch, camera and picture after a new scene was opened. */
static void follow_scene(Play *play)
{
    input_begin(&play->input);
    handle_tool_begin(&play->handle_tool);
    readout_begin(&play->readout);
    play->wanted = hand_at_rest().told;
    touch_tool_release(&play->touch, false);
    touch_tool_reset(&play->touch);
    play->touch.travels = play->model.travels;
    play->outlined = false;
    play->camera.held = false;
    views_open(&play->views, &play->model.open.scene, &play->model.file_scene);
    frame_times_forget_events(&play->frame_times);
    play->picture.dirty = true;
    play->overlay.timeline |= !play->model.open.source->simulates || play->model.open.session;
    title_window(play);
    if (play->picture.panels)
        view_changed(play);
}

bool actions_open_scene(Play *play, const char *scene, const SceneSettings *settings, Error *error)
{
    const bool opened = model_open(&play->model, scene, settings, error);
    if (opened)
        follow_scene(play);
    return opened;
}

void actions_scene_changed(Play *play, bool begun, bool views)
{
    Scene *scene = &play->model.open.scene;
    play->picture.dirty = true;
    if (begun) {
        follow_scene(play);
        return;
    }
    title_window(play);
    if (!views)
        return;
    views_open(&play->views, scene, &play->model.file_scene);
    play->camera.held = false;
    handle_tool_begin(&play->handle_tool);
    view_changed(play);
}

/* Restarts the scene with a new count of particles, or with a preset. */
static void restart_scene(Play *play, const char *setting, double particles)
{
    Error error = {{0}};
    SettingList more = {.count = 0};
    if (setting)
        setting_list_add(&more, setting);
    if (scene_restart(&play->model, &more, (size_t)particles, &error))
        actions_scene_changed(play, true, true);
    else
        notice_error(&play->notice, error.message);
    setting_list_free(&more);
}

static void open_file(Play *play, const char *path)
{
    Error error = {{0}};
    if (!actions_open_scene(play, path, NULL, &error))
        notice_error(&play->notice, error.message);
}

static void open_neighbour(Play *play, int by)
{
    if (model_open_neighbour(&play->model, by))
        follow_scene(play);
}

/* Chooses the next scalar; the file's range applies only to the file's scalar. */
static void next_scalar(Play *play)
{
    PlayScene *open = &play->model.open;
    ViewDef *view = &open->scene.view;
    const ViewDef *file = &play->model.file_scene.view;
    Error none;
    view->color_by = view_color_by(view);
    do
        view->color_by = (Scalar)((view->color_by + 1) % SCALAR_COUNT);
    while (view->color_by != SCALAR_FLUID && !model_has(&play->model, view, &none));
    const Scalar ranged = file->color_by == SCALAR_COUNT ? SCALAR_SPEED : file->color_by;
    view->range_auto = view->color_by == ranged ? file->range_auto : true;
    memcpy(view->range, file->range, sizeof view->range);
    view_changed(play);
    notice_tell(&play->notice, "coloured by %s", scalar_name(view_color_by(view)));
}

/* Chooses the next view able to show these states, in a circle. */
static void next_view(Play *play)
{
    ViewDef *view = &play->model.open.scene.view, tried = *view;
    int at = 0, count = 0;
    Error none;
    while (view_at(count))
        count++;
    while (at + 1 < count && strcmp(view_at(at)->name, view->kind) != 0)
        at++;
    for (int i = 1; i < count; i++) {
        const ViewKind *next = view_at((at + i) % count);
        Action action = {.kind = ACTION_SETTING};
        snprintf(tried.kind, sizeof tried.kind, "%s", next->name);
        if (!model_has(&play->model, &tried, &none))
            continue;
        snprintf(action.text, sizeof action.text, "view.kind=%s", next->name);
        action_add(&play->actions, &action);
        notice_tell(&play->notice, "view %s: %s", next->name, next->help);
        return;
    }
}

static void next_colormap(Play *play)
{
    ViewDef *view = &play->model.open.scene.view;
    const char *shown = view_colormap(view);
    int i = 0;
    while (colormap_list[i] && strcmp(colormap_list[i], shown) != 0)
        i++;
    const char *next = colormap_list[i] && colormap_list[i + 1] ? colormap_list[i + 1] : colormap_list[0];
    snprintf(view->colormap, sizeof view->colormap, "%s", next);
    view_changed(play);
    notice_tell(&play->notice, "colours %s", next);
}

static void cycle_views(Play *play)
{
    Scene *scene = &play->model.open.scene;
    views_cycle(&play->views, scene);
    play->camera.held = false;
    handle_tool_begin(&play->handle_tool);
    view_changed(play);
    notice_tell(&play->notice, scene->view_count > 0 ? "%d views: click into one to choose it" : "one view",
                scene->view_count);
}

static void link_cameras(Play *play)
{
    views_link(&play->views, &play->model.open.scene);
    view_changed(play);
    notice_tell(&play->notice,
                play->views.free ? "each view has a camera of its own" : "cameras move together");
}

static void choose_view(Play *play, const double at[2])
{
    PlayModel *model = &play->model;
    const int panel = picture_panel_at(&play->picture, at[0], at[1]);
    if (!views_choose(&play->views, &model->open.scene, &model->file_scene, panel))
        return;
    play->camera.held = false;
    view_changed(play);
}

static void show_scenes(Play *play)
{
    Error error = {{0}};
    if (!play_overlay_toggle_scenes(&play->overlay, &play->model, &error))
        notice_error(&play->notice, error.message);
}

/* True if the session is saved, or the user asks a second time. */
static bool may_close(Play *play)
{
    static const double PATIENCE_MS = 4000; /* the question is shown for this time */
    const double now = wall_ms();
    const bool lost = play->model.status.unsaved && !play->model.record;
    if (!lost || (play->close_asked_ms > 0 && now < play->close_asked_ms + PATIENCE_MS))
        return true;
    play->close_asked_ms = now;
    notice_tell(&play->notice,
                "what you did is not saved: Ctrl+S saves it, Escape once more closes the window");
    return false;
}

/* Tells the user the functions of the buttons. */
static void tell_touch(Play *play)
{
    const FingerWay left = (FingerWay)(play->model.open.scene.touch.way + 1);
    if (play->model.open.scene.touch.way == TOUCH_TOOL_SOLIDS) {
        notice_tell(&play->notice, "touch: left drag moves a solid, right drag turns it; hold");
        return;
    }
    notice_tell(&play->notice, "touch: left drag: %s, right drag: %s, wheel: size, Shift + wheel: strength",
                finger_way_name(left), finger_way_name(touch_tool_other(left)));
}

/* The fluid to pour. */
static const FluidDef *poured(const Play *play)
{
    const Scene *scene = &play->model.open.scene;
    const int last = scene->world.fluid_count - 1;
    return &scene->world.fluids[scene->touch.fluid < last ? scene->touch.fluid : last];
}

static void turn_touch(Play *play, bool on)
{
    play->touch.on = play->input.touching = on;
    if (on)
        tell_touch(play);
    else
        notice_tell(&play->notice, "left drag turns the camera");
}

static void next_touch_way(Play *play)
{
    char setting[64];
    int next = play->model.open.scene.touch.way + 1;
    next = touch_ways[next].name ? next : 0;
    snprintf(setting, sizeof setting, "touch.way=%s", touch_ways[next].name);
    if (!model_set(&play->model, setting))
        return;
    if (play->touch.on)
        tell_touch(play);
    else
        turn_touch(play, true);
}

/* A press of the key chooses pouring, the next press the next fluid. */
static void next_touch_fluid(Play *play)
{
    const Scene *scene = &play->model.open.scene;
    const int fluids = scene->world.fluid_count, present = (int)(poured(play) - scene->world.fluids);
    char setting[64];
    if (scene->touch.way + 1 == FINGER_POUR)
        snprintf(setting, sizeof setting, "touch.fluid=%d", (present + 1) % fluids);
    else
        snprintf(setting, sizeof setting, "touch.way=%s", finger_way_name(FINGER_POUR));
    if (!model_set(&play->model, setting))
        return;
    if (!play->touch.on)
        turn_touch(play, true);
    notice_tell(&play->notice, "touch: left drag pours %s", poured(play)->name);
}

/* Changes radius and strength by notches of the wheel. */
static void change_touch(Play *play, const double amount[2])
{
    const TouchDef *touch = &play->model.open.scene.touch;
    char setting[64];
    if (amount[0] != 0) {
        snprintf(setting, sizeof setting, "touch.radius=%.3g",
                 touch_tool_notches(touch->radius, amount[0], 1, 100));
        if (model_set(&play->model, setting))
            notice_tell(&play->notice, "touch: radius %.3g spacings", touch->radius);
    }
    if (amount[1] != 0) {
        snprintf(setting, sizeof setting, "touch.strength=%.3g",
                 touch_tool_notches(touch->strength, amount[1], 0.01, 100));
        if (model_set(&play->model, setting))
            notice_tell(&play->notice, "touch: strength %.3g", touch->strength);
    }
    play->picture.dirty = true;
}

static void quit_or_close(Play *play)
{
    if (play->overlay.help)
        play->overlay.help = false;
    else if (play->overlay.scenes)
        show_scenes(play);
    else if (play->touch.on)
        turn_touch(play, false);
    else
        play->quit = may_close(play);
}

static void step_plane(Play *play, PlayCommand command)
{
    ViewSetting settings[VIEW_SETTINGS_MAX];
    if (!play->model.has_particles)
        return;
    const ViewStep step = (ViewStep)(VIEW_STEP_BACK + (command - PLAY_PLANE_BACK));
    action_add_settings(&play->actions, settings, handle_tool_step(&play->model, step, settings));
}

/* Follows the particle under the mouse; the test uses the views' balls of half a spacing. */
static void choose_trail(Play *play)
{
    ViewSetting settings[VIEW_SETTINGS_MAX];
    SightRay ray;
    char words[160];
    uint32_t id;
    if (!play->model.has_particles || !play->picture.panels)
        return;
    const double *mouse = play->handle_tool.mouse;
    const PanelViewport look = play_viewport(play, picture_panel_at(&play->picture, mouse[0], mouse[1]));
    model_take_state(&play->model); /* a solver on the GPU has since written to the drawn buffers */
    if (!play->model.has_particles)
        return;
    sight_ray(&look.sight, (double[]){mouse[0] - look.at.x, mouse[1] - look.at.y}, &ray);
    if (!look.particles->id.buffer) {
        notice_tell(&play->notice,
                    "what this view shows has no ids here, and nobody knows which particle is which");
        return;
    }
    if (!pick_particle(look.particles, &ray, 0.5 * look.particles->spacing, &id)) {
        notice_tell(&play->notice, "there is no particle under the mouse");
        return;
    }
    choose_view(play, mouse);
    const int count = overlays_choose(&play->model.open.scene.view, id, settings, words);
    action_add_settings(&play->actions, settings, count);
    notice_tell(&play->notice, "%s", words);
}

static void take_walls(Play *play)
{
    const WorldDef *def = &play->model.open.scene.world;
    Handle handles[WALL_HANDLES_MAX];
    HandleTool *handle_tool = &play->handle_tool;
    handle_tool->walls =
        !handle_tool->walls && wall_handles(def->box_size, def->periodic, def->dimensions, handles) > 0;
    handle_tool->taken &= !handle_tool->wall;
    handle_tool->over = handle_tool->taken ? handle_tool->over : 0;
    play->picture.over = true;
    if (handle_tool->walls)
        notice_tell(&play->notice,
                    "drag an arrow: its wall goes with the mouse, the one across from it, too");
    else
        notice_tell(&play->notice, "the walls %s",
                    wall_handles(def->box_size, def->periodic, def->dimensions, handles) > 0
                        ? "have no handles any more"
                        : "of this box are open: it keeps its size");
}

static const double BOX_NOTCH = 1.05;

/* Scales all sides except periodic ones, starting from the target size. */
static void scale_box(Play *play, double factor)
{
    const SimulatorStatus *status = &play->model.status;
    const WorldDef *def = &play->model.open.scene.world;
    double size[3];
    memcpy(size, status->resizing ? status->box_wanted : def->box_size, sizeof size);
    for (int k = 0; k < def->dimensions; k++)
        size[k] *= def->periodic[k] ? 1 : factor;
    if (model_resize(&play->model, size))
        notice_tell(&play->notice,
                    def->dimensions == 2 ? "the box: %.3g x %.3g m" : "the box: %.3g x %.3g x %.3g m",
                    size[0], size[1], size[2]);
}

/* True, with a message, if the command needs a simulation and there is none. */
static bool needs_simulation(Play *play, PlayCommand command)
{
    const PlayCommandRow *row = &play_command_rows[command];
    if (!(row->flags & PLAY_SIMULATED) || play->model.open.source->simulates)
        return false;
    notice_tell(&play->notice, "%s: nothing is simulated, a recorded run is shown", row->name);
    return true;
}

static void do_command(Play *play, PlayCommand command, bool held)
{
    PlayModel *model = &play->model;
    play->picture.dirty = true;
    if (needs_simulation(play, command))
        return;
    switch (command) {
    case PLAY_PAUSE:
        model_pause(model, !model->paused);
        break;
    case PLAY_STEP:
        model_step(model, held);
        break;
    case PLAY_STEP_BACK:
        model_step_back(model, held);
        break;
    case PLAY_BACK:
        model_go_by(model, -1);
        break;
    case PLAY_AHEAD:
        model_go_by(model, 1);
        break;
    case PLAY_NEWEST:
        model_go_to(model, INFINITY);
        break;
    case PLAY_TIMELINE:
        play->overlay.timeline = !play->overlay.timeline;
        break;
    case PLAY_LOOP:
        model_loop(model);
        break;
    case PLAY_RESET:
        model_reset(model);
        touch_tool_reset(&play->touch);
        break;
    case PLAY_SLOWER:
        model_set_speed(model, 0.5);
        break;
    case PLAY_FASTER:
        model_set_speed(model, 2);
        break;
    case PLAY_NEXT_SCENE:
        open_neighbour(play, 1);
        break;
    case PLAY_PREVIOUS_SCENE:
        open_neighbour(play, -1);
        break;
    case PLAY_SCENES:
        show_scenes(play);
        break;
    case PLAY_NEXT_VIEW:
        next_view(play);
        break;
    case PLAY_NEXT_SCALAR:
        next_scalar(play);
        break;
    case PLAY_NEXT_COLORMAP:
        next_colormap(play);
        break;
    case PLAY_VIEWS:
        cycle_views(play);
        break;
    case PLAY_LINK_CAMERAS:
        link_cameras(play);
        break;
    case PLAY_SCREENSHOT:
        play->capture.screenshot = true;
        break;
    case PLAY_VIDEO:
        capture_toggle_video(&play->capture, play->picture.width, play->picture.height, &play->notice);
        break;
    case PLAY_SAVE_RECORDING:
        model_save(model);
        break;
    case PLAY_SAVE_SCENE:
        scene_edits_save(model);
        break;
    case PLAY_FULLSCREEN:
        window_fullscreen(play->window, !window_is_fullscreen(play->window));
        break;
    case PLAY_PANEL:
        play->overlay.panel = !play->overlay.panel;
        break;
    case PLAY_HELP:
        play->overlay.help = !play->overlay.help;
        break;
    case PLAY_CAMERA_HOME:
        camera_home(&play->camera, model);
        view_changed(play);
        break;
    case PLAY_BOX_HOME:
        box_control_home(play->control);
        break;
    case PLAY_NEUTRAL:
        box_control_neutral(play->control);
        break;
    case PLAY_WALLS:
        take_walls(play);
        break;
    case PLAY_BOX_SMALLER:
        scale_box(play, 1 / BOX_NOTCH);
        break;
    case PLAY_BOX_LARGER:
        scale_box(play, BOX_NOTCH);
        break;
    case PLAY_GRAVITY_HOME:
        play_set_gravity(play, model->file_scene.world.gravity);
        break;
    case PLAY_TOUCH:
        turn_touch(play, !play->touch.on);
        break;
    case PLAY_TOUCH_WAY:
        next_touch_way(play);
        break;
    case PLAY_TOUCH_FLUID:
        next_touch_fluid(play);
        break;
    case PLAY_PUT_BALL:
        play_put_solid(play, SOLID_LIKE_BALL);
        break;
    case PLAY_PUT_BOX:
        play_put_solid(play, SOLID_LIKE_BOX);
        break;
    case PLAY_PUT_LIKE:
        play_put_solid(play, SOLID_LIKE);
        break;
    case PLAY_TAKE_SOLID:
        play_remove_solid(play);
        break;
    case PLAY_QUIT:
        quit_or_close(play);
        break;
    case PLAY_PIN:
        readout_pin(&play->readout, play->picture.panels, &play->notice);
        break;
    case PLAY_UNPIN:
        readout_unpin(&play->readout);
        break;
    case PLAY_TRAIL:
        choose_trail(play);
        break;
    case PLAY_PLANE_BACK:
    case PLAY_PLANE_FORWARD:
    case PLAY_PLANE_LEFT:
    case PLAY_PLANE_RIGHT:
    case PLAY_PLANE_UP:
    case PLAY_PLANE_DOWN:
    case PLAY_PLANE_X:
    case PLAY_PLANE_Y:
    case PLAY_PLANE_Z:
        step_plane(play, command);
        break;
    default: /* commands of drags, wheels and sticks: input.c */
        break;
    }
}

static void grab_camera(Play *play)
{
    const CameraSight sight = play_sight(play);
    camera_grab(&play->camera, &play->model, &sight);
}

static void camera_has_moved(Play *play)
{
    camera_moved(&play->camera, &play->model);
    view_changed(play);
}

static void turn_camera(Play *play, const double amount[2])
{
    orbit_turn(&play->camera.orbit, amount[0], amount[1]);
    camera_has_moved(play);
}

static void pan_camera(Play *play, const double amount[2])
{
    orbit_pan(&play->camera.orbit, amount[0], amount[1]);
    camera_has_moved(play);
}

static void zoom_camera(Play *play, double steps)
{
    grab_camera(play);
    orbit_zoom(&play->camera.orbit, steps);
    camera_has_moved(play);
}

static void steer_camera(Play *play, const double amount[3])
{
    grab_camera(play);
    orbit_turn(&play->camera.orbit, amount[0], amount[1]);
    orbit_zoom(&play->camera.orbit, amount[2]);
    camera_has_moved(play);
}

static void execute(Play *play, const Action *action)
{
    switch (action->kind) {
    case ACTION_COMMAND:
        do_command(play, action->command, action->held);
        break;
    case ACTION_SETTING:
        if (model_set(&play->model, action->text))
            view_changed(play);
        break;
    case ACTION_RESTART:
        restart_scene(play, action->text, 0);
        break;
    case ACTION_PARTICLES:
        restart_scene(play, NULL, action->amount[0]);
        break;
    case ACTION_OPEN_SCENE:
        open_file(play, action->text);
        break;
    case ACTION_TUNE_DEVICE:
        box_control_tune(play->control, action->device, action->amount[0], action->amount[1]);
        break;
    case ACTION_STOP_BOX:
        model_stop_box(&play->model);
        break;
    case ACTION_GO_TO_TIME:
        model_pause(&play->model, true);
        model_go_to(&play->model, action->amount[0]);
        break;
    case ACTION_CHOOSE_VIEW:
        choose_view(play, action->amount);
        break;
    case ACTION_GRAB_CAMERA:
        grab_camera(play);
        break;
    case ACTION_TURN_CAMERA:
        turn_camera(play, action->amount);
        break;
    case ACTION_PAN_CAMERA:
        pan_camera(play, action->amount);
        break;
    case ACTION_ZOOM_CAMERA:
        zoom_camera(play, action->amount[0]);
        break;
    case ACTION_STEER_CAMERA:
        steer_camera(play, action->amount);
        break;
    case ACTION_TILT_GRAVITY:
        play_tilt_gravity(play, action->amount);
        break;
    case ACTION_RESIZE_BOX:
        model_resize(&play->model, action->amount);
        break;
    case ACTION_SET_GATES:
        model_set_gates(&play->model, action->gates);
        break;
    case ACTION_CHANGE_TOUCH:
        change_touch(play, action->amount);
        break;
    case ACTION_CLOSE_WINDOW:
        play->quit = true;
        break;
    }
}

/* Reports lost requests first, as further messages may follow. */
static void report_lost(Play *play, int lost)
{
    Error words;
    error_set(&words, "too much was asked for during one picture: the last %d of it were left out", lost);
    notice_error(&play->notice, words.message);
}

void actions_execute(Play *play)
{
    Action action;
    const int lost = actions_lost(&play->actions);
    if (lost > 0)
        report_lost(play, lost);
    if (play->solids != play->model.solids && play->picture.panels)
        view_changed(play);
    play->solids = play->model.solids;
    while (action_next(&play->actions, &action))
        execute(play, &action);
}
