/* Actions of the user: time, scenes, files, the window. */
#include "app/window/model.h"
#include "app/window/play_private.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>
#include <math.h>

/* ---- time ---- */

static void turn_pause(Play *play)
{
    model_pause(&play->model, !play->model.paused);
}

const UserAction action_pause = {
    .group = "Time",
    .example = "press Space: time stands still; hold the comma key: it runs back, frame by frame",
    .name = "pause",
    .help = "stop the time, or let it run on",
    .keys = {ON(SPACE), ON(PAUSE)},
    .gamepad = "Start",
    .flags = ACTION_BUTTON,
    .run = turn_pause,
};

static void step(Play *play, const ActionUse *use)
{
    model_step(&play->model, use->held);
}

const UserAction action_step = {
    .name = "step",
    .help = "one frame further, then pause",
    .keys = {ON(PERIOD), ON(N)},
    .gamepad = "D-pad right",
    .flags = ACTION_BUTTON | ACTION_REPEATS,
    .run_with = step,
};

static void step_back(Play *play, const ActionUse *use)
{
    model_step_back(&play->model, use->held);
}

const UserAction action_step_back = {
    .name = "step-back",
    .help = "one frame back, then pause",
    .keys = {ON(COMMA)},
    .gamepad = "D-pad left",
    .flags = ACTION_REPEATS,
    .run_with = step_back,
};

/* By seconds. */
static void go_by(Play *play, const ActionUse *use)
{
    model_go_by(&play->model, use->action->by);
}

const UserAction action_back = {
    .name = "back",
    .help = "a second back",
    .keys = {ON_SHIFT(COMMA)},
    .flags = ACTION_REPEATS,
    .by = -1,
    .run_with = go_by,
};

const UserAction action_ahead = {
    .name = "ahead",
    .help = "a second ahead, as far as it was simulated",
    .keys = {ON_SHIFT(PERIOD)},
    .flags = ACTION_REPEATS,
    .by = 1,
    .run_with = go_by,
};

static void go_to_newest(Play *play)
{
    model_go_to(&play->model, INFINITY);
}

const UserAction action_newest = {
    .name = "newest",
    .help = "from the past to the newest state",
    .keys = {ON(END)},
    .run = go_to_newest,
};

static void turn_timeline(Play *play)
{
    play->overlay.timeline = !play->overlay.timeline;
}

const UserAction action_timeline = {
    .name = "timeline",
    .help = "show the time line always, or only while paused, in the past or near the mouse",
    .keys = {ON_SHIFT(T)},
    .run = turn_timeline,
};

static void turn_loop(Play *play)
{
    model_loop(&play->model);
}

const UserAction action_loop = {
    .name = "loop",
    .help = "repeat a recorded run at its end, or stop there",
    .keys = {ON(O)},
    .run = turn_loop,
};

static void reset(Play *play)
{
    model_reset(&play->model);
    touch_tool_reset(&play->touch);
}

const UserAction action_reset = {
    .name = "reset",
    .help = "back to the start of the scene",
    .keys = {ON(R), ON(F5)},
    .flags = ACTION_BUTTON,
    .run = reset,
};

/* By a factor. */
static void change_speed(Play *play, const ActionUse *use)
{
    model_set_speed(&play->model, use->action->by);
}

const UserAction action_slower = {
    .name = "slower",
    .help = "let time go slower",
    .keys = {ON(MINUS), ON(KP_SUBTRACT)},
    .flags = ACTION_BUTTON | ACTION_REPEATS,
    .by = 0.5,
    .run_with = change_speed,
};

const UserAction action_faster = {
    .name = "faster",
    .help = "let time go faster",
    .keys = {ON(EQUAL), ON(KP_ADD)},
    .flags = ACTION_BUTTON | ACTION_REPEATS,
    .by = 2,
    .run_with = change_speed,
};

/* ---- scenes ---- */

static void open_neighbour(Play *play, const ActionUse *use)
{
    if (model_open_neighbour(&play->model, (int)use->action->by))
        play_follow_scene(play);
}

const UserAction action_next_scene = {
    .group = "Scenes and views",
    .example = "press F3 and click a picture: that scene opens; press W: it is seen by several views at once",
    .name = "next-scene",
    .help = "open the next scene; a view that you chose stays",
    .keys = {ON(TAB), ON(RIGHT_BRACKET)},
    .flags = ACTION_BUTTON,
    .by = 1,
    .run_with = open_neighbour,
};

const UserAction action_previous_scene = {
    .name = "previous-scene",
    .help = "open the scene before",
    .keys = {ON_SHIFT(TAB), ON(LEFT_BRACKET)},
    .flags = ACTION_BUTTON,
    .by = -1,
    .run_with = open_neighbour,
};

