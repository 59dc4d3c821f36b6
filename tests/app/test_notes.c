/* What is told of a scene that is no error. */
#include "app/notes.h"
#include "app/scene_advise.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void a_line_is_said_once(void **state)
{
    (void)state;
    Notes notes = {.count = 0};
    for (int i = 0; i < 3; i++)
        notes_add(&notes, "the spacing is %d", 7);
    notes_add(&notes, "the spacing is %d", 8);
    notes_add(NULL, "nobody listens");
    assert_int_equal(notes.count, 2);
    assert_string_equal(notes.line[1], "the spacing is 8");
}

static void too_many_are_said_to_be_more(void **state)
{
    (void)state;
    Notes notes = {.count = 0};
    for (int i = 0; i < NOTES_MAX + 5; i++)
        notes_add(&notes, "line %d", i);
    assert_int_equal(notes.count, NOTES_MAX);
    assert_string_equal(notes.line[0], "line 0");
    assert_non_null(strstr(notes.line[NOTES_MAX - 1], "more"));
}

/* The place in the file where the key stands; the command line's words; the key's path alone. */
static void a_line_has_its_place(void **state)
{
    (void)state;
    static const char text[] = "solver:\n  sound_speed: 3\n";
    Notes notes = {.count = 0};
    Error error = {{0}};
    Tree tree;
    assert_true(tree_read(&tree, "s.yaml", text, strlen(text), &error));
    assert_true(tree_set(&tree, "gravity=[0, -1, 0]", NULL, &error));
    advise(&tree, "solver.sound_speed", &notes, "%d is low", 3);
    advise(&tree, "gravity", &notes, "weak");
    advise(&tree, "solver.step.dt", &notes, "long");
    advise(NULL, "solver.step.dt", &notes, "long");
    tree_free(&tree);
    assert_string_equal(notes.line[0], "s.yaml:2:3: 3 is low");
    assert_string_equal(notes.line[1], "--set gravity=[0, -1, 0]: weak");
    assert_string_equal(notes.line[2], "s.yaml: solver.step.dt: long");
    assert_string_equal(notes.line[3], "solver.step.dt: long");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_line_is_said_once),
        cmocka_unit_test(too_many_are_said_to_be_more),
        cmocka_unit_test(a_line_has_its_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
