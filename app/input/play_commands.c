#include "app/input/play_commands.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>
#include <string.h>

enum { CTRL = GLFW_MOD_CONTROL, SHIFT = GLFW_MOD_SHIFT };

#define KEY(NAME)                                                                                            \
    {                                                                                                        \
        GLFW_KEY_##NAME, 0                                                                                   \
    }

/* Function keys by common convention, plus a letter of the command's word: some keyboards hide the
   function keys, and some lack a sign. */
const PlayCommandRow play_command_rows[] = {
    {.command = PLAY_PAUSE,
     .group = "Time",
     .example = "press Space: time stands still; hold the comma key: it runs back, frame by frame",
     .name = "pause",
     .help = "stop the time, or let it run on",
     .keys = {KEY(SPACE), KEY(PAUSE)},
     .gamepad = "Start",
     .flags = PLAY_BUTTON},
    {.command = PLAY_STEP,
     .name = "step",
     .help = "one frame further, then pause",
     .keys = {KEY(PERIOD), KEY(N)},
     .gamepad = "D-pad right",
     .flags = PLAY_BUTTON | PLAY_REPEATS},
    {.command = PLAY_STEP_BACK,
     .name = "step-back",
     .help = "one frame back, then pause",
     .keys = {KEY(COMMA)},
     .gamepad = "D-pad left",
     .flags = PLAY_REPEATS},
    {.command = PLAY_BACK,
     .name = "back",
     .help = "a second back",
     .keys = {{GLFW_KEY_COMMA, SHIFT}},
     .flags = PLAY_REPEATS},
    {.command = PLAY_AHEAD,
     .name = "ahead",
     .help = "a second ahead, as far as it was simulated",
     .keys = {{GLFW_KEY_PERIOD, SHIFT}},
     .flags = PLAY_REPEATS},
    {.command = PLAY_NEWEST,
     .name = "newest",
     .help = "from the past to the newest state",
     .keys = {KEY(END)}},
    {.command = PLAY_TIMELINE,
     .name = "timeline",
     .help = "show the time line always, or only while paused, in the past or near the mouse",
     .keys = {{GLFW_KEY_T, SHIFT}}},
    {.command = PLAY_LOOP,
     .name = "loop",
     .help = "repeat a recorded run at its end, or stop there",
     .keys = {KEY(O)}},
    {.command = PLAY_RESET,
     .name = "reset",
     .help = "back to the start of the scene",
     .keys = {KEY(R), KEY(F5)},
     .flags = PLAY_BUTTON},
    {.command = PLAY_SLOWER,
     .name = "slower",
     .help = "let time go slower",
     .keys = {KEY(MINUS), KEY(KP_SUBTRACT)},
     .flags = PLAY_BUTTON | PLAY_REPEATS},
    {.command = PLAY_FASTER,
     .name = "faster",
     .help = "let time go faster",
     .keys = {KEY(EQUAL), KEY(KP_ADD)},
     .flags = PLAY_BUTTON | PLAY_REPEATS},
    {.command = PLAY_NEXT_SCENE,
     .group = "Scenes and views",
     .example =
         "press F3 and click a picture: that scene opens; press W: it is seen by several views at once",
     .name = "next-scene",
     .help = "open the next scene; a view that you chose stays",
     .keys = {KEY(TAB), KEY(RIGHT_BRACKET)},
     .flags = PLAY_BUTTON},
    {.command = PLAY_PREVIOUS_SCENE,
     .name = "previous-scene",
     .help = "open the scene before",
     .keys = {{GLFW_KEY_TAB, SHIFT}, KEY(LEFT_BRACKET)},
     .flags = PLAY_BUTTON},
    {.command = PLAY_SCENES,
     .name = "scenes",
     .help = "show or hide the list of scenes; a click opens one",
     .keys = {KEY(F3), {GLFW_KEY_O, CTRL}},
     .flags = PLAY_BUTTON},
    {.command = PLAY_NEXT_VIEW,
     .name = "next-view",
     .help = "draw the fluid by the next view",
     .keys = {KEY(F4), KEY(D)},
     .flags = PLAY_BUTTON},
    {.command = PLAY_NEXT_SCALAR,
     .name = "next-scalar",
     .help = "colour the fluid by the next quantity",
     .keys = {KEY(S)}},
    {.command = PLAY_NEXT_COLORMAP,
     .name = "next-colormap",
     .help = "use the next colormap",
     .keys = {KEY(C)}},
    {.command = PLAY_VIEWS,
     .name = "views",
     .help = "show one, two or four views; a click chooses the view that keys and panel act on",
     .keys = {KEY(W)},
     .flags = PLAY_BUTTON},
    {.command = PLAY_LINK_CAMERAS,
     .name = "link-cameras",
     .help = "move the cameras of all views together, or each camera alone",
     .keys = {{GLFW_KEY_W, SHIFT}}},
    {.command = PLAY_SCREENSHOT,
     .group = "Files",
     .example = "press Ctrl+S: what you did so far is a file; slosh FILE shows it again",
     .name = "screenshot",
     .help = "save the picture as PNG",
     .keys = {KEY(F12), KEY(I)},
     .flags = PLAY_BUTTON},
    {.command = PLAY_VIDEO,
     .name = "video",
     .help = "start or end a video of the picture",
     .keys = {KEY(F9), KEY(V)},
     .flags = PLAY_BUTTON},
    {.command = PLAY_SAVE_RECORDING,
     .name = "save-recording",
     .help = "save the session; slosh FILE, slosh replay and slosh render do it again",
     .keys = {{GLFW_KEY_S, CTRL}},
     .flags = PLAY_BUTTON | PLAY_SIMULATED},
    {.command = PLAY_SAVE_SCENE,
     .name = "save-scene",
     .help = "save the scene with its present settings, views and camera as a new scene file",
     .keys = {{GLFW_KEY_S, CTRL | SHIFT}},
     .flags = PLAY_BUTTON | PLAY_SIMULATED},
    {.command = PLAY_FULLSCREEN,
     .group = "Window",
     .example = "press P: the panel comes or goes, and the fluid takes the room that is left",
     .name = "fullscreen",
     .help = "fill the screen, or go back to a window",
     .keys = {KEY(F11), KEY(F)}},
    {.command = PLAY_PANEL,
     .name = "panel",
     .help = "show or hide the panel",
     .keys = {KEY(F2), KEY(P)},
     .flags = PLAY_BUTTON},
    {.command = PLAY_HELP,
     .name = "help",
     .help = "show or hide this list",
     .keys = {KEY(F1), KEY(H)},
     .flags = PLAY_BUTTON},
    {.command = PLAY_CAMERA_HOME,
     .group = "Camera and box",
     .example = "the fluid has got out of sight: press A, and the whole box is there again",
     .name = "camera-home",
     .help = "show the whole box",
     .keys = {KEY(HOME), KEY(A)},
     .flags = PLAY_BUTTON},
    {.command = PLAY_BOX_HOME,
     .name = "box-home",
     .help = "bring the box back to its place, upright",
     .keys = {KEY(BACKSPACE), KEY(B)},
     .gamepad = "A",
     .flags = PLAY_BUTTON | PLAY_SIMULATED},
    {.command = PLAY_NEUTRAL,
     .name = "neutral",
     .help = "take the present pose of the motion device as level",
     .keys = {KEY(L)},
     .gamepad = "Y",
     .flags = PLAY_BUTTON | PLAY_SIMULATED},
    {.command = PLAY_WALLS,
     .name = "box-walls",
     .help = "show or hide arrows on the walls of the box; a drag of one moves its wall",
     .keys = {{GLFW_KEY_B, SHIFT}},
     .flags = PLAY_SIMULATED},
    {.command = PLAY_BOX_SMALLER,
     .name = "box-smaller",
     .help = "make the box 5 % smaller along each side",
     .keys = {{GLFW_KEY_MINUS, CTRL}, {GLFW_KEY_KP_SUBTRACT, CTRL}},
     .flags = PLAY_SIMULATED},
    {.command = PLAY_BOX_LARGER,
     .name = "box-larger",
     .help = "make the box 5 % larger along each side",
     .keys = {{GLFW_KEY_EQUAL, CTRL}, {GLFW_KEY_KP_ADD, CTRL}},
     .flags = PLAY_SIMULATED},
    {.command = PLAY_GRAVITY_HOME,
     .name = "gravity-home",
     .help = "gravity as the scene's file has it",
     .keys = {{GLFW_KEY_G, CTRL}},
     .flags = PLAY_SIMULATED},
    {.command = PLAY_TOUCH,
     .group = "Touch",
     .example =
         "press T, then drag over the fluid: it goes along with the pointer; press T again: the mouse turns the camera",
     .name = "touch",
     .help = "the mouse touches the fluid, or turns the camera again",
     .keys = {KEY(T)},
     .gamepad = "X",
     .flags = PLAY_BUTTON | PLAY_SIMULATED},
    {.command = PLAY_TOUCH_WAY,
     .name = "touch-way",
     .help = "touch: the left button stirs, pulls, pushes, pours or holds solids",
     .keys = {KEY(Q)},
     .gamepad = "B",
     .flags = PLAY_SIMULATED},
    {.command = PLAY_TOUCH_FLUID,
     .name = "touch-fluid",
     .help = "touch: pour the next fluid of the scene",
     .keys = {{GLFW_KEY_Q, SHIFT}},
     .flags = PLAY_SIMULATED},
    {.command = PLAY_PUT_BALL,
     .group = "Solids",
     .example =
         "press 1 over the fluid, then Q until the notice says hold, and drag the ball through the fluid",
     .name = "put-ball",
     .help = "put a solid ball where the mouse is, above the fluid there; the size is that of the touch",
     .keys = {KEY(1)},
     .flags = PLAY_SIMULATED},
    {.command = PLAY_PUT_BOX,
     .name = "put-box",
     .help = "put a solid box there",
     .keys = {KEY(2)},
     .flags = PLAY_SIMULATED},
    {.command = PLAY_PUT_LIKE,
     .name = "put-like",
     .help = "put a solid of the same shape as the one under the mouse, a mesh too",
     .keys = {KEY(3)},
     .flags = PLAY_SIMULATED},
    {.command = PLAY_TAKE_SOLID,
     .name = "take-solid",
     .help = "take out the solid under the mouse",
     .keys = {KEY(DELETE), KEY(0)},
     .flags = PLAY_SIMULATED},
    {.command = PLAY_PLANE_BACK,
     .group = "Slices",
     .example = "press D until the view is slice, then hold K: the cut moves through the fluid",
     .name = "plane-back",
     .help = "move the shown plane back along its normal",
     .keys = {KEY(J)},
     .flags = PLAY_REPEATS},
    {.command = PLAY_PLANE_FORWARD,
     .name = "plane-forward",
     .help = "move the shown plane forward along its normal",
     .keys = {KEY(K)},
     .flags = PLAY_REPEATS},
    {.command = PLAY_PLANE_LEFT,
     .name = "plane-left",
     .help = "turn the shown plane to the left",
     .keys = {KEY(U)},
     .flags = PLAY_REPEATS},
    {.command = PLAY_PLANE_RIGHT,
     .name = "plane-right",
     .help = "turn the shown plane to the right",
     .keys = {{GLFW_KEY_U, SHIFT}},
     .flags = PLAY_REPEATS},
    {.command = PLAY_PLANE_UP,
     .name = "plane-up",
     .help = "turn the shown plane upwards",
     .keys = {KEY(G)},
     .flags = PLAY_REPEATS},
    {.command = PLAY_PLANE_DOWN,
     .name = "plane-down",
     .help = "turn the shown plane downwards",
     .keys = {{GLFW_KEY_G, SHIFT}},
     .flags = PLAY_REPEATS},
    {.command = PLAY_PLANE_X,
     .name = "plane-x",
     .help = "set the shown plane across the box's x",
     .keys = {KEY(X)}},
    {.command = PLAY_PLANE_Y,
     .name = "plane-y",
     .help = "set the shown plane across the box's y: level",
     .keys = {KEY(Y)}},
    {.command = PLAY_PLANE_Z,
     .name = "plane-z",
     .help = "set the shown plane across the box's z",
     .keys = {KEY(Z)}},
    {.command = PLAY_PIN,
     .group = "Values and trails",
     .example = "point at the fluid and press M: the value there stays in the picture",
     .name = "pin",
     .help = "keep the value under the mouse in the picture, at its place in the box",
     .keys = {KEY(M)}},
    {.command = PLAY_UNPIN, .name = "unpin", .help = "remove all kept values", .keys = {{GLFW_KEY_M, SHIFT}}},
    {.command = PLAY_TRAIL,
     .name = "trail",
     .help = "add a trail to the particle under the mouse, or remove the trail",
     .keys = {KEY(E)}},
    {.command = PLAY_QUIT,
     .group = "End",
     .example = "press Escape: an open list closes; press it once more: the window does",
     .name = "quit",
     .help = "close the list that is open, else the window; asks where what you did is not saved",
     .keys = {KEY(ESCAPE), {GLFW_KEY_Q, CTRL}}},
    {.command = PLAY_ORBIT,
     .group = "Mouse, arrow keys and sticks",
     .example = "hold Shift and drag: the box moves with the mouse, and the fluid sloshes",
     .name = "orbit",
     .gesture = "left drag",
     .help = "turn the camera about the box"},
    {.command = PLAY_PAN, .name = "pan", .gesture = "right drag or middle drag", .help = "shift the picture"},
    {.command = PLAY_PICK,
     .name = "pick",
     .gesture = "right click",
     .help = "add a trail to the particle there, or remove the trail"},
    {.command = PLAY_ZOOM, .name = "zoom", .gesture = "wheel", .help = "move the camera nearer or farther"},
    {.command = PLAY_MOVE_DRAG,
     .name = "move-box",
     .gesture = "Shift + left drag",
     .help = "move the box in the plane of the picture"},
    {.command = PLAY_TURN_DRAG,
     .name = "turn-box",
     .gesture = "Ctrl + left drag",
     .help = "turn the box: its near face follows the mouse"},
    {.command = PLAY_GRAVITY_DRAG,
     .name = "tilt-gravity",
     .gesture = "Ctrl + Shift + left drag",
     .help = "tilt gravity: what falls goes where the mouse does"},
    {.command = PLAY_WALL_DRAG,
     .name = "drag-wall",
     .gesture = "left drag of an arrow on a wall",
     .help =
         "move that wall and the one across from it; the floor stays, and the top alone moves up and down"},
    {.command = PLAY_TOUCH_DRAG,
     .name = "stir",
     .gesture = "left drag while touching",
     .help = "stir, pull or push the fluid under the mouse, pour some, or move a solid"},
    {.command = PLAY_TOUCH_OTHER,
     .name = "pull",
     .gesture = "right drag while touching",
     .help = "pull the fluid; push it where the left button pulls, turn a solid where it holds them"},
    {.command = PLAY_TOUCH_SIZE,
     .name = "touch-size",
     .gesture = "wheel while touching",
     .help = "make the touch larger or smaller"},
    {.command = PLAY_TOUCH_STRENGTH,
     .name = "touch-strength",
     .gesture = "Shift + wheel while touching",
     .help = "make the touch stronger or weaker"},
    {.command = PLAY_MOVE_KEYS,
     .name = "push-box",
     .gesture = "arrows, PageUp and PageDown",
     .help = "move the box left, right, away or nearer; up or down"},
    {.command = PLAY_TILT_KEYS,
     .name = "tilt-box",
     .gesture = "Shift + arrows",
     .help = "tilt the box to the left, to the right, away or nearer"},
    {.command = PLAY_MOVE_STICK,
     .name = "sway-box",
     .gesture = "gamepad left stick",
     .help = "move the box; let go, and it comes back"},
    {.command = PLAY_TILT_STICK,
     .name = "lean-box",
     .gesture = "gamepad right stick",
     .help = "tilt the box; let go, and it comes back"},
    {.command = PLAY_TOUCH_STICK,
     .name = "touch-pad",
     .gesture = "gamepad right stick and triggers while touching",
     .help =
         "move the touch over the picture; the right trigger does what the left button does, the left one the other, as hard as it is pulled"},
    {.command = PLAY_NONE},
};

