/* slosh bench --ablate: the terms of a scene, and the rows made of figures. */
#include "app/lab/ablate.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const char text[] = "box: {size: [1, 1, 1], slip: none}\n"
                           "particles: {spacing: 0.1}\n"
                           "fluids:\n"
                           "  - {fill: [block: {min: [-0.5, 0, -0.5], max: [0, 0.5, 0.5]}]}\n"
                           "  - {viscosity: 2, fill: [block: {min: [0, 0, -0.5], max: [0.5, 0.5, 0.5]}]}\n"
                           "solver: {method: wcsph, delta_sph: 0.1}\n";

static void parse(const char *extra, Scene *scene)
{
    Error error;
    SceneSettings settings = {.count = 0};
    if (*extra)
        settings.set[settings.count++] = extra;
    if (!scene_parse("test.yaml", text, sizeof text - 1, &settings, scene, NULL, &error))
        fail_msg("%s", error.message);
}

static bool has(const SceneTerm terms[], int count, const char *path, const char *value)
{
    for (int i = 0; i < count; i++)
        if (strcmp(terms[i].path, path) == 0 && strcmp(terms[i].value, value) == 0)
            return true;
    return false;
}

static void terms_are_those_in_use_and_on(void **state)
{
    (void)state;
    static Scene scene;
    SceneTerm terms[TERMS_MAX];
    parse("", &scene);
    const int count = scene_terms(&scene, terms);
    assert_true(has(terms, count, "box.slip", "none"));
    assert_true(has(terms, count, "fluids[1].viscosity", "2"));
    assert_true(has(terms, count, "solver.delta_sph", "0.1"));
    assert_true(has(terms, count, "solver.artificial_viscosity", "0.05")); /* by default */
    assert_int_equal(count, 4);
}

static void another_methods_terms_are_none(void **state)
{
    (void)state;
    static Scene scene;
    SceneTerm terms[TERMS_MAX];
    parse("solver.method=mueller", &scene);
    const int count = scene_terms(&scene, terms);
    assert_true(has(terms, count, "solver.numerical_viscosity", "0.03")); /* by default */
    assert_int_equal(count, 3); /* box.slip and the viscosity besides */
}

static void a_table_is_on(void **state)
{
    (void)state;
    static Scene scene;
    SceneTerm terms[TERMS_MAX];
    parse("fluids[0].viscosity=[[0, 0], [1, 2]]", &scene);
    const int count = scene_terms(&scene, terms);
    assert_int_equal(count, 5);
    bool found = false;
    for (int i = 0; i < count; i++)
        found |= strcmp(terms[i].path, "fluids[0].viscosity") == 0;
    assert_true(found);
}

/* Each row's off value is valid for the key, and switches the term off. */
static void off_is_off(void **state)
{
    (void)state;
    static Scene scene;
    SceneTerm terms[TERMS_MAX], left[TERMS_MAX];
    parse("", &scene);
    const int count = scene_terms(&scene, terms);
    for (int i = 0; i < count; i++) {
        char setting[2 * TERM_SIZE];
        snprintf(setting, sizeof setting, "%s=%s", terms[i].path, terms[i].key->off);
        parse(setting, &scene);
        assert_false(has(left, scene_terms(&scene, left), terms[i].path, terms[i].value));
        assert_int_equal(scene_terms(&scene, left), count - 1);
    }
}

/* A term with a quarter of the time, and metrics that change by a tenth. */
static Ablation made_up(void)
{
    Ablation a = {.count = 2, .floor = 0.01};
    a.row[0] =
        (AblateRow){.runs = 4, .seconds = {4, 4, 4, 4}, .ms_step = {1, 2, 3, 4}, .instructions = (double)NAN};
    a.row[1] = (AblateRow){.runs = 3,
                           .seconds = {3, 3.04, 2.96},
                           .instructions = (double)NAN,
                           .change = 0.1,
                           .term = "solver.x"};
    a.row[0].outcome.kind = a.row[1].outcome.kind = OUTCOME_HOLDS;
    return a;
}

static void times_are_medians_of_rounds(void **state)
{
    (void)state;
    Ablation a = made_up();
    assert_float_equal(ablate_ms_step(&a.row[0]), 2.5, 1e-12);
    assert_float_equal(ablate_saved(&a, 1), 0.25, 1e-12);
    assert_float_equal(ablate_noise(&a, 1), 0.02, 1e-12);
    /* the machine gets slower from round to round: it falls out */
    const double slow[4] = {4, 8, 12, 16}, without[3] = {0.75 * 6, 0.75 * 10, 0.75 * 14};
    memcpy(a.row[0].seconds, slow, sizeof slow);
    memcpy(a.row[1].seconds, without, sizeof without);
    assert_float_equal(ablate_saved(&a, 1), 0.25, 1e-12);
    assert_float_equal(ablate_noise(&a, 1), 0, 1e-12);
    a.row[1].runs = 0;
    assert_true(isnan(ablate_saved(&a, 1)) && isnan(ablate_noise(&a, 1)));
}

static void advice_is_by_cost_and_change(void **state)
{
    (void)state;
    Ablation a = made_up();
    assert_int_equal(ablate_advice(&a, 1), ABLATE_WEIGH);
    a.row[1].change = 0.009;
    assert_int_equal(ablate_advice(&a, 1), ABLATE_DROP);
    a.row[1].seconds[0] = a.row[1].seconds[1] = a.row[1].seconds[2] = 4;
    assert_int_equal(ablate_advice(&a, 1), ABLATE_IDLE);
    a.row[0].instructions = 1000;
    a.row[1].instructions = 900;
    assert_int_equal(ablate_advice(&a, 1), ABLATE_DROP); /* time does not show it, instructions do */
    a.row[1].instructions = 990;
    a.row[1].change = 0.011;
    assert_int_equal(ablate_advice(&a, 1), ABLATE_KEEP);
    a.floor = 0; /* repeats are the same to the bit */
    a.row[1].change = 0.9e-4;
    assert_int_equal(ablate_advice(&a, 1), ABLATE_IDLE);
    a.row[1].change = 1.1e-4;
    assert_int_equal(ablate_advice(&a, 1), ABLATE_KEEP);
    a.row[1].outcome.kind = OUTCOME_BLOWN_UP;
    assert_int_equal(ablate_advice(&a, 1), ABLATE_NEEDED);
    a.row[1].outcome.kind = OUTCOME_NONE;
    a.row[1].runs = 0;
    assert_int_equal(ablate_advice(&a, 1), ABLATE_UNKNOWN);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(terms_are_those_in_use_and_on),
        cmocka_unit_test(another_methods_terms_are_none),
        cmocka_unit_test(a_table_is_on),
        cmocka_unit_test(off_is_off),
        cmocka_unit_test(times_are_medians_of_rounds),
        cmocka_unit_test(advice_is_by_cost_and_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
