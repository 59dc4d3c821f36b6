/* validate for a figure without a value: words in the table, null in the JSON. */
#include "tests/scratch.h"
#include "tests/sim/fixture.h"

#include "app/bench/bench.h"

#include <unistd.h>

static const Case swing = {
    .name = "swing",
    .methods = {{.name = "dfsph", .why = {[1] = "waves of its own"}}},
    .metrics = {{"frequency", "rad/s", .tolerance = 0.07, .without = "does not oscillate"},
                {"width", "m", .tolerance = 0.05},
                {"shape", "", .no_verdict = true}},
};

static CaseFigure shape = {0.5, 1, 0.5};
static Outcome outcome = {.kind = OUTCOME_HOLDS};

static CaseResult *result_of(CaseFigure frequency, CaseFigure width)
{
    static CaseResult result;
    result = (CaseResult){.of = &swing, .level = CASE_DEFAULT};
    snprintf(result.scene.world.method, NAME_SIZE, "wcsph");
    snprintf(result.scene.world.backend, NAME_SIZE, "cpu");
    result.run.figures[0] = frequency;
    result.run.figures[1] = width;
    result.run.figures[2] = shape;
    return &result;
}

static void all_of(FILE *file, char text[4096])
{
    rewind(file);
    text[fread(text, 1, 4095, file)] = 0;
    fclose(file);
}

static void printed(const CaseResult *result, char text[4096])
{
    FILE *file = tmpfile();
    validate_print(result, &outcome, file);
    all_of(file, text);
}

static const CaseFigure none = {(double)NAN, 20.9, (double)NAN}, good = {1.02, 1, 0.02}, bad = {1.2, 1, 0.2};

static void a_figure_without_a_value_is_words(void **state)
{
    (void)state;
    char text[4096];
    printed(result_of(none, good), text);
    assert_non_null(strstr(text, "20.9"));
    assert_non_null(strstr(text, "  missed: does not oscillate\n"));
    assert_null(strstr(text, "nan"));
    printed(result_of(good, none), text);
    assert_non_null(strstr(text, "  missed: no value\n"));
    assert_null(strstr(text, "nan"));
    printed(result_of(good, bad), text);
    assert_non_null(strstr(text, "  missed\n"));
    assert_null(strstr(text, "missed:"));
    printed(result_of(good, good), text);
    assert_null(strstr(text, "missed"));
}

/* It is shown and not judged: with a value or without. */
static void what_has_no_verdict_is_no_miss(void **state)
{
    (void)state;
    char text[4096];
    shape = (CaseFigure){(double)NAN, 1, (double)NAN};
    printed(result_of(good, good), text);
    shape = (CaseFigure){0.5, 1, 0.5};
    assert_non_null(strstr(text, "shape"));
    assert_null(strstr(text, "missed"));
}

/* Then the drop did not stand still: it is not there any more. */
static void a_run_that_broke_says_so_itself(void **state)
{
    (void)state;
    char text[4096];
    CaseResult *result = result_of(none, none);
    snprintf(result->failure, sizeof result->failure, "a particle moved too far");
    printed(result, text);
    assert_null(strstr(text, "oscillate"));
    assert_non_null(strstr(text, "a particle moved too far"));
}

static void json_says_what_failed(void **state)
{
    (void)state;
    char text[4096], path[SCRATCH_SIZE];
    Error error = {{0}};
    scratch_file(path, "");
    CaseResult *result = result_of(none, none);
    snprintf(result->failure, sizeof result->failure, "a particle moved too far");
    assert_true(validate_write_json(result, &outcome, 1, "no memory", path, &error));
    all_of(fopen(path, "r"), text);
    assert_non_null(strstr(text, "\"failure\": \"a particle moved too far\""));
    assert_non_null(strstr(text, "\"error\": \"no memory\""));
}

static void a_figure_without_a_value_is_null(void **state)
{
    (void)state;
    char text[4096], path[SCRATCH_SIZE];
    Error error = {{0}};
    scratch_file(path, "");
    assert_true(validate_write_json(result_of(none, good), &outcome, 1, NULL, path, &error));
    all_of(fopen(path, "r"), text);
    assert_non_null(strstr(text, "\"value\": null"));
    assert_non_null(strstr(text, "\"error\": null"));
    assert_non_null(strstr(text, "\"passed\": false"));
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "NaN"));
}

/* In the row, below the row, and in the JSON; a miss has separate words. */
static void how_it_went_is_told(void **state)
{
    (void)state;
    char text[4096], path[SCRATCH_SIZE];
    Error error = {{0}};
    CaseResult *result = result_of(good, bad);
    snprintf(result->scene.world.method, NAME_SIZE, "dfsph");
    outcome = (Outcome){OUTCOME_SQUEEZED, 0.5, "fluid has lost volume: it is pressed by 7 % in the mean"};
    printed(result, text);
    assert_non_null(strstr(text, "  squeezed\n"));
    assert_non_null(strstr(text, "  missed: waves of its own  squeezed\n"));
    assert_non_null(
        strstr(text, "  squeezed at t = 0.5 s: fluid has lost volume: it is pressed by 7 % in the mean\n"));
    scratch_file(path, "");
    assert_true(validate_write_json(result, &outcome, 1, NULL, path, &error));
    all_of(fopen(path, "r"), text);
    assert_non_null(strstr(text, "\"outcome\": \"squeezed\""));
    assert_non_null(strstr(text, "\"outcome_words\": \"fluid has lost volume"));
    assert_non_null(strstr(text, "\"why\": \"waves of its own\""));
    outcome = (Outcome){.kind = OUTCOME_HOLDS};
    printed(result_of(good, good), text);
    assert_null(strstr(text, "holds"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_figure_without_a_value_is_words), cmocka_unit_test(what_has_no_verdict_is_no_miss),
        cmocka_unit_test(a_run_that_broke_says_so_itself),   cmocka_unit_test(json_says_what_failed),
        cmocka_unit_test(a_figure_without_a_value_is_null),  cmocka_unit_test(how_it_went_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
