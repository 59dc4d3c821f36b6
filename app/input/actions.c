#include "app/input/actions.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>
#include <assert.h>
#include <string.h>

#define X(name) +1
enum { ACTION_COUNT = ACTIONS(X), ADDED_MAX = 8 };
#undef X

/* Ends with NULL. */
#define X(name) &action_##name,
static const UserAction *list[ACTION_COUNT + ADDED_MAX + 1] = {ACTIONS(X)};
#undef X

const UserAction *const *const user_actions = list;

void user_action_add(const UserAction *action)
{
    size_t count = 0;
    while (list[count])
        count++;
    assert(count < ACTION_COUNT + ADDED_MAX);
    list[count] = action;
}

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

static const UserAction *find(int key, int modifiers)
{
    for (const UserAction *const *at = user_actions; *at; at++)
        for (int k = 0; k < 2; k++)
            if ((*at)->keys[k].key == key && (*at)->keys[k].modifiers == modifiers)
                return *at;
    return NULL;
}

const UserAction *user_action_of_key(int key, int modifiers)
{
    if (key <= 0)
        return NULL;
    modifiers &= GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER;
    const UserAction *action = find(key, modifiers);
    if (!action && sign_of_key(key) >= 0)
        action = find(key, modifiers & ~GLFW_MOD_SHIFT);
    return action;
}

const HeldKey *user_action_held_key(int index)
{
    for (const UserAction *const *at = user_actions; *at; at++)
        for (const HeldKey *key = (*at)->held; key && key->key; key++)
            if (index-- == 0)
                return key;
    return NULL;
}

const UserAction *user_action_of_gamepad(int button)
{
    const char *name = NULL;
    for (size_t i = 0; i < sizeof gamepad_buttons / sizeof gamepad_buttons[0]; i++)
        if (gamepad_buttons[i].button == button)
            name = gamepad_buttons[i].name;
    for (const UserAction *const *at = user_actions; name && *at; at++)
        if ((*at)->gamepad && strcmp((*at)->gamepad, name) == 0)
            return *at;
    return NULL;
}

int key_on_layout(int key, const char *label)
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

void user_action_keys(const UserAction *action, char *text, size_t size)
{
    char ways[4][40] = {{0}};
    int count = 0;
    for (int k = 0; k < 2 && action->keys[k].key; k++) {
        char name[16];
        key_name(action->keys[k].key, name);
        snprintf(ways[count++], sizeof ways[0], "%s%s%s",
                 action->keys[k].modifiers & GLFW_MOD_CONTROL ? "Ctrl+" : "",
                 action->keys[k].modifiers & GLFW_MOD_SHIFT ? "Shift+" : "", name);
    }
    if (action->gamepad)
        snprintf(ways[count++], sizeof ways[0], "gamepad %s", action->gamepad);
    if (action->gesture)
        snprintf(ways[count++], sizeof ways[0], "%s", action->gesture);

    if (size == 0)
        return;
    *text = 0;
    for (int i = 0; i < count; i++) {
        add(text, size, i == 0 ? "" : i == count - 1 ? " or " : ", ");
        add(text, size, ways[i]);
    }
}

void user_actions_print(FILE *file)
{
    for (const UserAction *const *at = user_actions; *at; at++) {
        const UserAction *action = *at;
        char keys[80];
        user_action_keys(action, keys, sizeof keys);
        if (action->group)
            fprintf(file, "%s%s: %s.\n\n| command | keys | what it does |\n| --- | --- | --- |\n",
                    at == user_actions ? "" : "\n", action->group, action->example);
        fprintf(file, "| `%s` | %s | %s |\n", action->name, keys, action->help);
    }
}
