/* The list of what a user can do in the window: it is whole and without conflicts. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "app/input/play_commands.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <ctype.h>
#include <stdbool.h>

static bool is_name(const char *name)
{
    if (!islower((unsigned char)*name))
        return false;
    for (const char *c = name; *c; c++)
        if (!islower((unsigned char)*c) && (*c != '-' || !islower((unsigned char)c[1])))
            return false;
    return true;
}

static void every_row_is_whole(void **state)
{
    (void)state;
    int count = 0;
    for (const PlayCommandRow *row = play_command_rows; row->name; row++, count++) {
        assert_int_equal(row->command, count); /* so that the enum is the index */
        if (!is_name(row->name))
            fail_msg("'%s' is no name", row->name);
        assert_true(row->group || row != play_command_rows);
        assert_true(!row->group == !row->example);
        assert_true(row->help && strlen(row->help) > 5 && !strchr(row->help, '\n'));
        assert_true(row->keys[0].key || !row->keys[1].key);
        /* A press or a gesture, not both, not none. */
        assert_true((row->keys[0].key != 0) != (row->gesture != NULL));
        assert_true(row->keys[0].key || row->flags == 0);
        for (const PlayCommandRow *other = play_command_rows; other < row; other++)
            assert_true(strcmp(row->name, other->name) != 0 && strcmp(row->help, other->help) != 0);
    }
    assert_int_equal(count, PLAY_COMMAND_COUNT);
}

/* A key with its modifiers does one thing: each binding of the list is found as its own row's, and none is
 * held. */
static void no_key_does_two_things(void **state)
{
    (void)state;
    for (const PlayCommandRow *row = play_command_rows; row->name; row++)
        for (int k = 0; k < 2 && row->keys[k].key; k++) {
            const PlayKey key = row->keys[k];
            for (const PlayCommandRow *other = play_command_rows; other->name; other++)
                for (int j = 0; j < 2; j++)
                    if ((other != row || j != k) && other->keys[j].key == key.key &&
                        other->keys[j].modifiers == key.modifiers)
                        fail_msg("%s and %s have the same key", row->name, other->name);
            assert_int_equal(play_command_of_key(key.key, key.modifiers), row->command);
        }
    for (const PlayHeldKey *held = play_held_keys; held->key; held++) {
        assert_int_equal(play_command_of_key(held->key, held->modifiers), PLAY_NONE);
        for (const PlayHeldKey *other = play_held_keys; other < held; other++)
            assert_true(other->key != held->key || other->modifiers != held->modifiers);
    }
}

/* Each axis of the hand has a key for either way. */
static void held_keys_go_both_ways(void **state)
{
    (void)state;
    int moves[3][2] = {{0}}, tilts[2][2] = {{0}};
    for (const PlayHeldKey *held = play_held_keys; held->key; held++) {
        assert_true(held->sign == 1 || held->sign == -1);
        if (held->command == PLAY_MOVE_KEYS) {
            assert_in_range(held->axis, 0, 2);
            moves[held->axis][held->sign > 0]++;
        } else {
            assert_int_equal(held->command, PLAY_TILT_KEYS);
            assert_in_range(held->axis, 0, 1);
            tilts[held->axis][held->sign > 0]++;
        }
    }
    for (int way = 0; way < 2; way++) {
        for (int axis = 0; axis < 3; axis++)
            assert_int_equal(moves[axis][way], 1);
        for (int axis = 0; axis < 2; axis++)
            assert_int_equal(tilts[axis][way], 1);
    }
}

static void keys_find_their_commands(void **state)
{
    (void)state;
    assert_int_equal(play_command_of_key(GLFW_KEY_SPACE, 0), PLAY_PAUSE);
    assert_int_equal(play_command_of_key(GLFW_KEY_SPACE, GLFW_MOD_CAPS_LOCK | GLFW_MOD_NUM_LOCK), PLAY_PAUSE);
    assert_int_equal(play_command_of_key(GLFW_KEY_SPACE, GLFW_MOD_CONTROL), PLAY_NONE);
    assert_int_equal(play_command_of_key(GLFW_KEY_TAB, 0), PLAY_NEXT_SCENE);
    assert_int_equal(play_command_of_key(GLFW_KEY_TAB, GLFW_MOD_SHIFT), PLAY_PREVIOUS_SCENE);
    assert_int_equal(play_command_of_key(GLFW_KEY_TAB, GLFW_MOD_ALT), PLAY_NONE);
    assert_int_equal(play_command_of_key(GLFW_KEY_S, 0), PLAY_NEXT_SCALAR);
    assert_int_equal(play_command_of_key(GLFW_KEY_S, GLFW_MOD_CONTROL), PLAY_SAVE_RECORDING);
    assert_int_equal(play_command_of_key(GLFW_KEY_S, GLFW_MOD_SHIFT), PLAY_NONE);
    assert_int_equal(play_command_of_key(GLFW_KEY_ESCAPE, 0), PLAY_QUIT);
    assert_int_equal(play_command_of_key(GLFW_KEY_EQUAL, 0), PLAY_FASTER);
    assert_int_equal(play_command_of_key(GLFW_KEY_EQUAL, GLFW_MOD_SHIFT),
                     PLAY_FASTER); /* "+" as US types it */
    assert_int_equal(play_command_of_key(GLFW_KEY_PERIOD, GLFW_MOD_CONTROL), PLAY_NONE);
    assert_int_equal(play_command_of_key(GLFW_KEY_UNKNOWN, 0), PLAY_NONE);
    assert_int_equal(play_command_of_key(0, 0), PLAY_NONE);
    assert_int_equal(play_command_of_gamepad(GLFW_GAMEPAD_BUTTON_START), PLAY_PAUSE);
    assert_int_equal(play_command_of_gamepad(GLFW_GAMEPAD_BUTTON_CROSS), PLAY_BOX_HOME);
    assert_int_equal(play_command_of_gamepad(GLFW_GAMEPAD_BUTTON_BACK), PLAY_NONE);
}

