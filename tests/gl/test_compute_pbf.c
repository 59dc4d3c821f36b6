/* The backend `compute` against `cpu`: pbf with iterations. */
#include "tests/gl/parity_case.h"

/* clang-format off */
static const ParityCase cases[] = {
    {"inviscid",                    3, 2.1, .runs = true},
    {"many iterations",             3, 2.1, .dt = 1.0 / 60, .tolerance = 0.001},
    {"viscous, cohesion, no slip",  3, 2.6, {2, 0}, TENSION_COHESION, .no_slip = true},
    {"solids, one that holds",      3, 2.1, {1, 3}, .solids = true},
    {"colour field, solids",        2, 2.6, {1, 0}, TENSION_COLOUR_FIELD, .solids = true, .dt = 0.005},
    {"pressure that pulls",         2, 2.6, .negative = true, .dt = 0.01}, /* a lone particle is held */
    {"periodic",                    2, 2.6, {1, 3}, .sides = "x"},
    {"periodic, solids",            3, 2.1, .solids = true, .sides = "xz"},
};
/* clang-format on */
/* In steps of 4 ms the last digit of a number density is 1e-4 of an acceleration. */
static const ParityTable table = {"pbf", 0.006, 100, sizeof cases / sizeof *cases, cases};

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
    return cmocka_run_group_tests_name("gl.compute_pbf", tests, compare_setup, context_teardown);
}
