/* Rows of a chart: kept in a file, compared with the reference, the front among them. */
#include "tests/scratch.h"
#include "tests/sim/fixture.h"

#include "app/lab/error_chart.h"

#include <unistd.h>

static Trials kept = {.table = &chart_table};
static ChartRows rows = {.trials = &kept};
static Trials again = {.table = &chart_table};
static Error error;

static const ChartRow *again_row(int i)
{
    return trials_row(&again, i);
}

static ChartRow *add(ChartRole role, double spacing, double seconds, double off)
{
    static ChartRow none;
    ChartRow *row = trials_append(rows.trials, &none);
    *row = (ChartRow){
        .key = 99 + (uint64_t)rows.trials->count, .role = role, .spacing = spacing, .seconds = seconds};
    rows.trials->keys[rows.trials->count - 1] = row->key;
    snprintf(row->method, NAME_SIZE, "wcsph");
    snprintf(row->backend, NAME_SIZE, "cpu");
    snprintf(row->step, NAME_SIZE, "number 0.3");
    row->quantities = 4;
    row->outcome = (Outcome){.kind = OUTCOME_HOLDS, .time = (double)NAN};
    rows.metric_count = metric_defaults(rows.metrics);
    row->error = off;
    return row;
}

/* A centre from 0 to 2 along x, an energy from 0 to 8, each too large by the fraction `shift`. */
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
    rows.trials->count = 0;
    set_series(add(CHART_POINT, 0.1, 1, 0), 0.25);
    set_series(add(CHART_POINT, 0.05, 2, 0), 0.125);
    set_series(add(CHART_REFERENCE, 0.02, 9, 0), 0);
    assert_true(isnan(chart_rows_compare(&rows)));
    assert_true(fabs(chart_row(&rows, 0)->error - 0.25) < 1e-12 &&
                fabs(chart_row(&rows, 1)->error - 0.125) < 1e-12);
    assert_true(chart_row(&rows, 2)->error == 0);
    for (int i = 0; i < 3; i++)
        set_series(add(CHART_FLOOR, 0.1, 1, 0), 1e-3 * i * i);
    set_series(add(CHART_FLOOR, 0.1, (double)NAN, 0), 9); /* broke on the way: its series ends anywhere */
    assert_true(fabs(chart_rows_compare(&rows) - 4e-3) < 1e-12);
    chart_row(&rows, 2)->seconds = (double)NAN;
    assert_null(chart_rows_reference(&rows));
}

/* Fluid that fills the box keeps the centre: only energy tells two runs apart. */
static void what_does_not_change_is_left_out(void **state)
{
    (void)state;
    rows.trials->count = 0;
    ChartRow *row = add(CHART_POINT, 0.1, 1, 0), *reference = add(CHART_REFERENCE, 0.02, 9, 0);
    set_series(row, 0.25);
    set_series(reference, 0);
    for (int t = 0; t < CHART_TIMES; t++)
        row->series[t][0] = reference->series[t][0] = 0;
    assert_true(fabs(chart_distance(&rows, row, reference) - 0.25) < 1e-12);
    assert_true(chart_changes(&rows, reference));
    for (int t = 0; t < CHART_TIMES; t++) /* nothing does: no distance is known */
        reference->series[t][3] = 5;
    assert_true(isnan(chart_distance(&rows, row, reference)));
    assert_false(chart_changes(&rows, reference));
    row->quantities = 0; /* of other metrics, or cut */
    assert_true(isnan(chart_distance(&rows, row, reference)));
}

