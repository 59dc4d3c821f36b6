/* Actions of the user: the box, gravity, the touch tool, solids. */
#include "app/input/input.h"
#include "app/window/model.h"
#include "app/window/play_private.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>
#include <stdio.h>
#include <string.h>

/* ---- the box ---- */

static void bring_box_home(Play *play)
{
    box_control_home(play->control);
}

const UserAction action_box_home = {
    .name = "box-home",
    .help = "bring the box back to its place, upright",
    .keys = {ON(BACKSPACE), ON(B)},
    .gamepad = "A",
    .flags = ACTION_BUTTON,
    .needs = ACTION_OF_SIMULATION,
    .run = bring_box_home,
    .on_devices = control_devices_home,
};

static void take_as_level(Play *play)
{
    box_control_neutral(play->control);
}

const UserAction action_neutral = {
    .name = "neutral",
    .help = "take the present pose of the motion device as level",
    .keys = {ON(L)},
    .gamepad = "Y",
    .flags = ACTION_BUTTON,
    .needs = ACTION_OF_SIMULATION,
    .run = take_as_level,
    .on_devices = control_devices_neutral,
};

static void turn_walls(Play *play)
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

const UserAction action_box_walls = {
    .name = "box-walls",
    .help = "show or hide arrows on the walls of the box; a drag of one moves its wall",
    .keys = {ON_SHIFT(B)},
    .needs = ACTION_OF_SIMULATION,
    .run = turn_walls,
};

#define BOX_NOTCH 1.05

/* Scales all sides by a factor except periodic ones, starting from the target size. */
static void scale_box(Play *play, const ActionUse *use)
{
    const SimulatorStatus *status = &play->model.status;
    const WorldDef *def = &play->model.open.scene.world;
    double size[3];
    memcpy(size, status->resizing ? status->box_wanted : def->box_size, sizeof size);
    for (int k = 0; k < def->dimensions; k++)
        size[k] *= def->periodic[k] ? 1 : use->action->by;
    if (model_resize(&play->model, size))
        notice_tell(&play->notice,
                    def->dimensions == 2 ? "the box: %.3g x %.3g m" : "the box: %.3g x %.3g x %.3g m",
                    size[0], size[1], size[2]);
}

const UserAction action_box_smaller = {
    .name = "box-smaller",
    .help = "make the box 5 % smaller along each side",
    .keys = {ON_CTRL(MINUS), ON_CTRL(KP_SUBTRACT)},
    .needs = ACTION_OF_SIMULATION,
    .by = 1 / BOX_NOTCH,
    .run_with = scale_box,
};

const UserAction action_box_larger = {
    .name = "box-larger",
    .help = "make the box 5 % larger along each side",
    .keys = {ON_CTRL(EQUAL), ON_CTRL(KP_ADD)},
    .needs = ACTION_OF_SIMULATION,
    .by = BOX_NOTCH,
    .run_with = scale_box,
};

const UserAction action_move_box = {
    .name = "move-box",
    .gesture = "Shift + left drag",
    .help = "move the box in the plane of the picture",
    .drag = DRAG_MOVES,
};

const UserAction action_turn_box = {
    .name = "turn-box",
    .gesture = "Ctrl + left drag",
    .help = "turn the box: its near face follows the mouse",
    .drag = DRAG_TURNS,
};

/* Of a handle: HandleTool of app/window/play_private.h. */
const UserAction action_drag_wall = {
    .name = "drag-wall",
    .gesture = "left drag of an arrow on a wall",
    .help = "move that wall and the one across from it; the floor stays, and the top alone moves up and down",
};

#define RATE(MEMBER) offsetof(HandInput, MEMBER)

/* Right, up, away. */
static const HeldKey push_keys[] = {{GLFW_KEY_RIGHT, 0, RATE(move_rate[0]), +1},
                                    {GLFW_KEY_LEFT, 0, RATE(move_rate[0]), -1},
                                    {GLFW_KEY_PAGE_UP, 0, RATE(move_rate[1]), +1},
                                    {GLFW_KEY_PAGE_DOWN, 0, RATE(move_rate[1]), -1},
                                    {GLFW_KEY_UP, 0, RATE(move_rate[2]), +1},
                                    {GLFW_KEY_DOWN, 0, RATE(move_rate[2]), -1},
                                    {0}};

