/* Titles of panels that show different states. */
#include "app/run/compare/compare.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static WorldDef one = {.method = "a", .step_mode = STEP_FIXED, .dt = 0.004, .substeps = 2};
static WorldDef two = {.method = "b", .step_mode = STEP_FIXED, .dt = 0.004, .substeps = 4};

static PanelFacts facts_of(const char *words, const char *said, const WorldDef *def)
{
    return (PanelFacts){.words = words, .said = said, .def = def, .particles = 10, .spacing = 0.01};
}

static void assert_title(const PanelFacts facts[], int count, int panel, const char *words,
                         const char *figures)
{
    Title title;
    panel_title(facts, count, panel, "own", &title);
    assert_string_equal(title.words, words);
    assert_string_equal(title.figures, figures);
}

static void says_what_differs_and_its_name_does_not_say(void **state)
{
    (void)state;
    PanelFacts facts[] = {facts_of("", "", &one), facts_of("method b", "solver.method=b", &two)};
    assert_title(facts, 2, 0, "own", "method a, steps of 2 ms");
    assert_title(facts, 2, 1, "method b", "steps of 1 ms");
    facts[1].said = "particles.spacing=0.02\nsolver.methods=b"; /* a different key */
    facts[1].spacing = 0.02;
    assert_title(facts, 2, 1, "method b", "spacing 20 mm, method b, steps of 1 ms");
    facts[1] = facts_of("the same", "", &one);
    assert_title(facts, 2, 1, "the same", "");
}

/* Neither method nor step is in a file. */
static void says_where_a_file_has_no_state(void **state)
{
    (void)state;
    PanelFacts facts[] = {facts_of("", "", &one), facts_of("run", "", &two)};
    facts[1].recorded = true;
    facts[1].first = 0.1;
    facts[1].last = 0.3;
    facts[1].wanted = 0.3;
    assert_title(facts, 2, 0, "own", "");
    assert_title(facts, 2, 1, "run", "");
    facts[1].wanted = 0.31;
    assert_title(facts, 2, 1, "run", "ends at 0.3 s");
    facts[1].wanted = 0.09;
    facts[1].particles = 1;
    assert_title(facts, 2, 1, "run", "begins at 0.1 s, 1 particle");
    assert_title(facts, 2, 0, "own", "10 particles");
}

/* A simulation on the way to the time that its panel shows. */
static void says_where_its_time_is_not_yet(void **state)
{
    (void)state;
    PanelFacts facts[] = {facts_of("", "", &one), facts_of("time 0.8 s", "", &one)};
    facts[1].wanted = 0.8;
    facts[1].time = 0.3;
    assert_title(facts, 2, 1, "time 0.8 s", "now at 0.3 s");
    facts[1].time = 0.804;
    assert_title(facts, 2, 1, "time 0.8 s", "");
    assert_title(facts, 2, 0, "own", "");
}

static void says_where_a_solver_stopped(void **state)
{
    (void)state;
    PanelFacts facts[] = {facts_of("", "", &one), facts_of("b", "", &one)};
    facts[1].failed = true;
    facts[1].time = 0.25;
    assert_title(facts, 2, 1, "b", "stopped at 0.25 s");
    assert_title(facts, 2, 0, "own", "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(says_what_differs_and_its_name_does_not_say),
        cmocka_unit_test(says_where_a_file_has_no_state),
        cmocka_unit_test(says_where_its_time_is_not_yet),
        cmocka_unit_test(says_where_a_solver_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