/* Metrics have equal weight in any unit; metrics missing in a run are left out. */
static void metrics_count_alike(void **state)
{
    (void)state;
    rows.trials->count = 0;
    ChartRow *row = add(CHART_POINT, 0.1, 1, 0), *reference = add(CHART_REFERENCE, 0.02, 9, 0);
    set_series(row, 0);
    set_series(reference, 0);
    for (int t = 0; t < CHART_TIMES; t++)
        row->series[t][3] += 1; /* of 8 */
    assert_true(fabs(chart_distance(&rows, row, reference) - 0.5 / 8) < 1e-12);
    rows.metrics[0] = 1;
    rows.metric_count = 1; /* kinetic energy alone: the first number */
    for (int t = 0; t < CHART_TIMES; t++)
        row->series[t][0] += 0.5; /* of 2 */
    assert_true(fabs(chart_distance(&rows, row, reference) - 0.25) < 1e-12);
    for (int t = 0; t < CHART_TIMES / 2; t++)
        row->series[t][0] = (double)NAN;
    assert_true(fabs(chart_distance(&rows, row, reference) - 0.25) < 1e-12);
    for (int t = 0; t < CHART_TIMES; t++)
        row->series[t][0] = (double)NAN;
    assert_true(isnan(chart_distance(&rows, row, reference)));
}

/* Each probe relative to the probe's range, all combined to a metric; constant probes are left out. */
static void probes_count_as_one(void **state)
{
    (void)state;
    rows.trials->count = 0;
    ChartRow *row = add(CHART_POINT, 0.1, 1, 0), *reference = add(CHART_REFERENCE, 0.02, 9, 0);
    for (rows.metrics[1] = 0; metric_kinds[rows.metrics[1]].numbers != 0; rows.metrics[1]++)
        ;
    rows.metrics[0] = 1; /* kinetic energy */
    rows.metric_count = 2;
    rows.probe_count = 3;
    for (int t = 0; t < CHART_TIMES; t++) {
        const double share = t / (CHART_TIMES - 1.0);
        const double right[] = {share, 1000 * share, 0.1 * share, 7};
        for (int q = 0; q < 4; q++)
            reference->series[t][q] = row->series[t][q] = right[q];
        row->series[t][1] += 100;  /* a tenth of its range */
        row->series[t][2] += 0.03; /* three tenths */
        row->series[t][3] += 1;    /* of none */
    }
    assert_true(fabs(chart_distance(&rows, row, reference) - 0.5 * (0 + 0.2)) < 1e-12);
    rows.probe_count = 4; /* more than the rows have */
    assert_true(isnan(chart_distance(&rows, row, reference)));
    rows.probe_count = 0;
}

static void nothing_on_the_front_is_beaten(void **state)
{
    (void)state;
    rows.trials->count = 0;
    add(CHART_POINT, 0.1, 1, 0.3);
    add(CHART_POINT, 0.1, 2, 0.3); /* as near, but dearer */
    add(CHART_POINT, 0.1, 3, 0.1);
    add(CHART_POINT, 0.1, 2.5, 0.4);          /* dearer and farther */
    add(CHART_POINT, 0.1, (double)NAN, 0.01); /* broke */
    add(CHART_REFERENCE, 0.1, 0.5, 0);
    const bool front[] = {true, false, true, false, false, false};
    for (int i = 0; i < rows.trials->count; i++)
        assert_true(chart_on_front(&rows, i) == front[i]);
}

/* Lines of error ~ spacing^2 and ~ spacing, the best settings for the time, the floor, the words. */
static void the_chart_says_its_orders(void **state)
{
    (void)state;
    char file_path[SCRATCH_SIZE];
    static char svg[1 << 20];
    const ChartWords words = {"A title", "error: front", "backend x left out: none here"};
    scratch_file(file_path, ".svg");
    rows.trials->count = 0;
    for (int i = 0; i < 3; i++) {
        const double spacing = 0.1 / (1 << i);
        add(CHART_POINT, spacing, pow(8, i), spacing * spacing)->particles = 1000 + (size_t)i;
        snprintf(add(CHART_POINT, spacing, pow(8, i), spacing)->method, NAME_SIZE, "mueller");
        snprintf(add(CHART_POINT, spacing, 20 * pow(8, i), 2 * spacing)->swept, CHART_SWEPT, "support=2.6");
        add(CHART_POINT, spacing, 9 * pow(8, i), i == 1 ? 0.3 : 0.2)->fineness = 1;
    }
    assert_true(chart_draw(&rows, &words, 1e-4, file_path, &error));
    FILE *in = fopen(file_path, "r");
    assert_non_null(in);
    svg[fread(svg, 1, sizeof svg - 1, in)] = 0;
    fclose(in);
    const char *const there[] = {"wcsph, cpu, long steps: order 2.00",
                                 "mueller, cpu, long steps: order 1.00",
                                 "wcsph, cpu, support=2.6, long steps: order 1.00",
                                 "wcsph, cpu, fine steps: no order: errors do not fall",
                                 "1002, number 0.3",
                                 "runs that differ by 1e-6",
                                 "best for its time",
                                 "A title",
                                 "backend x left out: none here",
                                 "error: front"};
    for (size_t i = 0; i < sizeof there / sizeof *there; i++)
        if (!strstr(svg, there[i]))
            fail_msg("the chart does not say '%s'", there[i]);
    assert_null(strstr(svg, ">0, number")); /* what is behind at every time has no label */
}

