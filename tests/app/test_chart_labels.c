/* Charts: names of points are not over each other, not over points, not beyond the frame, near where there is
   room; series. */
#include "tests/scratch.h"
#include "tests/sim/fixture.h"

#include "app/bench/plot.h"

static LabelField field;

static double random_part(void)
{
    static uint32_t seed = 7;
    seed = seed * 1664525U + 1013904223U;
    return (double)(seed >> 8) / 0x1p24;
}

static void lone_name_stands_to_the_right(void **state)
{
    (void)state;
    LabelBox place;
    field = (LabelField){.frame = {0, 0, 400, 300}};
    label_field_point(&field, 100, 100);
    assert_true(label_place(&field, 100, 100, 80, 11, 120, &place));
    assert_true(place.left > 100 && place.left < 110 && place.top < 100 && place.bottom > 100);
    assert_true(label_place(&field, 395, 150, 80, 11, 120, &place)); /* at the frame: to the left */
    assert_true(place.right <= 400 && place.left > 300);
    assert_false(label_place(&field, 200, 150, 401, 11, 120, &place)); /* wider than the frame */
}

/* A line is kept off where there is room elsewhere, and is no obstacle where there is none. */
static void a_line_is_kept_off(void **state)
{
    (void)state;
    LabelBox place;
    field = (LabelField){.frame = {0, 0, 400, 300}};
    label_field_line(&field, 100, 100, 300, 100);
    assert_true(label_place(&field, 100, 100, 80, 11, 120, &place));
    assert_true(place.bottom < 100 || place.top > 100 || place.right < 100);
    field = (LabelField){.frame = {90, 90, 200, 110}};
    label_field_line(&field, 90, 100, 200, 100);
    assert_true(label_place(&field, 100, 100, 80, 18, 120, &place));
}

static void names_of_many_points_do_not_overlap(void **state)
{
    (void)state;
    enum { N = 60 };
    static LabelBox place[N];
    for (int round = 0; round < 50; round++) {
        double x[N], y[N];
        int placed = 0;
        field = (LabelField){.frame = {50, 20, 500, 390}};
        for (int i = 0; i < N; i++) {
            x[i] = 50 + 450 * random_part();
            y[i] = 20 + 370 * random_part();
            label_field_point(&field, x[i], y[i]);
        }
        for (int i = 0; i < N; i++)
            placed += label_place(&field, x[i], y[i], 100 + 40 * random_part(), 11, 120, &place[placed]);
        assert_true(placed > N / 4);
        for (int i = 0; i < placed; i++) {
            assert_true(place[i].left >= 50 && place[i].right <= 500 && place[i].top >= 20 &&
                        place[i].bottom <= 390);
            for (int k = 0; k < i; k++)
                assert_true(place[i].left >= place[k].right || place[k].left >= place[i].right ||
                            place[i].top >= place[k].bottom || place[k].top >= place[i].bottom);
            for (int k = 0; k < N; k++)
                assert_false(x[k] > place[i].left && x[k] < place[i].right && y[k] > place[i].top &&
                             y[k] < place[i].bottom);
        }
    }
}

/* An empty series would stop gnuplot; a title has any letters; a value that is not known is a gap. */
static void a_series_without_points_is_not_drawn(void **state)
{
    (void)state;
    static char svg[1 << 18];
    char path[SCRATCH_SIZE];
    Plot plot = {.gnuplot = NULL};
    Error error;
    scratch_file(path, ".svg");
    if (!plot_begin(&plot, path, 400, 300, &error))
        fail_msg("%s", error.message);
    plot_series(&plot, "nobody", "with lines lt 1");
    plot_series(&plot, "Rayleigh's wave", "with lines lt 2");
    for (int i = 0; i < 5; i++)
        plot_point(&plot, i, i == 2 ? (double)NAN : i);
    plot_series(&plot, "left out", "with lines lt 3");
    plot_point(&plot, 1, 1);
    plot_drop(&plot);
    plot_draw(&plot, NULL);
    if (!plot_end(&plot, &error))
        fail_msg("%s", error.message);
    FILE *in = fopen(path, "r");
    assert_non_null(in);
    svg[fread(svg, 1, sizeof svg - 1, in)] = 0;
    fclose(in);
    assert_non_null(strstr(svg, "Rayleigh"));
    assert_null(strstr(svg, "nobody"));
    assert_null(strstr(svg, "left out"));
}

static void a_panel_without_series_says_so(void **state)
{
    (void)state;
    static char svg[1 << 18];
    char path[SCRATCH_SIZE];
    Plot plot = {.gnuplot = NULL};
    Error error;
    scratch_file(path, ".svg");
    assert_true(plot_begin(&plot, path, 400, 300, &error));
    plot_panel(&plot, (LabelBox){60, 20, 380, 200}, 60, 240);
    plot_draw(&plot, "no error known");
    if (!plot_end(&plot, &error))
        fail_msg("%s", error.message);
    FILE *in = fopen(path, "r");
    assert_non_null(in);
    svg[fread(svg, 1, sizeof svg - 1, in)] = 0;
    fclose(in);
    assert_non_null(strstr(svg, "no error known"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lone_name_stands_to_the_right),
        cmocka_unit_test(a_line_is_kept_off),
        cmocka_unit_test(names_of_many_points_do_not_overlap),
        cmocka_unit_test(a_series_without_points_is_not_drawn),
        cmocka_unit_test(a_panel_without_series_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
