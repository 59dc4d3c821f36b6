/* Actions of the user: views, colours, the camera, slices, values and trails. */
#include "app/input/input.h"
#include "app/window/model.h"
#include "app/window/play_private.h"
#include "render/frame/frame.h"
#include "render/frame/view.h"
#include "render/picking/picking.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>
#include <stdio.h>
#include <string.h>

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
        Request request = {.kind = REQUEST_SETTING};
        snprintf(tried.kind, sizeof tried.kind, "%s", next->name);
        if (!model_has(&play->model, &tried, &none))
            continue;
        snprintf(request.text, sizeof request.text, "view.kind=%s", next->name);
        request_add(&play->requests, &request);
        notice_tell(&play->notice, "view %s: %s", next->name, next->help);
        return;
    }
}

const UserAction action_next_view = {
    .name = "next-view",
    .help = "draw the fluid by the next view",
    .keys = {ON(F4), ON(D)},
    .flags = ACTION_BUTTON,
    .run = next_view,
};

/* The quantities that one plays with; the panel has all. */
static const Scalar played[] = {SCALAR_SPEED, SCALAR_DENSITY, SCALAR_PRESSURE, SCALAR_VORTICITY,
                                SCALAR_FLUID};

static Scalar after(Scalar shown)
{
    const size_t count = sizeof played / sizeof *played;
    size_t i = 0;
    while (i < count && played[i] != shown)
        i++;
    return i < count ? played[(i + 1) % count] : played[0];
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
        view->color_by = after(view->color_by);
    while (view->color_by != SCALAR_FLUID && !model_has(&play->model, view, &none));
    const Scalar ranged = file->color_by == SCALAR_COUNT ? SCALAR_SPEED : file->color_by;
    view->range_auto = view->color_by == ranged ? file->range_auto : true;
    memcpy(view->range, file->range, sizeof view->range);
    play_view_changed(play);
    notice_tell(&play->notice, "coloured by %s", scalar_name(view_color_by(view)));
}

const UserAction action_next_scalar = {
    .name = "next-scalar",
    .help =
        "colour the fluid by its speed, density, pressure, vorticity, or as the fluid is; the panel has more",
    .keys = {ON(S)},
    .run = next_scalar,
};

static void next_colormap(Play *play)
{
    ViewDef *view = &play->model.open.scene.view;
    const char *shown = view_colormap(view);
    int i = 0;
    while (colormap_list[i] && strcmp(colormap_list[i], shown) != 0)
        i++;
    const char *next = colormap_list[i] && colormap_list[i + 1] ? colormap_list[i + 1] : colormap_list[0];
    snprintf(view->colormap, sizeof view->colormap, "%s", next);
    play_view_changed(play);
    notice_tell(&play->notice, "colours %s", next);
}

const UserAction action_next_colormap = {
    .name = "next-colormap",
    .help = "use the next colormap",
    .keys = {ON(C)},
    .run = next_colormap,
};

static void cycle_views(Play *play)
{
    Scene *scene = &play->model.open.scene;
    views_cycle(&play->views, scene);
    play->camera.held = false;
    handle_tool_begin(&play->handle_tool);
    play_view_changed(play);
    notice_tell(&play->notice, scene->view_count > 0 ? "%d views: click into one to choose it" : "one view",
                scene->view_count);
}

const UserAction action_views = {
    .name = "views",
    .help = "show one, two or four views; a click chooses the view that keys and panel act on",
    .keys = {ON(W)},
    .flags = ACTION_BUTTON,
    .run = cycle_views,
};

static void link_cameras(Play *play)
{
    views_link(&play->views, &play->model.open.scene);
    play_view_changed(play);
    notice_tell(&play->notice,
                play->views.free ? "each view has a camera of its own" : "cameras move together");
}

const UserAction action_link_cameras = {
    .name = "link-cameras",
    .help = "move the cameras of all views together, or each camera alone",
    .keys = {ON_SHIFT(W)},
    .run = link_cameras,
};

/* ---- the camera ---- */

static void bring_camera_home(Play *play)
{
    double centre[2];
    camera_home(&play->camera, &play->model);
    if (play->model.has_particles && picture_visible(&play->picture)) {
        const PanelViewport look = play_viewport(play, play->picture.chosen);
        play->model.open.scene.view.camera_auto |= !camera_sees_box(&look, centre);
    }
    play_view_changed(play);
}

const UserAction action_camera_home = {
    .group = "Camera and box",
    .example = "the fluid has got out of sight: press A, and the whole box is there again",
    .name = "camera-home",
    .help = "show the whole box",
    .keys = {ON(HOME), ON(A)},
    .flags = ACTION_BUTTON,
    .run = bring_camera_home,
};

static void turn_camera(Play *play, const ActionUse *use)
{
    orbit_turn(&play->camera.orbit, use->amount[0], use->amount[1]);
    play_camera_moved(play);
}

const UserAction action_orbit = {
    .group = "Mouse, arrow keys and sticks",
    .example = "hold Shift and drag: the box moves with the mouse, and the fluid sloshes",
    .name = "orbit",
    .gesture = "left drag",
    .help = "turn the camera about the box",
    .flags = ACTION_ADDS_UP,
    .drag = DRAG_RADIANS,
    .run_with = turn_camera,
};

static void pan_camera(Play *play, const ActionUse *use)
{
    orbit_pan(&play->camera.orbit, use->amount[0], use->amount[1]);
    play_camera_moved(play);
}