static char path[SCRATCH_SIZE];

static int make_file(void **state)
{
    (void)state;
    scratch_file(path, "");
    return 0;
}

static int remove_file(void **state)
{
    (void)state;
    return unlink(path);
}

static void a_file_keeps_them(void **state)
{
    (void)state;
    assert_true(trials_read(&again, path, NULL, &error)); /* empty */
    assert_int_equal(again.count, 0);
    rows.trials->count = 0;
    set_series(add(CHART_POINT, 0.125, 1.5, 0.25), 0.5);
    snprintf(chart_row(&rows, 0)->swept, CHART_SWEPT, "gravity=[0, -9, 0] kernel=cubic");
    add(CHART_FLOOR, 0.25, (double)NAN, (double)NAN)->outcome =
        (Outcome){OUTCOME_BLOWN_UP, 0.375, "a particle moves too far, much too far"};
    assert_true(trials_write(rows.trials, path, &error));
    assert_true(trials_read(&again, path, NULL, &error));
    assert_int_equal(again.count, 2);
    const ChartRow *row = trials_find(&again, 100);
    assert_non_null(row);
    assert_true(row->spacing == 0.125 && row->seconds == 1.5 && row->error == 0.25);
    assert_string_equal(row->step, "number 0.3");
    assert_true(fabs(row->series[CHART_TIMES - 1][3] - 12) < 1e-9);
    assert_true(isnan(again_row(1)->seconds) && again_row(1)->role == CHART_FLOOR);
    assert_true(row->outcome.kind == OUTCOME_HOLDS && isnan(row->outcome.time) && !*row->outcome.words);
    assert_true(again_row(1)->outcome.kind == OUTCOME_BLOWN_UP && again_row(1)->outcome.time == 0.375);
    assert_string_equal(again_row(1)->outcome.words, chart_row(&rows, 1)->outcome.words);
    assert_string_equal(row->swept, "gravity=[0, -9, 0] kernel=cubic");
    assert_string_equal(again_row(1)->swept, "");
    assert_null(trials_find(&again, 7));
    assert_false(trials_write(rows.trials, "/no/such/folder/x.csv", &error));
}

static void write_text(const char *text, size_t size)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    fclose(file);
}

/* Wherever the file is cut or a row is damaged, only rows that were written are read. */
static void half_a_row_is_none(void **state)
{
    (void)state;
    static char whole[16384];
    rows.trials->count = 0;
    for (int i = 0; i < 2; i++)
        set_series(add(CHART_POINT, 0.125, 1.5, 0.25), 0.5 + i);
    assert_true(trials_write(rows.trials, path, &error));
    assert_true(trials_read(rows.trials, path, NULL, &error)); /* as printed */
    FILE *file = fopen(path, "r");
    const size_t size = fread(whole, 1, sizeof whole, file);
    fclose(file);
    const size_t second = (size_t)(strstr(whole, "0000000000000065,") - whole);
    for (size_t cut = second; cut < size; cut += cut < second + 200 || cut > size - 20 ? 1 : 97) {
        write_text(whole, cut);
        assert_true(trials_read(&again, path, NULL, &error));
        assert_int_equal(again.count, 1);
        assert_memory_equal(again_row(0)->series, chart_row(&rows, 0)->series,
                            sizeof chart_row(&rows, 0)->series);
    }
    for (size_t at = second; at < size; at++)
        if (strchr(", ;", whole[at]) && strncmp(whole + at, " 0.3", 4) != 0) { /* that is in a name */
            const char right = whole[at];
            whole[at] = 'x';
            write_text(whole, size);
            assert_true(trials_read(&again, path, NULL, &error));
            assert_int_equal(again.count, 1);
            whole[at] = right;
        }
}

