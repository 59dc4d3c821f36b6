/* The list of the user's actions in the window is complete and free of conflicts. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tests/app/toy_action.h"
#include "tests/render/ui_fixture.h"

#include "app/input/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

static bool is_name(const char *name)
{
    if (!islower((unsigned char)*name))
        return false;
    for (const char *c = name; *c; c++)
        if (!islower((unsigned char)*c) && (*c != '-' || !islower((unsigned char)c[1])))
            return false;
    return true;
}

/* A struct is named as the action. */
static void the_list_says_their_names(void **state)
{
    (void)state;
    static const char *const names[] = {
#define X(name) #name,
        ACTIONS(X)
#undef X
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s", names[i]);
        for (char *c = name; *c; c++)
            *c = *c == '_' ? '-' : *c;
        assert_string_equal(user_actions[i]->name, name);
    }
    assert_null(user_actions[sizeof names / sizeof *names]);
}

static void every_action_is_whole(void **state)
{
    (void)state;
    for (const UserAction *const *at = user_actions; *at; at++) {
        const UserAction *action = *at;
        if (!is_name(action->name))
            fail_msg("'%s' is no name", action->name);
        assert_true(action->group || at != user_actions);
        assert_true(!action->group == !action->example);
        assert_true(action->help && strlen(action->help) > 5 && !strchr(action->help, '\n'));
        assert_true(action->keys[0].key || !action->keys[1].key);
        /* A press or a gesture, not both, not none. */
        assert_true((action->keys[0].key != 0) != (action->gesture != NULL));
        assert_true(action->keys[0].key || !(action->flags & ~(unsigned)ACTION_ADDS_UP));
        assert_true(!action->drag || action->gesture);
        assert_true(!action->held || action->gesture);
        assert_true(!action->run || !action->run_with);
        assert_true(action->run || action->run_with || action->gesture);
        const bool to_window = action->drag == DRAG_HEIGHTS || action->drag == DRAG_RADIANS;
        assert_true(!to_window || (action->run_with && action->flags & ACTION_ADDS_UP));
        for (const UserAction *const *other = user_actions; other < at; other++)
            assert_true(strcmp(action->name, (*other)->name) != 0 &&
                        strcmp(action->help, (*other)->help) != 0);
    }
}

/* A key with modifiers has a single effect: each binding leads to the action alone, and to no held key. */
static void no_key_does_two_things(void **state)
{
    (void)state;
    const HeldKey *held, *other_held;
    for (const UserAction *const *at = user_actions; *at; at++)
        for (int k = 0; k < 2 && (*at)->keys[k].key; k++) {
            const ActionKey key = (*at)->keys[k];
            for (const UserAction *const *other = user_actions; *other; other++)
                for (int j = 0; j < 2; j++)
                    if ((*other != *at || j != k) && (*other)->keys[j].key == key.key &&
                        (*other)->keys[j].modifiers == key.modifiers)
                        fail_msg("%s and %s have the same key", (*at)->name, (*other)->name);
            assert_ptr_equal(user_action_of_key(key.key, key.modifiers), *at);
        }
    for (int i = 0; (held = user_action_held_key(i)); i++) {
        assert_null(user_action_of_key(held->key, held->modifiers));
        for (int j = 0; j < i; j++) {
            other_held = user_action_held_key(j);
            assert_true(other_held->key != held->key || other_held->modifiers != held->modifiers);
        }
    }
}

/* Each axis of the hand has a key for either way. */
static void held_keys_go_both_ways(void **state)
{
    (void)state;
    static const size_t rates[] = {offsetof(HandInput, move_rate[0]), offsetof(HandInput, move_rate[1]),
                                   offsetof(HandInput, move_rate[2]), offsetof(HandInput, tilt_rate[0]),
                                   offsetof(HandInput, tilt_rate[1])};
    enum { RATES = sizeof rates / sizeof *rates };
    int found[RATES][2] = {{0}}, count = 0;
    const HeldKey *key;
    for (; (key = user_action_held_key(count)); count++) {
        assert_true(key->sign == 1 || key->sign == -1);
        for (int i = 0; i < RATES; i++)
            found[i][key->sign > 0] += rates[i] == key->rate;
    }
    assert_int_equal(count, 2 * RATES);
    for (int i = 0; i < RATES; i++)
        assert_true(found[i][0] == 1 && found[i][1] == 1);
}