/* Axes and signs of HandInput: right, up, away. */
const PlayHeldKey play_held_keys[] = {
    {PLAY_MOVE_KEYS, GLFW_KEY_RIGHT, 0, 0, +1},
    {PLAY_MOVE_KEYS, GLFW_KEY_LEFT, 0, 0, -1},
    {PLAY_MOVE_KEYS, GLFW_KEY_PAGE_UP, 0, 1, +1},
    {PLAY_MOVE_KEYS, GLFW_KEY_PAGE_DOWN, 0, 1, -1},
    {PLAY_MOVE_KEYS, GLFW_KEY_UP, 0, 2, +1},
    {PLAY_MOVE_KEYS, GLFW_KEY_DOWN, 0, 2, -1},
    {PLAY_TILT_KEYS, GLFW_KEY_RIGHT, SHIFT, 0, +1},
    {PLAY_TILT_KEYS, GLFW_KEY_LEFT, SHIFT, 0, -1},
    {PLAY_TILT_KEYS, GLFW_KEY_UP, SHIFT, 1, +1},
    {PLAY_TILT_KEYS, GLFW_KEY_DOWN, SHIFT, 1, -1},
    {PLAY_NONE, 0, 0, 0, 0},
};

/* Keys whose sign is elsewhere on other layouts. */
static const struct {
    int key;
    const char *name;   /* for people */
    const char *labels; /* signs, any of which may be on the key */
} signs[] = {
    {GLFW_KEY_MINUS, "-", "-"}, {GLFW_KEY_EQUAL, "+", "=+"},       {GLFW_KEY_PERIOD, ".", "."},
    {GLFW_KEY_COMMA, ",", ","}, {GLFW_KEY_LEFT_BRACKET, "[", "["}, {GLFW_KEY_RIGHT_BRACKET, "]", "]"},
};
enum { SIGN_COUNT = sizeof signs / sizeof signs[0] };