/* As edited by hand, or damaged: said with its line, and none of the chart. */
static void an_impossible_row_is_left_out(void **state)
{
    (void)state;
    static const char *const cells[][2] = {
        {",1.5,", ",-1,"},   {",1.5,", ",0,"},      {",1.5,", ",inf,"}, {",0.25,", ",-0.25,"},
        {",0.25,", ",inf,"}, {"0.125", "-2"},       {"0.125", "nan"},   {",1.5,", ",seven,"},
        {",1000,", ",-3,"},  {",holds,", ",fine,"},
    };
    static const char *const wrong[] = {"seconds_a_simulated_second",
                                        "seconds_a_simulated_second",
                                        "seconds_a_simulated_second",
                                        "error",
                                        "error",
                                        "spacing_m",
                                        "spacing_m",
                                        "row",
                                        "particles",
                                        "row"};
    static char whole[16384], spoilt[16384];
    rows.trials->count = 0;
    for (int i = 0; i < 2; i++) {
        add(CHART_POINT, 0.125, 1.5, 0.25);
        chart_row(&rows, i)->particles = 1000;
    }
    assert_true(trials_write(rows.trials, path, &error));
    FILE *file = fopen(path, "r");
    whole[fread(whole, 1, sizeof whole - 1, file)] = '\0';
    fclose(file);
    const char *second = strstr(whole, "0000000000000065,");
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char *said = NULL, expected[400];
        size_t size = 0;
        const char *cell = strstr(second, cells[i][0]);
        assert_non_null(cell);
        snprintf(spoilt, sizeof spoilt, "%.*s%s%s", (int)(cell - whole), whole, cells[i][1],
                 cell + strlen(cells[i][0]));
        write_text(spoilt, strlen(spoilt));
        file = open_memstream(&said, &size);
        assert_true(trials_read(&again, path, file, &error));
        fclose(file);
        assert_int_equal(again.count, 1);
        snprintf(expected, sizeof expected,
                 "%s:3: this %s is none that a chart writes; the row is left out, its run made again\n", path,
                 wrong[i]);
        assert_string_equal(said, expected);
        free(said);
    }
}

static void another_s_file_is_kept(void **state)
{
    (void)state;
    static const char theirs[] = "day,rain\n1,0.5\n", older[] = "key,role,method,backend,more\n1,0,a,b,c\n";
    write_text(theirs, sizeof theirs - 1);
    assert_false(trials_read(&again, path, NULL, &error));
    assert_non_null(strstr(error.message, "no chart wrote it"));
    write_text(older, sizeof older - 1);
    char *said = NULL, expected[400];
    size_t size = 0;
    FILE *file = open_memstream(&said, &size);
    assert_true(trials_read(&again, path, file, &error));
    fclose(file);
    assert_int_equal(again.count, 0);
    snprintf(expected, sizeof expected,
             "%s: is of another version of slosh; its rows are left out, its runs made again\n", path);
    assert_string_equal(said, expected);
    free(said);
}

/* An unreadable file may belong to the user: here a link to the same path. */
static void an_unreadable_file_is_kept(void **state)
{
    (void)state;
    assert_int_equal(unlink(path), 0);
    assert_true(trials_read(&again, path, NULL, &error)); /* none */
    assert_int_equal(symlink(path, path), 0);
    assert_false(trials_read(&again, path, NULL, &error));
    assert_non_null(strstr(error.message, "cannot be read"));
}