/* Without a window a device's button may only move the box. */
static void what_devices_do_alone(void **state)
{
    (void)state;
    for (const UserAction *const *at = user_actions; *at; at++)
        assert_true(!(*at)->on_devices == (*at != &action_box_home && *at != &action_neutral));
}

static void keys_find_their_actions(void **state)
{
    (void)state;
    assert_ptr_equal(user_action_of_key(GLFW_KEY_SPACE, 0), &action_pause);
    assert_ptr_equal(user_action_of_key(GLFW_KEY_SPACE, GLFW_MOD_CAPS_LOCK | GLFW_MOD_NUM_LOCK),
                     &action_pause);
    assert_null(user_action_of_key(GLFW_KEY_SPACE, GLFW_MOD_CONTROL));
    assert_ptr_equal(user_action_of_key(GLFW_KEY_TAB, 0), &action_next_scene);
    assert_ptr_equal(user_action_of_key(GLFW_KEY_TAB, GLFW_MOD_SHIFT), &action_previous_scene);
    assert_null(user_action_of_key(GLFW_KEY_TAB, GLFW_MOD_ALT));
    assert_ptr_equal(user_action_of_key(GLFW_KEY_S, 0), &action_next_scalar);
    assert_ptr_equal(user_action_of_key(GLFW_KEY_S, GLFW_MOD_CONTROL), &action_save_recording);
    assert_null(user_action_of_key(GLFW_KEY_S, GLFW_MOD_SHIFT));
    assert_ptr_equal(user_action_of_key(GLFW_KEY_ESCAPE, 0), &action_close);
    assert_ptr_equal(user_action_of_key(GLFW_KEY_EQUAL, 0), &action_faster);
    assert_ptr_equal(user_action_of_key(GLFW_KEY_EQUAL, GLFW_MOD_SHIFT),
                     &action_faster); /* "+" as typed on a US layout */
    assert_null(user_action_of_key(GLFW_KEY_PERIOD, GLFW_MOD_CONTROL));
    assert_null(user_action_of_key(GLFW_KEY_UNKNOWN, 0));
    assert_null(user_action_of_key(0, 0));
    assert_ptr_equal(user_action_of_gamepad(GLFW_GAMEPAD_BUTTON_START), &action_pause);
    assert_ptr_equal(user_action_of_gamepad(GLFW_GAMEPAD_BUTTON_CROSS), &action_box_home);
    assert_null(user_action_of_gamepad(GLFW_GAMEPAD_BUTTON_BACK));
}

static void a_button_of_the_gamepad_is_one_that_is_found(void **state)
{
    (void)state;
    int found = 0, named = 0;
    for (int button = 0; button <= GLFW_GAMEPAD_BUTTON_LAST; button++)
        found += user_action_of_gamepad(button) != NULL;
    for (const UserAction *const *at = user_actions; *at; at++)
        named += (*at)->gamepad != NULL;
    assert_int_equal(found, named);
}

static void the_label_counts_not_the_place(void **state)
{
    (void)state;
    assert_int_equal(key_on_layout(GLFW_KEY_Q, "q"), GLFW_KEY_Q);
    assert_int_equal(key_on_layout(GLFW_KEY_Q, "a"), GLFW_KEY_A);                 /* French */
    assert_int_equal(key_on_layout(GLFW_KEY_SEMICOLON, "m"), GLFW_KEY_M);         /* French */
    assert_int_equal(key_on_layout(GLFW_KEY_SLASH, "-"), GLFW_KEY_MINUS);         /* German */
    assert_int_equal(key_on_layout(GLFW_KEY_RIGHT_BRACKET, "+"), GLFW_KEY_EQUAL); /* German */
    assert_int_equal(key_on_layout(GLFW_KEY_MINUS, "\xc3\x9f"), GLFW_KEY_MINUS);  /* German sharp s */
    assert_int_equal(key_on_layout(GLFW_KEY_A, "\xd1\x84"), GLFW_KEY_A);          /* Cyrillic ef */
    assert_int_equal(key_on_layout(GLFW_KEY_KP_ADD, "+"), GLFW_KEY_KP_ADD);
    assert_int_equal(key_on_layout(GLFW_KEY_SPACE, " "), GLFW_KEY_SPACE);
    assert_int_equal(key_on_layout(GLFW_KEY_F1, NULL), GLFW_KEY_F1);
    assert_int_equal(key_on_layout(GLFW_KEY_A, ""), GLFW_KEY_A);
}