const UserAction action_pan = {
    .name = "pan",
    .gesture = "right drag or middle drag",
    .help = "shift the picture",
    .flags = ACTION_ADDS_UP,
    .drag = DRAG_HEIGHTS,
    .run_with = pan_camera,
};

/* By steps nearer. */
static void zoom_camera(Play *play, const ActionUse *use)
{
    play_grab_camera(play);
    orbit_zoom(&play->camera.orbit, use->amount[0]);
    play_camera_moved(play);
}

const UserAction action_zoom = {
    .name = "zoom",
    .gesture = "wheel",
    .help = "move the camera nearer or farther",
    .flags = ACTION_ADDS_UP,
    .run_with = zoom_camera,
};

/* ---- slices ---- */

/* By a ViewStep. */
static void step_plane(Play *play, const ActionUse *use)
{
    ViewSetting settings[VIEW_SETTINGS_MAX];
    const ViewStep step = (ViewStep)use->action->by;
    request_add_settings(&play->requests, settings, handle_tool_step(&play->model, step, settings));
}

const UserAction action_plane_back = {
    .group = "Slices",
    .example = "press D until the view is slice, then hold K: the cut moves through the fluid",
    .name = "plane-back",
    .help = "move the shown plane back along its normal",
    .keys = {ON(J)},
    .flags = ACTION_REPEATS,
    .needs = ACTION_OF_STATE,
    .by = VIEW_STEP_BACK,
    .run_with = step_plane,
};

const UserAction action_plane_forward = {
    .name = "plane-forward",
    .help = "move the shown plane forward along its normal",
    .keys = {ON(K)},
    .flags = ACTION_REPEATS,
    .needs = ACTION_OF_STATE,
    .by = VIEW_STEP_FORWARD,
    .run_with = step_plane,
};

const UserAction action_plane_left = {
    .name = "plane-left",
    .help = "turn the shown plane to the left",
    .keys = {ON(U)},
    .flags = ACTION_REPEATS,
    .needs = ACTION_OF_STATE,
    .by = VIEW_STEP_LEFT,
    .run_with = step_plane,
};

const UserAction action_plane_right = {
    .name = "plane-right",
    .help = "turn the shown plane to the right",
    .keys = {ON_SHIFT(U)},
    .flags = ACTION_REPEATS,
    .needs = ACTION_OF_STATE,
    .by = VIEW_STEP_RIGHT,
    .run_with = step_plane,
};

const UserAction action_plane_up = {
    .name = "plane-up",
    .help = "turn the shown plane upwards",
    .keys = {ON(G)},
    .flags = ACTION_REPEATS,
    .needs = ACTION_OF_STATE,
    .by = VIEW_STEP_UP,
    .run_with = step_plane,
};

const UserAction action_plane_down = {
    .name = "plane-down",
    .help = "turn the shown plane downwards",
    .keys = {ON_SHIFT(G)},
    .flags = ACTION_REPEATS,
    .needs = ACTION_OF_STATE,
    .by = VIEW_STEP_DOWN,
    .run_with = step_plane,
};

const UserAction action_plane_x = {
    .name = "plane-x",
    .help = "set the shown plane across the box's x, through the middle of the fluid",
    .keys = {ON(X)},
    .needs = ACTION_OF_STATE,
    .by = VIEW_STEP_X,
    .run_with = step_plane,
};

const UserAction action_plane_y = {
    .name = "plane-y",
    .help = "set the shown plane level, through the middle of the fluid",
    .keys = {ON(Y)},
    .needs = ACTION_OF_STATE,
    .by = VIEW_STEP_Y,
    .run_with = step_plane,
};

const UserAction action_plane_z = {
    .name = "plane-z",
    .help = "set the shown plane across the box's z, through the middle of the fluid",
    .keys = {ON(Z)},
    .needs = ACTION_OF_STATE,
    .by = VIEW_STEP_Z,
    .run_with = step_plane,
};

/* ---- values and trails ---- */

static void pin(Play *play)
{
    readout_pin(&play->readout, play->picture.panels, &play->notice);
}

const UserAction action_pin = {
    .group = "Values and trails",
    .example = "point at the fluid and press M: the value there stays in the picture",
    .name = "pin",
    .help = "keep the value under the mouse in the picture, at its place in the box",
    .keys = {ON(M)},
    .run = pin,
};

static void unpin(Play *play)
{
    readout_unpin(&play->readout);
}

const UserAction action_unpin = {
    .name = "unpin",
    .help = "remove all kept values",
    .keys = {ON_SHIFT(M)},
    .run = unpin,
};

/* Follows the particle under the mouse; the test uses the views' balls of half a spacing. */
static void choose_trail(Play *play)
{
    ViewSetting settings[VIEW_SETTINGS_MAX];
    SightRay ray;
    char words[160];
    uint32_t id;
    if (!play->picture.panels)
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
    play_choose_view(play, mouse);
    const int count = overlays_choose(&play->model.open.scene.view, id, settings, words);
    request_add_settings(&play->requests, settings, count);
    notice_tell(&play->notice, "%s", words);
}

const UserAction action_trail = {
    .name = "trail",
    .help = "add a trail to the particle under the mouse, or remove the trail",
    .keys = {ON(E)},
    .needs = ACTION_OF_STATE,
    .run = choose_trail,
};

/* Asks for `trail` (app/window/input.c). */
const UserAction action_pick = {
    .name = "pick",
    .gesture = "right click",
    .help = "add a trail to the particle there, or remove the trail",
};
