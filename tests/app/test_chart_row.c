/* Rows of a chart: kept in a file, compared with the reference, the front among them. */
#include "tests/sim/fixture.h"

#include "app/chart_row.h"

#include <unistd.h>

static ChartRows rows, again;
static Error error;

static ChartRow *add(ChartRole role, double spacing, double seconds, double off)
{
    ChartRow *row = &rows.row[rows.count];
    *row =
        (ChartRow){.key = 100 + (uint64_t)rows.count, .role = role, .spacing = spacing, .seconds = seconds};
    snprintf(row->method, NAME_SIZE, "wcsph");
    snprintf(row->backend, NAME_SIZE, "cpu");
    snprintf(row->step, NAME_SIZE, "number 0.3");
    row->error = off;
    rows.count++;
    return row;
}

/* A centre that goes from 0 to 2 along x, an energy that goes from 0 to 8, both too great by `shift` of that.
 */
static void set_series(ChartRow *row, double shift)
{
    for (int t = 0; t < CHART_TIMES; t++) {
        const double part = (double)t / (CHART_TIMES - 1);
        row->series[t][0] = 2 * (part + shift);
        row->series[t][3] = 8 * (part + shift);
    }
}

static void distances_are_over_the_range(void **state)
{
    (void)state;
    rows.count = 0;
    set_series(add(CHART_POINT, 0.1, 1, 0), 0.25);
    set_series(add(CHART_POINT, 0.05, 2, 0), 0.125);
    set_series(add(CHART_REFERENCE, 0.02, 9, 0), 0);
    assert_true(isnan(chart_rows_compare(&rows)));
    assert_true(fabs(rows.row[0].error - 0.25) < 1e-12 && fabs(rows.row[1].error - 0.125) < 1e-12);
    assert_true(rows.row[2].error == 0);
    for (int i = 0; i < 3; i++)
        set_series(add(CHART_FLOOR, 0.1, 1, 0), 1e-3 * i * i);
    assert_true(fabs(chart_rows_compare(&rows) - 4e-3) < 1e-12);
}

static void nothing_on_the_front_is_beaten(void **state)
{
    (void)state;
    rows.count = 0;
    add(CHART_POINT, 0.1, 1, 0.3);
    add(CHART_POINT, 0.1, 2, 0.3); /* as near, but dearer */
    add(CHART_POINT, 0.1, 3, 0.1);
    add(CHART_POINT, 0.1, 2.5, 0.4);          /* dearer and farther */
    add(CHART_POINT, 0.1, (double)NAN, 0.01); /* broke */
    add(CHART_REFERENCE, 0.1, 0.5, 0);
    const bool front[] = {true, false, true, false, false, false};
    for (int i = 0; i < rows.count; i++)
        assert_true(chart_on_front(&rows, i) == front[i]);
}

static void a_file_keeps_them(void **state)
{
    (void)state;
    char path[] = "/tmp/slosh_chart_XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    chart_rows_read(&again, path); /* empty: none of ours */
    assert_int_equal(again.count, 0);
    rows.count = 0;
    set_series(add(CHART_POINT, 0.125, 1.5, 0.25), 0.5);
    add(CHART_FLOOR, 0.25, (double)NAN, (double)NAN);
    assert_true(chart_rows_write(&rows, path, &error));
    chart_rows_read(&again, path);
    assert_int_equal(again.count, 2);
    const ChartRow *row = chart_rows_find(&again, 100);
    assert_non_null(row);
    assert_true(row->spacing == 0.125 && row->seconds == 1.5 && row->error == 0.25);
    assert_string_equal(row->step, "number 0.3");
    assert_true(fabs(row->series[CHART_TIMES - 1][3] - 12) < 1e-9);
    assert_true(isnan(again.row[1].seconds) && again.row[1].role == CHART_FLOOR);
    assert_null(chart_rows_find(&again, 7));
    unlink(path);
    assert_false(chart_rows_write(&rows, "/no/such/folder/x.csv", &error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_over_the_range),
        cmocka_unit_test(nothing_on_the_front_is_beaten),
        cmocka_unit_test(a_file_keeps_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