static void check_text(const UserAction *action, const char *should)
{
    char text[80];
    user_action_keys(action, text, sizeof text);
    assert_string_equal(text, should);
}

static void keys_in_words(void **state)
{
    (void)state;
    check_text(&action_pause, "Space, Pause or gamepad Start");
    check_text(&action_step, "., N or gamepad D-pad right");
    check_text(&action_back, "Shift+,");
    check_text(&action_slower, "- or keypad -");
    check_text(&action_faster, "+ or keypad +");
    check_text(&action_previous_scene, "Shift+Tab or [");
    check_text(&action_next_scalar, "S");
    check_text(&action_screenshot, "F12 or I");
    check_text(&action_save_recording, "Ctrl+S");
    check_text(&action_close, "Escape");
    check_text(&action_quit, "Ctrl+Q");
    check_text(&action_move_box, "Shift + left drag");

    char text[8] = "xxxxxxx";
    user_action_keys(&action_pause, text, 6);
    assert_string_equal(text, "Space");
    user_action_keys(&action_pause, text, 1);
    assert_string_equal(text, "");
    text[0] = 'x';
    user_action_keys(&action_pause, text, 0);
    assert_int_equal(text[0], 'x');
}

static void every_key_has_a_name(void **state)
{
    (void)state;
    for (const UserAction *const *at = user_actions; *at; at++)
        for (int k = 0; k < 2 && (*at)->keys[k].key; k++) {
            const UserAction alone = {.keys = {{(*at)->keys[k].key, 0}}};
            char text[80];
            user_action_keys(&alone, text, sizeof text);
            if (!*text)
                fail_msg("%s: key %d has no name", (*at)->name, (*at)->keys[k].key);
            assert_int_equal((*at)->keys[k].modifiers & ~(GLFW_MOD_CONTROL | GLFW_MOD_SHIFT),
                             0); /* the named keys */
        }
}

static void draw_help(void *user, Desk *desk)
{
    (void)user;
    panel_help_draw(desk->ui, desk->target.width, desk->target.height);
}

/* True if the list on the screen has the words. */
static bool the_list_shows(const char *words)
{
    Desk *desk = calloc(1, sizeof *desk);
    assert_non_null(desk);
    desk_open(desk, 1000, 3000, 13);
    desk->draw = draw_help;
    desk_frames(desk, 10);
    const bool shown = desk_find(desk, words) != NULL;
    desk_close(desk);
    free(desk);
    return shown;
}

/* An added action has a key, a line in both lists and a word in a mapping. */
static void an_action_more_is_all_there(void **state)
{
    (void)state;
    static const char yaml[] = "dualsense:\n  buttons: {circle: count}\n";
    char *text = NULL;
    size_t size = 0;
    Mapping mapping;
    Error error;
    assert_false(mapping_parse("m.yaml", yaml, sizeof yaml - 1, &mapping, &error));
    assert_true(the_list_shows(action_quit.help) && !the_list_shows(action_count.help));
    toy_action_add();
    assert_true(the_list_shows(action_count.help) && the_list_shows(action_count.example));
    every_action_is_whole(state);
    no_key_does_two_things(state);
    assert_ptr_equal(user_action_of_key(GLFW_KEY_F8, 0), &action_count);
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    user_actions_print(file);
    assert_int_equal(fclose(file), 0);
    assert_non_null(strstr(text, "\nToys: press F8: the picture says how many particles it shows.\n"));
    assert_non_null(strstr(text, "\n| `count` | F8 | tell how many particles are shown |\n"));
    free(text);
    assert_true(mapping_parse("m.yaml", yaml, sizeof yaml - 1, &mapping, &error));
    bool found = false;
    for (int i = 0; i < mapping.family[DEVICE_DUALSENSE].button_count; i++)
        found |= mapping.family[DEVICE_DUALSENSE].buttons[i].action == &action_count;
    assert_true(found);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_list_says_their_names),
        cmocka_unit_test(every_action_is_whole),
        cmocka_unit_test(no_key_does_two_things),
        cmocka_unit_test(held_keys_go_both_ways),
        cmocka_unit_test(what_devices_do_alone),
        cmocka_unit_test(keys_find_their_actions),
        cmocka_unit_test(a_button_of_the_gamepad_is_one_that_is_found),
        cmocka_unit_test(the_label_counts_not_the_place),
        cmocka_unit_test(keys_in_words),
        cmocka_unit_test(every_key_has_a_name),
        cmocka_unit_test(an_action_more_is_all_there),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