static void a_button_of_the_gamepad_is_one_that_is_found(void **state)
{
    (void)state;
    int found = 0, named = 0;
    for (int button = 0; button <= GLFW_GAMEPAD_BUTTON_LAST; button++)
        found += play_command_of_gamepad(button) != PLAY_NONE;
    for (const PlayCommandRow *row = play_command_rows; row->name; row++)
        named += row->gamepad != NULL;
    assert_int_equal(found, named);
}

static void the_label_counts_not_the_place(void **state)
{
    (void)state;
    assert_int_equal(play_key_on_layout(GLFW_KEY_Q, "q"), GLFW_KEY_Q);
    assert_int_equal(play_key_on_layout(GLFW_KEY_Q, "a"), GLFW_KEY_A);                 /* French */
    assert_int_equal(play_key_on_layout(GLFW_KEY_SEMICOLON, "m"), GLFW_KEY_M);         /* French */
    assert_int_equal(play_key_on_layout(GLFW_KEY_SLASH, "-"), GLFW_KEY_MINUS);         /* German */
    assert_int_equal(play_key_on_layout(GLFW_KEY_RIGHT_BRACKET, "+"), GLFW_KEY_EQUAL); /* German */
    assert_int_equal(play_key_on_layout(GLFW_KEY_MINUS, "\xc3\x9f"), GLFW_KEY_MINUS);  /* German sharp s */
    assert_int_equal(play_key_on_layout(GLFW_KEY_A, "\xd1\x84"), GLFW_KEY_A);          /* Cyrillic ef */
    assert_int_equal(play_key_on_layout(GLFW_KEY_KP_ADD, "+"), GLFW_KEY_KP_ADD);
    assert_int_equal(play_key_on_layout(GLFW_KEY_SPACE, " "), GLFW_KEY_SPACE);
    assert_int_equal(play_key_on_layout(GLFW_KEY_F1, NULL), GLFW_KEY_F1);
    assert_int_equal(play_key_on_layout(GLFW_KEY_A, ""), GLFW_KEY_A);
}

static void check_text(PlayCommand command, const char *should)
{
    char text[80];
    play_command_keys_text(&play_command_rows[command], text, sizeof text);
    assert_string_equal(text, should);
}

static void keys_in_words(void **state)
{
    (void)state;
    check_text(PLAY_PAUSE, "Space, Pause or gamepad Start");
    check_text(PLAY_STEP, "., N or gamepad D-pad right");
    check_text(PLAY_BACK, "Shift+,");
    check_text(PLAY_SLOWER, "- or keypad -");
    check_text(PLAY_FASTER, "+ or keypad +");
    check_text(PLAY_PREVIOUS_SCENE, "Shift+Tab or [");
    check_text(PLAY_NEXT_SCALAR, "S");
    check_text(PLAY_SCREENSHOT, "F12 or I");
    check_text(PLAY_SAVE_RECORDING, "Ctrl+S");
    check_text(PLAY_QUIT, "Escape or Ctrl+Q");
    check_text(PLAY_MOVE_DRAG, "Shift + left drag");

    char text[8] = "xxxxxxx";
    play_command_keys_text(&play_command_rows[PLAY_PAUSE], text, 6);
    assert_string_equal(text, "Space");
    play_command_keys_text(&play_command_rows[PLAY_PAUSE], text, 1);
    assert_string_equal(text, "");
    text[0] = 'x';
    play_command_keys_text(&play_command_rows[PLAY_PAUSE], text, 0);
    assert_int_equal(text[0], 'x');
}

static void every_key_has_a_name(void **state)
{
    (void)state;
    for (const PlayCommandRow *row = play_command_rows; row->name; row++)
        for (int k = 0; k < 2 && row->keys[k].key; k++) {
            const PlayCommandRow alone = {.keys = {{row->keys[k].key, 0}}};
            char text[80];
            play_command_keys_text(&alone, text, sizeof text);
            if (!*text)
                fail_msg("%s: key %d has no name", row->name, row->keys[k].key);
            assert_int_equal(row->keys[k].modifiers & ~(GLFW_MOD_CONTROL | GLFW_MOD_SHIFT),
                             0); /* what is named */
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_is_whole),
        cmocka_unit_test(no_key_does_two_things),
        cmocka_unit_test(held_keys_go_both_ways),
        cmocka_unit_test(keys_find_their_commands),
        cmocka_unit_test(a_button_of_the_gamepad_is_one_that_is_found),
        cmocka_unit_test(the_label_counts_not_the_place),
        cmocka_unit_test(keys_in_words),
        cmocka_unit_test(every_key_has_a_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