const UserAction action_push_box = {
    .name = "push-box",
    .gesture = "arrows, PageUp and PageDown",
    .help = "move the box left, right, away or nearer; up or down",
    .held = push_keys,
};

static const HeldKey tilt_keys[] = {{GLFW_KEY_RIGHT, GLFW_MOD_SHIFT, RATE(tilt_rate[0]), +1},
                                    {GLFW_KEY_LEFT, GLFW_MOD_SHIFT, RATE(tilt_rate[0]), -1},
                                    {GLFW_KEY_UP, GLFW_MOD_SHIFT, RATE(tilt_rate[1]), +1},
                                    {GLFW_KEY_DOWN, GLFW_MOD_SHIFT, RATE(tilt_rate[1]), -1},
                                    {0}};

const UserAction action_tilt_box = {
    .name = "tilt-box",
    .gesture = "Shift + arrows",
    .help = "tilt the box to the left, to the right, away or nearer",
    .held = tilt_keys,
};

const UserAction action_sway_box = {
    .name = "sway-box",
    .gesture = "gamepad left stick",
    .help = "move the box; let go, and it comes back",
};

const UserAction action_lean_box = {
    .name = "lean-box",
    .gesture = "gamepad right stick",
    .help = "tilt the box; let go, and it comes back",
};

/* ---- gravity ---- */

static void bring_gravity_home(Play *play)
{
    play_set_gravity(play, play->model.file_scene.world.gravity);
}

const UserAction action_gravity_home = {
    .name = "gravity-home",
    .help = "gravity as the scene's file has it",
    .keys = {ON_CTRL(G)},
    .needs = ACTION_OF_SIMULATION,
    .run = bring_gravity_home,
};

static void tilt_gravity(Play *play, const ActionUse *use)
{
    play_tilt_gravity(play, use->amount);
}

const UserAction action_tilt_gravity = {
    .name = "tilt-gravity",
    .gesture = "Ctrl + Shift + left drag",
    .help = "tilt gravity: what falls goes where the mouse does",
    .flags = ACTION_ADDS_UP,
    .drag = DRAG_RADIANS,
    .run_with = tilt_gravity,
};

/* ---- touch ---- */

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

void play_turn_touch(Play *play, bool on)
{
    play->touch.on = play->input.touching = on;
    if (on)
        tell_touch(play);
    else
        notice_tell(&play->notice, "left drag turns the camera");
}

static void turn_touch(Play *play)
{
    play_turn_touch(play, !play->touch.on);
}

const UserAction action_touch = {
    .group = "Touch",
    .example =
        "press T, then drag over the fluid: it goes along with the pointer; press T again: the mouse turns the camera",
    .name = "touch",
    .help = "the mouse touches the fluid, or turns the camera again",
    .keys = {ON(T)},
    .gamepad = "X",
    .flags = ACTION_BUTTON,
    .needs = ACTION_OF_SIMULATION,
    .run = turn_touch,
};

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
        play_turn_touch(play, true);
}

const UserAction action_touch_way = {
    .name = "touch-way",
    .help = "touch: the left button stirs, pulls, pushes, pours or holds solids",
    .keys = {ON(Q)},
    .gamepad = "B",
    .needs = ACTION_OF_SIMULATION,
    .run = next_touch_way,
};

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
        play_turn_touch(play, true);
    notice_tell(&play->notice, "touch: left drag pours %s", poured(play)->name);
}

const UserAction action_touch_fluid = {
    .name = "touch-fluid",
    .help = "touch: pour the next fluid of the scene",
    .keys = {ON_SHIFT(Q)},
    .needs = ACTION_OF_SIMULATION,
    .run = next_touch_fluid,
};

const UserAction action_stir = {
    .name = "stir",
    .gesture = "left drag while touching",
    .help = "stir, pull or push the fluid under the mouse, pour some, or move a solid",
    .drag = DRAG_TOUCHES,
};