/* Two charts write to the same file: no rows are lost. A full file drops the oldest rows. */
static void others_rows_stay(void **state)
{
    (void)state;
    Trials mine = {.table = &chart_table}, plan = {.table = &chart_table};
    rows.trials->count = 0;
    add(CHART_POINT, 0.1, 1, 0);
    add(CHART_POINT, 0.2, 1, 0);
    assert_true(trials_write(rows.trials, path, &error));
    assert_non_null(trials_append(&mine, chart_row(&rows, 1)));
    assert_true(trials_merge(&mine, path, &plan, &error));
    assert_int_equal(mine.count, 2);
    assert_non_null(trials_find(&mine, 100));

    rows.trials->count = 0;
    while (rows.trials->count < CHART_ROWS_MAX)
        add(CHART_POINT, 0.1, 1, 0);
    assert_non_null(trials_append(&plan, chart_row(&rows, 0)));
    ChartRow next = *chart_row(&rows, 0);
    next.key = 7;
    assert_true(trials_add(rows.trials, &next, &plan));
    assert_int_equal(rows.trials->count, CHART_ROWS_MAX);
    assert_non_null(trials_find(rows.trials, 7));
    assert_non_null(trials_find(rows.trials, 100));
    assert_null(trials_find(rows.trials, 101));
    assert_non_null(trials_find(rows.trials, 102));
    trials_free(&mine);
    trials_free(&plan);
}

/* A line that opens with `first`: an order, or why there is none. */
static void assert_order(double a, double b, double c, double floor, const char *expected)
{
    const char *why;
    rows.trials->count = 0;
    add(CHART_POINT, 0.2, 1, a);
    add(CHART_POINT, 0.15, 2, b);
    add(CHART_POINT, 0.1, 4, c);
    const double order = chart_order(&rows, 0, floor, &why);
    if (expected ? !why || strcmp(why, expected) != 0 || !isnan(order) : why || !(order > 0))
        fail_msg("%g, %g, %g: order %g, %s", a, b, c, order, why ? why : "no reason");
}

static void an_order_is_of_errors_that_fall(void **state)
{
    (void)state;
    const double none = (double)NAN;
    const char *const rises = "errors do not fall", *const low = "errors reach the spread",
                      *const few = "fewer than three runs";
    assert_order(0.04, 0.0225, 0.01, none, NULL);
    assert_order(0.0034, 0.031, 0.0008, none, rises); /* couette's: a line through them has the order 2.45 */
    assert_order(0.01, 0.02, 0.03, none, rises);
    assert_order(0.01, 0.01, 0.01, none, rises);
    assert_order(0.04, 0.02, 0.01, 0.009, NULL);
    assert_order(0.04, 0.02, 0.01, 0.011, low);
    assert_order(0.04, 0.02, none, none, few); /* broke */
    assert_order(0.04, 0.02, 0, none, few);    /* no error at all has no logarithm */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_over_the_range),
        cmocka_unit_test(metrics_count_alike),
        cmocka_unit_test(probes_count_as_one),
        cmocka_unit_test(the_chart_says_its_orders),
        cmocka_unit_test(an_order_is_of_errors_that_fall),
        cmocka_unit_test(what_does_not_change_is_left_out),
        cmocka_unit_test(nothing_on_the_front_is_beaten),
        cmocka_unit_test_setup_teardown(a_file_keeps_them, make_file, remove_file),
        cmocka_unit_test_setup_teardown(half_a_row_is_none, make_file, remove_file),
        cmocka_unit_test_setup_teardown(an_impossible_row_is_left_out, make_file, remove_file),
        cmocka_unit_test_setup_teardown(another_s_file_is_kept, make_file, remove_file),
        cmocka_unit_test_setup_teardown(an_unreadable_file_is_kept, make_file, remove_file),
        cmocka_unit_test_setup_teardown(others_rows_stay, make_file, remove_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