static void turn_scenes(Play *play)
{
    Error error = {{0}};
    if (!play_overlay_toggle_scenes(&play->overlay, &play->model, &error))
        notice_error(&play->notice, error.message);
}

const UserAction action_scenes = {
    .name = "scenes",
    .help = "show or hide the list of scenes; a click opens one",
    .keys = {ON(F3), ON_CTRL(O)},
    .flags = ACTION_BUTTON,
    .run = turn_scenes,
};

/* ---- files ---- */

static void take_screenshot(Play *play)
{
    play->capture.screenshot = true;
}

const UserAction action_screenshot = {
    .group = "Files",
    .example = "press Ctrl+S: what you did so far is a file; slosh FILE shows it again",
    .name = "screenshot",
    .help = "save the picture as PNG",
    .keys = {ON(F12), ON(I)},
    .flags = ACTION_BUTTON,
    .run = take_screenshot,
};

static void turn_video(Play *play)
{
    capture_toggle_video(&play->capture, play->picture.width, play->picture.height, &play->notice);
}

const UserAction action_video = {
    .name = "video",
    .help = "start or end a video of the picture",
    .keys = {ON(F9), ON(V)},
    .flags = ACTION_BUTTON,
    .run = turn_video,
};

static void save_recording(Play *play)
{
    model_save(&play->model);
}

const UserAction action_save_recording = {
    .name = "save-recording",
    .help = "save the session; slosh FILE, slosh replay and slosh render do it again",
    .keys = {ON_CTRL(S)},
    .flags = ACTION_BUTTON,
    .needs = ACTION_OF_SIMULATION,
    .run = save_recording,
};

static void save_scene(Play *play)
{
    scene_edits_save(&play->model);
}

const UserAction action_save_scene = {
    .name = "save-scene",
    .help = "save the scene with its present settings, views and camera as a new scene file",
    .keys = {{GLFW_KEY_S, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT}},
    .flags = ACTION_BUTTON,
    .needs = ACTION_OF_SIMULATION,
    .run = save_scene,
};

/* ---- the window ---- */

static void turn_fullscreen(Play *play)
{
    window_fullscreen(play->window, !window_is_fullscreen(play->window));
}

const UserAction action_fullscreen = {
    .group = "Window",
    .example = "press P: the panel comes or goes, and the fluid takes the room that is left",
    .name = "fullscreen",
    .help = "fill the screen, or go back to a window",
    .keys = {ON(F11), ON(F)},
    .run = turn_fullscreen,
};

static void turn_panel(Play *play)
{
    play->overlay.panel = !play->overlay.panel;
    play->picture.dirty = true; /* the fluid's room changes */
}

const UserAction action_panel = {
    .name = "panel",
    .help = "show or hide the panel",
    .keys = {ON(F2), ON(P)},
    .flags = ACTION_BUTTON,
    .run = turn_panel,
};

static void turn_help(Play *play)
{
    play->overlay.help = !play->overlay.help;
}

const UserAction action_help = {
    .name = "help",
    .help = "show or hide this list",
    .keys = {ON(F1), ON(H)},
    .flags = ACTION_BUTTON,
    .run = turn_help,
};

static const double CLOSE_PATIENCE_MS = 4000; /* time of the shown question */

static bool asks_to_close(const Play *play)
{
    return play->close_asked_ms > 0 && wall_ms() < play->close_asked_ms + CLOSE_PATIENCE_MS;
}

/* Once per key press, the innermost first; a question is answered with no. */
static void close_innermost(Play *play)
{
    if (asks_to_close(play)) {
        play->close_asked_ms = 0;
        notice_tell(&play->notice, "the window stays open");
    } else if (play->overlay.help)
        play->overlay.help = false;
    else if (play->overlay.scenes)
        turn_scenes(play);
    else if (play->touch.on)
        play_turn_touch(play, false);
    else if (window_is_fullscreen(play->window))
        turn_fullscreen(play);
    else
        notice_tell(&play->notice, "nothing is open that could be closed; Ctrl+Q closes the window");
}

const UserAction action_close = {
    .group = "End",
    .example = "press H, then Escape: the list closes; Escape never closes the window",
    .name = "close",
    .help = "close what is open: a list, the tool for touching, the full screen; \"no\" to a question",
    .keys = {ON(ESCAPE)},
    .run = close_innermost,
};

static void quit_or_ask(Play *play)
{
    const bool lost = play->model.status.unsaved && !play->model.record;
    play->quit |= !lost || asks_to_close(play);
    if (play->quit)
        return;
    play->close_asked_ms = wall_ms();
    notice_tell(&play->notice, "what you did is not saved: Ctrl+S saves it, Ctrl+Q once more closes the "
                               "window, Escape keeps it open");
}

const UserAction action_quit = {
    .name = "quit",
    .help = "close the window; asks where what you did is not saved",
    .keys = {ON_CTRL(Q)},
    .run = quit_or_ask,
};
