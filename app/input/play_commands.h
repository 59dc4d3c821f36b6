/* The list of all user commands in the window, source of the window's bindings, the help overlay, the
   panel's buttons and `slosh help window`. Pure: uses only GLFW's numbers of keys and buttons. */
#ifndef APP_INPUT_PLAY_COMMANDS_H
#define APP_INPUT_PLAY_COMMANDS_H

#include <stddef.h>
#include <stdio.h>

typedef enum PlayCommand {
    PLAY_NONE = -1,
    /* single commands: press of a key, a gamepad button or the panel's button */
    PLAY_PAUSE,
    PLAY_STEP,
    PLAY_STEP_BACK,
    PLAY_BACK,
    PLAY_AHEAD,
    PLAY_NEWEST,
    PLAY_TIMELINE,
    PLAY_LOOP,
    PLAY_RESET,
    PLAY_SLOWER,
    PLAY_FASTER,
    PLAY_NEXT_SCENE,
    PLAY_PREVIOUS_SCENE,
    PLAY_SCENES,
    PLAY_NEXT_VIEW,
    PLAY_NEXT_SCALAR,
    PLAY_NEXT_COLORMAP,
    PLAY_VIEWS,
    PLAY_LINK_CAMERAS,
    PLAY_SCREENSHOT,
    PLAY_VIDEO,
    PLAY_SAVE_RECORDING,
    PLAY_SAVE_SCENE,
    PLAY_FULLSCREEN,
    PLAY_PANEL,
    PLAY_HELP,
    PLAY_CAMERA_HOME,
    PLAY_BOX_HOME,
    PLAY_NEUTRAL,
    PLAY_WALLS,
    PLAY_BOX_SMALLER,
    PLAY_BOX_LARGER,
    PLAY_GRAVITY_HOME,
    PLAY_TOUCH,
    PLAY_TOUCH_WAY,
    PLAY_TOUCH_FLUID,
    PLAY_PUT_BALL,
    PLAY_PUT_BOX,
    PLAY_PUT_LIKE,
    PLAY_TAKE_SOLID,
    PLAY_PLANE_BACK, /* from here in the order of ViewStep (render/frame/view.h) */
    PLAY_PLANE_FORWARD,
    PLAY_PLANE_LEFT,
    PLAY_PLANE_RIGHT,
    PLAY_PLANE_UP,
    PLAY_PLANE_DOWN,
    PLAY_PLANE_X,
    PLAY_PLANE_Y,
    PLAY_PLANE_Z,
    PLAY_PIN,
    PLAY_UNPIN,
    PLAY_TRAIL,
    PLAY_QUIT, /* an open help is closed by Escape first, in the window */
    /* continuous commands: drags, the wheel, sticks, and the keys of play_held_keys */
    PLAY_ORBIT,
    PLAY_PAN,
    PLAY_PICK, /* same effect as PLAY_TRAIL */
    PLAY_ZOOM,
    PLAY_MOVE_DRAG,
    PLAY_TURN_DRAG,
    PLAY_GRAVITY_DRAG,
    PLAY_WALL_DRAG, /* of a handle: app/window/play_private.h */
    PLAY_TOUCH_DRAG,
    PLAY_TOUCH_OTHER,
    PLAY_TOUCH_SIZE,
    PLAY_TOUCH_STRENGTH,
    PLAY_MOVE_KEYS,
    PLAY_TILT_KEYS,
    PLAY_MOVE_STICK,
    PLAY_TILT_STICK,
    PLAY_TOUCH_STICK,
    PLAY_COMMAND_COUNT
} PlayCommand;

enum {
    PLAY_BUTTON = 1,   /* has a button in the panel */
    PLAY_REPEATS = 2,  /* repeats while the key is held (GLFW_REPEAT) */
    PLAY_SIMULATED = 4 /* has no meaning for a recorded run */
};

typedef struct PlayKey {
    int key;       /* GLFW_KEY_*; 0: none */
    int modifiers; /* GLFW_MOD_SHIFT, _CONTROL, _ALT, _SUPER: exact match */
} PlayKey;

typedef struct PlayCommandRow {
    PlayCommand command;
    const char *group;   /* heading over this row and the rows below; NULL: as the row above */
    const char *example; /* with a group: a suggestion to try, and the effect */
    const char *name;    /* a word, or hyphenated words */
    const char *help;    /* one plain line */
    PlayKey keys[2];
    const char *gamepad; /* name of the gamepad button; NULL: none */
    const char *gesture; /* description of a gesture: "Shift + left drag"; NULL: a press */
    unsigned flags;
} PlayCommandRow;

/* In the order of PlayCommand, so that play_command_rows[PLAY_PAUSE] is the row of PLAY_PAUSE; ended by a
   row with a NULL name. */
extern const PlayCommandRow play_command_rows[];

/* A key moving (PLAY_MOVE_KEYS) or tilting (PLAY_TILT_KEYS) the box while held. */
typedef struct PlayHeldKey {
    PlayCommand command;
    int key, modifiers; /* as in PlayKey */
    int axis;           /* of HandInput.move_rate: 0 .. 2, or of HandInput.tilt_rate: 0 .. 1 */
    int sign;           /* +1 or -1 */
} PlayHeldKey;

extern const PlayHeldKey play_held_keys[]; /* ended by key 0 */

/* Returns the command of a key press (GLFW_KEY_*, from play_key_on_layout) with modifiers (GLFW_MOD_*;
   locks are ignored), or PLAY_NONE. Signs match with Shift too: "+" works whether typed with Shift or
   without. */
PlayCommand play_command_of_key(int key, int modifiers);

/* Returns the command of a GLFW_GAMEPAD_BUTTON_* press, or PLAY_NONE. */
PlayCommand play_command_of_gamepad(int button);

/* GLFW numbers keys by their position on a US keyboard. Returns the number of the key with that letter or
   sign on the user's keyboard; `label`: from glfwGetKeyName, may be NULL. Remaining keys, and labels other
   than Latin letters, stay unchanged. */
int play_key_on_layout(int key, const char *label);

/* Describes how to give the command: "Space, Pause or gamepad Start", "Ctrl+S", "Shift + left drag"; cut
   at `size`. */
void play_command_keys_text(const PlayCommandRow *row, char *text, size_t size);

/* Prints the list as Markdown, one table per group: `slosh help window`. */
void play_commands_print(FILE *file);

#endif
