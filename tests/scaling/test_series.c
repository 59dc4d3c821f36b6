/* Grouping of runs on ranks, and speed-ups. */
#include "tests/tolerance.h"

#include "app/lab/scaling.h"

static ScalingRun run_of(int ranks, double particles, double step)
{
    return (ScalingRun){{.ranks = ranks, .cores = ranks, .particles = particles}, step};
}

static void strong_and_weak_series_are_found(void **state)
{
    (void)state;
    const ScalingRun runs[] = {run_of(4, 4000, 0.5), run_of(1, 1000, 1),   run_of(2, 2010, 1.25),
                               run_of(1, 4000, 1),   run_of(2, 3990, 0.8), run_of(2, 3990, 0.6)};
    ScalingSeries series[SCALING_SERIES_MAX];
    assert_int_equal(scaling_series_find(runs, 6, series), 2);
    assert_int_equal(series[0].kind, SCALING_STRONG);
    assert_int_equal(series[0].count, 3);
    assert_int_equal(series[0].run[0], 3);
    assert_int_equal(series[0].run[1], 5); /* the faster of two */
    assert_int_equal(series[0].run[2], 0);
    check_near(scaling_speedup(runs, &series[0], 2), 2, 1e-12, "speed-up");
    check_near(scaling_efficiency(runs, &series[0], 2), 0.5, 1e-12, "efficiency");
    assert_int_equal(series[1].kind, SCALING_WEAK);
    assert_int_equal(series[1].count, 3);
    check_near(scaling_efficiency(runs, &series[1], 1), 1005.0 / 1250, 1e-12, "efficiency");
    check_near(scaling_efficiency(runs, &series[1], 2), 2, 1e-12, "efficiency");
}

static void runs_that_nothing_joins_make_none(void **state)
{
    (void)state;
    const ScalingRun runs[] = {run_of(1, 1000, 1), run_of(1, 1000, 2), run_of(2, 3000, 1)};
    ScalingSeries series[SCALING_SERIES_MAX];
    assert_int_equal(scaling_series_find(runs, 3, series), 0);
    assert_int_equal(scaling_series_find(runs, 0, series), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strong_and_weak_series_are_found),
        cmocka_unit_test(runs_that_nothing_joins_make_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