static const struct {
    int key;
    const char *name;
} named_keys[] = {
    {GLFW_KEY_SPACE, "Space"},         {GLFW_KEY_PAUSE, "Pause"},   {GLFW_KEY_TAB, "Tab"},
    {GLFW_KEY_HOME, "Home"},           {GLFW_KEY_END, "End"},       {GLFW_KEY_ESCAPE, "Escape"},
    {GLFW_KEY_BACKSPACE, "Backspace"}, {GLFW_KEY_DELETE, "Delete"}, {GLFW_KEY_KP_SUBTRACT, "keypad -"},
    {GLFW_KEY_KP_ADD, "keypad +"},
};

static const struct {
    int button;
    const char *name;
} gamepad_buttons[] = {{GLFW_GAMEPAD_BUTTON_A, "A"},
                       {GLFW_GAMEPAD_BUTTON_B, "B"},
                       {GLFW_GAMEPAD_BUTTON_X, "X"},
                       {GLFW_GAMEPAD_BUTTON_Y, "Y"},
                       {GLFW_GAMEPAD_BUTTON_START, "Start"},
                       {GLFW_GAMEPAD_BUTTON_DPAD_LEFT, "D-pad left"},
                       {GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, "D-pad right"}};

static int sign_of_key(int key)
{
    for (int i = 0; i < SIGN_COUNT; i++)
        if (signs[i].key == key)
            return i;
    return -1;
}

