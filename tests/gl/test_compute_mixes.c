/* The backend `compute` against `cpu`: mixes of terms, each of which gl.compute_terms has. */
#include "tests/gl/parity_case.h"

/* clang-format off */
static const ParityCase cases[] = {
    {"colour field, no slip", 2, 2.1, {1, 3}, TENSION_COLOUR_FIELD, .method = "mueller", .no_slip = true, .runs = true},
    {"Wendland, corrected gradient", 2, 3, {1, 3}, .kernel = "wendland_c2", .delta = 0.1, .negative = true,
     .solids = true, .shifting = 0.2, .corrected = true},
    {"cubic, corrected gradient, 1 : 10", 3, 2.1, {1, 3}, .kernel = "cubic", .negative = true, .corrected = true, .light = 100},
    {"Wendland, curvature, corrected gradient, shifting, 1 : 100", 2, 3, .tension = TENSION_CURVATURE, .kernel = "wendland_c2",
     .delta = 0.1, .negative = true, .solids = true, .shifting = 0.2, .corrected = true, .light = 10},
};
/* clang-format on */
static const ParityTable table = {"wcsph", 0.0005, 200, sizeof cases / sizeof *cases, cases};

static void steps_are_those_of_the_cpu(void **state)
{
    (void)state;
    parity_check(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(steps_are_those_of_the_cpu, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.compute_mixes", tests, compare_setup, context_teardown);
}
