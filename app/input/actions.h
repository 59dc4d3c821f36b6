/* Actions of the user in the window: one const struct each. Bindings of keys, the list on the screen, the
   panel's buttons, the files of mappings and `slosh help window` follow from the structs.

   A struct lies beside its function in app/window, and its name stands in action_list.h. Only the window
   calls the function. */
#ifndef APP_INPUT_ACTIONS_H
#define APP_INPUT_ACTIONS_H

#include "app/input/action_list.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct ControlDevices; /* app/input/input.h */
struct Play;           /* app/window: all parts of the window */
struct UserAction;

enum {
    ACTION_BUTTON = 1,  /* has a button in the panel */
    ACTION_REPEATS = 2, /* repeats while the key is held (GLFW_REPEAT) */
    ACTION_ADDS_UP = 4  /* amounts of waiting requests in sequence are summed */
};

/* Conditions of an action. */
enum {
    ACTION_OF_SIMULATION =
        1, /* a simulation is shown, no recorded run: else a message, and no button in the panel */
    ACTION_OF_STATE = 2 /* a state of the scene is shown: else nothing happens */
};

typedef struct ActionKey {
    int key;       /* GLFW_KEY_*; 0: none */
    int modifiers; /* GLFW_MOD_SHIFT, _CONTROL, _ALT, _SUPER: exact match */
} ActionKey;

/* Keys of a row, by their names of GLFW. */
#define ON(NAME)                                                                                             \
    {                                                                                                        \
        GLFW_KEY_##NAME, 0                                                                                   \
    }
#define ON_SHIFT(NAME)                                                                                       \
    {                                                                                                        \
        GLFW_KEY_##NAME, GLFW_MOD_SHIFT                                                                      \
    }
#define ON_CTRL(NAME)                                                                                        \
    {                                                                                                        \
        GLFW_KEY_##NAME, GLFW_MOD_CONTROL                                                                    \
    }

/* A key held down to move the box. */
typedef struct HeldKey {
    int key, modifiers; /* as in ActionKey */
    size_t rate;        /* offset in HandInput of the changed rate, a double */
    int sign;           /* +1 or -1 */
} HeldKey;

/* Result of a drag with the mouse. */
typedef enum ActionDrag {
    DRAG_NONE,    /* no drag of the picture */
    DRAG_HEIGHTS, /* to `run_with`: picture heights to the right and up */
    DRAG_RADIANS, /* to `run_with`: radians of a turn by a drag to the right and up */
    DRAG_MOVES,   /* to the hand at once: HandInput.move_drag, */
    DRAG_TURNS,   /* turn_drag, */
    DRAG_TOUCHES  /* or the finger */
} ActionDrag;

/* A request for an action. */
typedef struct ActionUse {
    const struct UserAction *action;
    bool held;        /* repeated by a held key */
    double amount[3]; /* of a drag or the wheel; else 0 */
} ActionUse;

typedef struct UserAction {
    const char *group;   /* heading over the action and the following actions; NULL: no new heading */
    const char *example; /* with a group: a suggestion to try, and the effect */
    const char *name;    /* a word, or hyphenated words */
    const char *help;    /* a plain line */
    ActionKey keys[2];
    const char *gamepad; /* name of the gamepad button; NULL: none */
    const char *gesture; /* description of a gesture: "Shift + left drag"; NULL: a press */
    unsigned flags;
    unsigned needs;      /* conditions: ACTION_OF_SIMULATION | ACTION_OF_STATE */
    ActionDrag drag;     /* of a gesture */
    const HeldKey *held; /* of a gesture: keys, ends with key 0; NULL: none */
    double by;           /* parameter of `run_with`: a direction, an amount, or a number of a choice */
    /* The function, one of the two; NULL, NULL: a held input moves the box or the finger. */
    void (*run)(struct Play *play);
    void (*run_with)(struct Play *play, const ActionUse *use);
    /* Effect of the button of a motion device without a window; NULL: none. */
    void (*on_devices)(struct ControlDevices *devices);
} UserAction;

#define X(name) extern const UserAction action_##name;
ACTIONS(X)
#undef X

/* All actions, in their order; ends with NULL. */
extern const UserAction *const *const user_actions;

/* For tests: adds an action at the end of the list. */
void user_action_add(const UserAction *action);

/* Returns the action of a key press (GLFW_KEY_*, from key_on_layout) with modifiers (GLFW_MOD_*; locks are
   ignored), or NULL. Signs match with Shift too: "+" works whether typed with Shift or without. */
const UserAction *user_action_of_key(int key, int modifiers);

/* The held keys of all actions, by number; NULL after the last. */
const HeldKey *user_action_held_key(int index);

/* Returns the action of a GLFW_GAMEPAD_BUTTON_* press, or NULL. */
const UserAction *user_action_of_gamepad(int button);

/* GLFW numbers keys by their position on a US keyboard. Returns the number of the key with the letter or
   sign on the user's keyboard; `label`: from glfwGetKeyName, may be NULL. Remaining keys, and labels other
   than Latin letters, stay unchanged. */
int key_on_layout(int key, const char *label);

/* Describes how to give the action: "Space, Pause or gamepad Start", "Ctrl+S", "Shift + left drag"; cut at
   `size`. */
void user_action_keys(const UserAction *action, char *text, size_t size);

/* Prints the list as Markdown, one table per group: `slosh help window`. */
void user_actions_print(FILE *file);

#endif