static PlayCommand find(int key, int modifiers)
{
    for (const PlayCommandRow *row = play_command_rows; row->name; row++)
        for (int k = 0; k < 2; k++)
            if (row->keys[k].key == key && row->keys[k].modifiers == modifiers)
                return row->command;
    return PLAY_NONE;
}

PlayCommand play_command_of_key(int key, int modifiers)
{
    if (key <= 0)
        return PLAY_NONE;
    modifiers &= GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER;
    PlayCommand command = find(key, modifiers);
    if (command == PLAY_NONE && sign_of_key(key) >= 0)
        command = find(key, modifiers & ~SHIFT);
    return command;
}

PlayCommand play_command_of_gamepad(int button)
{
    const char *name = NULL;
    for (size_t i = 0; i < sizeof gamepad_buttons / sizeof gamepad_buttons[0]; i++)
        if (gamepad_buttons[i].button == button)
            name = gamepad_buttons[i].name;
    for (const PlayCommandRow *row = play_command_rows; name && row->name; row++)
        if (row->gamepad && strcmp(row->gamepad, name) == 0)
            return row->command;
    return PLAY_NONE;
}

int play_key_on_layout(int key, const char *label)
{
    /* Only typing keys vary between layouts, and keypad keys do not. */
    if (key <= GLFW_KEY_SPACE || key >= GLFW_KEY_ESCAPE || !label || strlen(label) != 1)
        return key;
    if (*label >= 'a' && *label <= 'z')
        return GLFW_KEY_A + (*label - 'a');
    if (*label >= 'A' && *label <= 'Z')
        return GLFW_KEY_A + (*label - 'A');
    for (int i = 0; i < SIGN_COUNT; i++)
        if (strchr(signs[i].labels, *label))
            return signs[i].key;
    return key;
}