const UserAction action_pull = {
    .name = "pull",
    .gesture = "right drag while touching",
    .help = "pull the fluid; push it where the left button pulls, turn a solid where it holds them",
    .drag = DRAG_TOUCHES,
};

/* By notches of the wheel. */
static void change_size(Play *play, const ActionUse *use)
{
    const TouchDef *touch = &play->model.open.scene.touch;
    char setting[64];
    snprintf(setting, sizeof setting, "touch.radius=%.3g",
             touch_tool_notches(touch->radius, use->amount[0], 1, 100));
    if (use->amount[0] != 0 && model_set(&play->model, setting))
        notice_tell(&play->notice, "touch: radius %.3g spacings", touch->radius);
}

const UserAction action_touch_size = {
    .name = "touch-size",
    .gesture = "wheel while touching",
    .help = "make the touch larger or smaller",
    .flags = ACTION_ADDS_UP,
    .run_with = change_size,
};

static void change_strength(Play *play, const ActionUse *use)
{
    const TouchDef *touch = &play->model.open.scene.touch;
    char setting[64];
    snprintf(setting, sizeof setting, "touch.strength=%.3g",
             touch_tool_notches(touch->strength, use->amount[0], 0.01, 100));
    if (use->amount[0] != 0 && model_set(&play->model, setting))
        notice_tell(&play->notice, "touch: strength %.3g", touch->strength);
}

const UserAction action_touch_strength = {
    .name = "touch-strength",
    .gesture = "Shift + wheel while touching",
    .help = "make the touch stronger or weaker",
    .flags = ACTION_ADDS_UP,
    .run_with = change_strength,
};

const UserAction action_touch_pad = {
    .name = "touch-pad",
    .gesture = "gamepad right stick and triggers while touching",
    .help =
        "move the touch over the picture; the right trigger does what the left button does, the left one the other, as hard as it is pulled",
};

/* ---- solids ---- */

/* By a shape (SolidCommand.like). */
static void put_light(Play *play, const ActionUse *use)
{
    play_put_solid(play, (int)use->action->by, true);
}

static void put_fixed(Play *play, const ActionUse *use)
{
    play_put_solid(play, (int)use->action->by, false);
}

const UserAction action_put_ball = {
    .group = "Solids",
    .example = "press 1 over the fluid, and again: balls fall into it with a splash, and swim",
    .name = "put-ball",
    .help = "let a light ball fall into the fluid under the mouse; its size is a third of the touch",
    .keys = {ON(1)},
    .needs = ACTION_OF_SIMULATION,
    .by = SOLID_LIKE_BALL,
    .run_with = put_light,
};

const UserAction action_put_box = {
    .name = "put-box",
    .help = "let a light box fall there",
    .keys = {ON(2)},
    .needs = ACTION_OF_SIMULATION,
    .by = SOLID_LIKE_BOX,
    .run_with = put_light,
};

const UserAction action_put_fixed_ball = {
    .name = "put-fixed-ball",
    .help = "put a ball there that stays, above the fluid; touch: hold moves it",
    .keys = {ON_SHIFT(1)},
    .needs = ACTION_OF_SIMULATION,
    .by = SOLID_LIKE_BALL,
    .run_with = put_fixed,
};

const UserAction action_put_fixed_box = {
    .name = "put-fixed-box",
    .help = "put a box there that stays",
    .keys = {ON_SHIFT(2)},
    .needs = ACTION_OF_SIMULATION,
    .by = SOLID_LIKE_BOX,
    .run_with = put_fixed,
};

const UserAction action_put_like = {
    .name = "put-like",
    .help = "put a solid like the one under the mouse, a mesh too; it falls if that one floats",
    .keys = {ON(3)},
    .needs = ACTION_OF_SIMULATION,
    .by = SOLID_LIKE,
    .run_with = put_light,
};

const UserAction action_take_solid = {
    .name = "take-solid",
    .help = "take out the solid under the mouse",
    .keys = {ON(DELETE), ON(0)},
    .needs = ACTION_OF_SIMULATION,
    .run = play_remove_solid,
};
