/* The cost of a row: the key of a toy method is a single row beside the struct, and all products of the
   table include the key. */
#include "tests/scene/scene_text.h"

#include "app/scene/scene.h"
#include "sim/base/key_rows.h"
#include "sim/step/method.h"

#include <stdlib.h>

typedef struct ToyDef {
    double bounce;
    int colour;
} ToyDef;

static const ToyDef usual = {.bounce = 0.5};
static const char *const colours[] = {"red", "green", NULL};

static const Key rows[] = {
    NUMBER("solver.bounce", L | I, "m", 0, 1, offsetof(ToyDef, bounce), "how high"),
    CHOICE_OF("solver.toy_colour", KEY_INDEX, colours, offsetof(ToyDef, colour), "of what bounces"),
    KEYS_END,
};

static const Method toy = {
    .name = "toy", .help = "a toy", .keys = rows, .def = &usual, .def_size = sizeof usual};

static void a_key_is_one_row(void **state)
{
    (void)state;
    static Scene scene;
    Error error;
    char help[128];
    assert_true(parse_text(LEAST, NULL, &scene, &error));
    assert_float_equal(((ToyDef *)method_def(&scene.world, &toy))->bounce, 0.5, 0); /* the default */
    assert_true(parse_set(LEAST, "solver.bounce=0.25", &scene, &error));
    assert_float_equal(((ToyDef *)method_def(&scene.world, &toy))->bounce, 0.25, 0);
    assert_false(parse_set(LEAST, "solver.bounce=2", &scene, &error));
    assert_non_null(strstr(error.message, "solver.bounce must be 0 to 1 m"));
    assert_true(parse_set(LEAST, "solver.toy_colour=green", &scene, &error));
    assert_int_equal(((ToyDef *)method_def(&scene.world, &toy))->colour, 1);
    char *text = scene_print_text(&scene);
    assert_non_null(strstr(text, "\nsolver.toy_colour = green\n"));
    free(text);
    key_help_text(scene_key_find("solver.bounce"), help, sizeof help);
    assert_string_equal(help, "toy: how high");
}

static void a_key_has_an_owner(void **state)
{
    (void)state;
    static Scene scene;
    Error error;
    char need[64];
    const KeyOwner *owner = key_owner(scene_key_find("solver.bounce"));
    assert_true(parse_text(LEAST, NULL, &scene, &error));
    assert_false(key_owner_used(owner, &scene, KEY_OF_FILE));
    key_owner_condition(owner, need, sizeof need);
    assert_string_equal(need, "solver.method: toy");
    snprintf(scene.world.method, NAME_SIZE, "toy");
    assert_true(key_owner_used(owner, &scene, KEY_OF_FILE));
}

/* A mapping passes the flag to the members; elements of lists have a flag per row. */
static void what_is_idle(void **state)
{
    (void)state;
    static const char *const idle[] = {
        "title",     "solver.threads",   "solver.preset",    "metrics",        "solver.simd",
        "view.kind", "view.camera.from", "view.splat.level", "fluids[].color", "solver.bounce"};
    static const char *const other[] = {
        "gravity",           "solver.method",  "solver.backend", "fluids[].viscosity",
        "solver.toy_colour", "solver.step.dt", "hand.speed"};
    for (size_t i = 0; i < sizeof idle / sizeof *idle; i++)
        assert_true(scene_key_find(idle[i])->flags & KEY_IDLE);
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        assert_false(scene_key_find(other[i])->flags & KEY_IDLE);
}

int main(void)
{
    method_add(&toy);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_key_is_one_row),
        cmocka_unit_test(a_key_has_an_owner),
        cmocka_unit_test(what_is_idle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