/* Appends to `text`, cut at `size`. */
static void add(char *text, size_t size, const char *more)
{
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s", more);
}

static void key_name(int key, char name[16])
{
    *name = 0;
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25)
        snprintf(name, 16, "F%d", key - GLFW_KEY_F1 + 1);
    else if (sign_of_key(key) >= 0)
        snprintf(name, 16, "%s", signs[sign_of_key(key)].name);
    else if ((key >= GLFW_KEY_A && key <= GLFW_KEY_Z) || (key >= GLFW_KEY_0 && key <= GLFW_KEY_9))
        snprintf(name, 16, "%c", key);
    for (size_t i = 0; i < sizeof named_keys / sizeof named_keys[0]; i++)
        if (named_keys[i].key == key)
            snprintf(name, 16, "%s", named_keys[i].name);
}

void play_command_keys_text(const PlayCommandRow *row, char *text, size_t size)
{
    char ways[4][40] = {{0}};
    int count = 0;
    for (int k = 0; k < 2 && row->keys[k].key; k++) {
        char name[16];
        key_name(row->keys[k].key, name);
        snprintf(ways[count++], sizeof ways[0], "%s%s%s", row->keys[k].modifiers & CTRL ? "Ctrl+" : "",
                 row->keys[k].modifiers & SHIFT ? "Shift+" : "", name);
    }
    if (row->gamepad)
        snprintf(ways[count++], sizeof ways[0], "gamepad %s", row->gamepad);
    if (row->gesture)
        snprintf(ways[count++], sizeof ways[0], "%s", row->gesture);

    if (size == 0)
        return;
    *text = 0;
    for (int i = 0; i < count; i++) {
        add(text, size, i == 0 ? "" : i == count - 1 ? " or " : ", ");
        add(text, size, ways[i]);
    }
}

/* Prints one table per group. */
void play_commands_print(FILE *file)
{
    for (const PlayCommandRow *row = play_command_rows; row->name; row++) {
        char keys[80];
        play_command_keys_text(row, keys, sizeof keys);
        if (row->group)
            fprintf(file, "%s%s: %s.\n\n| command | keys | what it does |\n| --- | --- | --- |\n",
                    row == play_command_rows ? "" : "\n", row->group, row->example);
        fprintf(file, "| `%s` | %s | %s |\n", row->name, keys, row->help);
    }
}
