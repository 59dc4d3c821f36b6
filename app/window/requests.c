/* Executes the requests to the window, between two pictures. */
#include "app/input/input.h"
#include "app/window/model.h"
#include "app/window/play_private.h"
#include "render/frame/frame.h"
#include "render/frame/view.h"
#include "render/picking/picking.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void play_view_changed(Play *play)
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

void play_follow_scene(Play *play)
{
    input_begin(&play->input);
    handle_tool_begin(&play->handle_tool);
    readout_begin(&play->readout);
    play->wanted = hand_at_rest().sent;
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
        play_view_changed(play);
}

bool requests_open_scene(Play *play, const char *scene, const SceneSettings *settings, Error *error)
{
    const bool opened = model_open(&play->model, scene, settings, error);
    if (opened) {
        const Scene *is = &play->model.open.scene;
        welcome_begin(&play->welcome, &play->model.open);
        picture_say(&play->picture, &is->view, play->welcome.opening, play->window);
        play_follow_scene(play);
    }
    return opened;
}

void requests_scene_changed(Play *play, bool begun, bool views)
{
    Scene *scene = &play->model.open.scene;
    play->picture.dirty = true;
    if (begun) {
        play_follow_scene(play);
        return;
    }
    title_window(play);
    if (!views)
        return;
    views_open(&play->views, scene, &play->model.file_scene);
    play->camera.held = false;
    handle_tool_begin(&play->handle_tool);
    play_view_changed(play);
}

/* Restarts the scene with a new count of particles, or with a preset. */
static void restart_scene(Play *play, const char *setting, double particles)
{
    Error error = {{0}};
    SettingList more = {.count = 0};
    if (setting)
        setting_list_add(&more, setting);
    if (scene_restart(&play->model, &more, (size_t)particles, &error))
        requests_scene_changed(play, true, true);
    else
        notice_error(&play->notice, error.message);
    setting_list_free(&more);
}

static void open_file(Play *play, const char *path)
{
    Error error = {{0}};
    if (!requests_open_scene(play, path, NULL, &error))
        notice_error(&play->notice, error.message);
}

void play_choose_view(Play *play, const double at[2])
{
    PlayModel *model = &play->model;
    const int panel = picture_panel_at(&play->picture, at[0], at[1]);
    if (!views_choose(&play->views, &model->open.scene, &model->file_scene, panel))
        return;
    play->camera.held = false;
    play_view_changed(play);
}

void play_grab_camera(Play *play)
{
    const CameraSight sight = play_sight(play);
    camera_grab(&play->camera, &play->model, &sight);
}

void play_camera_moved(Play *play)
{
    camera_moved(&play->camera, &play->model);
    play_view_changed(play);
}

static void steer_camera(Play *play, const double amount[3])
{
    play_grab_camera(play);
    orbit_turn(&play->camera.orbit, amount[0], amount[1]);
    orbit_zoom(&play->camera.orbit, amount[2]);
    play_camera_moved(play);
}

/* True if the conditions of the action hold; reports a missing simulation. */
static bool may_act(Play *play, const UserAction *action)
{
    const bool lacks = action->needs & ACTION_OF_SIMULATION && !play->model.open.source->simulates;
    if (lacks)
        notice_tell(&play->notice, "%s: nothing is simulated, a recorded run is shown", action->name);
    return !lacks && (!(action->needs & ACTION_OF_STATE) || play->model.has_particles);
}

static void act(Play *play, const Request *request)
{
    const UserAction *action = request->action;
    ActionUse use = {.action = action, .held = request->held};
    memcpy(use.amount, request->amount, sizeof use.amount);
    play->picture.over = true; /* what changes the fluid's picture says so itself */
    if (!may_act(play, action))
        return;
    if (action->run)
        action->run(play);
    else if (action->run_with)
        action->run_with(play, &use);
}

static void execute(Play *play, const Request *request)
{
    switch (request->kind) {
    case REQUEST_ACTION:
        act(play, request);
        break;
    case REQUEST_VALUE:
        if (model_set_value(&play->model, &request->value))
            play_view_changed(play);
        break;
    case REQUEST_SETTING:
        if (model_set(&play->model, request->text))
            play_view_changed(play);
        break;
    case REQUEST_RESTART:
        restart_scene(play, request->text, 0);
        break;
    case REQUEST_PARTICLES:
        restart_scene(play, NULL, request->amount[0]);
        break;
    case REQUEST_OPEN_SCENE:
        open_file(play, request->text);
        break;
    case REQUEST_TUNE_DEVICE:
        box_control_tune(play->control, request->device, request->amount[0], request->amount[1]);
        break;
    case REQUEST_STOP_BOX:
        model_stop_box(&play->model);
        break;
    case REQUEST_GO_TO_TIME:
        model_pause(&play->model, true);
        model_go_to(&play->model, request->amount[0]);
        break;
    case REQUEST_CHOOSE_VIEW:
        play_choose_view(play, request->amount);
        break;
    case REQUEST_GRAB_CAMERA:
        play_grab_camera(play);
        break;
    case REQUEST_STEER_CAMERA:
        steer_camera(play, request->amount);
        break;
    case REQUEST_RESIZE_BOX:
        model_resize(&play->model, request->amount);
        break;
    case REQUEST_SET_GATES:
        model_set_gates(&play->model, request->gates);
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

void requests_execute(Play *play)
{
    Request request;
    const int lost = requests_lost(&play->requests);
    if (lost > 0)
        report_lost(play, lost);
    if (play->solids != play->model.solids && play->picture.panels)
        play_view_changed(play);
    play->solids = play->model.solids;
    while (request_next(&play->requests, &request))
        execute(play, &request);
}
