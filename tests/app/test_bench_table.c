/* Published tables beside made-up measurements: each figure stands in its row. */
#include "tests/sim/fixture.h"

#include "app/bench/bench.h"
#include "sim/gpu/gl.h"

static BenchResult made_up(size_t particles, const char *view, const char *backend)
{
    BenchResult r = {.particles = particles, .substeps = 1, .threads = 2, .render_ms = 50};
    snprintf(r.view, sizeof r.view, "%s", view);
    snprintf(r.backend, sizeof r.backend, "%s", backend);
    r.stages[STAGE_FORCE].median_ms = 1;
    r.stages[STAGE_SOLVE].median_ms = 2; /* every stage of the solver's counts */
    r.stages[STAGE_GRID].median_ms = 1;
    r.stages[STAGE_VISIBILITY].median_ms = 10;
    r.stages[STAGE_BLEND].median_ms = 25;
    r.stages[STAGE_SHADE].median_ms = 5;
    return r;
}

static char *printed(const char *name, const BenchResult *results, size_t count)
{
    Error error = {{0}};
    char *text = NULL;
    size_t size = 0;
    const BenchTable *table = bench_table_find(name, &error);
    assert_non_null(table);
    FILE *file = open_memstream(&text, &size);
    if (!bench_table_print(table, results, count, file, &error))
        fail_msg("%s", error.message);
    fclose(file);
    return text;
}

/* The words of the first line that begins with the particles and contains `label`, separated by single
   blanks. */
static void expect(const char *text, const char *label, const char *row)
{
    char words[512] = "";
    size_t used = 0;
    const char *at = strstr(text, label);
    assert_non_null(at);
    while (at > text && at[-1] != '\n')
        at--;
    for (; *at && *at != '\n'; at++)
        if (*at != ' ' || (used > 0 && words[used - 1] != ' '))
            words[used++] = *at;
    assert_string_equal(words, row);
}

static void shares_of_passes(void **state)
{
    (void)state;
    BenchResult results[] = {made_up(109744, "splat", "cpu"), made_up(17640, "splat", "cpu")};
    results[0].counts = (ViewCounts){.counted = true, .coverage = 0.125};
    results[0].counts.fragments[STAGE_VISIBILITY] = 7.5;
    results[0].counts.fragments[STAGE_BLEND] = 2.5;
    char *text = printed("paper002-passes", results, 2);
    expect(text, "Beethoven, published", "18000 splat Beethoven, published 25.0 % 45.0 % 30.0 % 47.0 0.85");
    expect(text, "17640", "17640 1 splat cpu 10.000 25.0 % 25.000 62.5 % 5.000 12.5 % 40.000 20.0 0.35");
    expect(text, "109744",
           "109744 1 splat cpu 10.000 25.0 % 25.000 62.5 % 5.000 12.5 % 40.000 20.0 2.19 12.5 % 7.5 2.5");
    free(text);
}

static void times_of_parts(void **state)
{
    (void)state;
    const BenchResult results[] = {made_up(1024, "spheres", "cpu"), made_up(1024, "spheres", "compute")};
    char *text = printed("paper003-spheres", results, 2);
    expect(text, "GPU, published", "1024 1 spheres GPU, published 1.500 16.3 % 7.700 83.7 % 9.200");
    expect(text, "compute", "1024 1 spheres compute 4.000 9.1 % 40.000 90.9 % 44.000");
    assert_null(strstr(text, "8192"));
    free(text);
}

/* Table I: both engines, four parts; the rest is rendering. */
static void times_of_raycasting(void **state)
{
    (void)state;
    BenchResult result = made_up(8192, "volume", "compute");
    result.stages[STAGE_VOXELIZE].median_ms = 8;
    result.stages[STAGE_RAYCAST].median_ms = 28;
    char *text = printed("paper003-raycast", &result, 1);
    expect(text, "CPU, published",
           "1024 1 volume CPU, published 22.000 58.5 % 7.500 19.9 % 7.600 20.2 % 0.510 1.4 % 37.610");
    expect(text, "compute",
           "8192 1 volume compute 4.000 5.0 % 8.000 10.0 % 28.000 35.0 % 40.000 50.0 % 80.000");
    free(text);
}

static void a_row_for_each_value_of_a_setting(void **state)
{
    (void)state;
    BenchResult result = made_up(8192, "volume", "cpu");
    result.stages[STAGE_VOXELIZE].median_ms = 20;
    snprintf(result.swept, sizeof result.swept, "particles=8192, view.volume.method=planes");
    char *text = printed("paper003-voxelize", &result, 1);
    expect(text, "method", "particles substeps view method voxelize slice total");
    expect(text, "planes", "8192 1 volume planes 20.000 80.0 % 5.000 20.0 % 25.000");
    free(text);
}

/* Figure 6: a frame of ten substeps beside one of a single substep, of the same view and backend. */
static void substeps_beside_what_the_paper_says(void **state)
{
    (void)state;
    BenchResult results[] = {made_up(8192, "volume", "cpu"), made_up(8192, "volume", "compute"),
                             made_up(8192, "volume", "cpu"), made_up(8192, "volume", "compute")};
    for (int i = 2; i < 4; i++) {
        results[i].substeps = 10;
        results[i].stages[STAGE_FORCE].median_ms = i == 2 ? 41 : 19;
    }
    char *text = printed("paper003-substeps", results, 4);
    assert_non_null(strstr(text, "roughly only doubles"));
    expect(text, "8192       10  volume    GPU, published", "8192 10 volume GPU, published roughly 2");
    expect(text, "1  volume    cpu", "8192 1 volume cpu 4.000 9.1 % 40.000 90.9 % 44.000 1.00");
    expect(text, "10  volume    cpu", "8192 10 volume cpu 44.000 52.4 % 40.000 47.6 % 84.000 1.91");
    expect(text, "10  volume    compute", "8192 10 volume compute 22.000 35.5 % 40.000 64.5 % 62.000 1.41");
    free(text);
    text = printed("paper003-substeps", results + 3, 1); /* alone: nothing to compare with */
    expect(text, "compute", "8192 10 volume compute 22.000 35.5 % 40.000 64.5 % 62.000 -");
    free(text);
}

static void cases_are_all_views_and_backends(void **state)
{
    (void)state;
    Error error;
    Sweep sweeps[BENCH_TABLE_SWEEPS + 1];
    assert_int_equal(bench_table_sweeps(bench_table_find("paper003-spheres", &error), sweeps), 3);
    assert_string_equal(sweeps[0].key, "view.kind");
    assert_true(sweeps[0].count >= 2 && sweeps[1].count == 4 && sweeps[2].count == 3);
    assert_int_equal(bench_table_sweeps(bench_table_find("paper002-passes", &error), sweeps), 1);
    const char *const *scenes;
    assert_int_equal(bench_table_scenes(bench_table_find("paper003-raycast", &error), &scenes), 1);
    assert_int_equal(bench_table_scenes(bench_table_find("paper002-passes", &error), &scenes), 4);
    assert_string_equal(scenes[1], "scenes/papers/goop_on_bust.yaml");
    assert_true(sweeps[0].count == 1 && strcmp(sweeps[0].values[0], "splat") == 0);
    assert_int_equal(bench_table_sweeps(bench_table_find("paper003-voxelize", &error), sweeps), 3);
    assert_true(strcmp(sweeps[2].key, "view.volume.method") == 0 && sweeps[2].count == 8);
    assert_int_equal(bench_table_sweeps(bench_table_find("paper003-raycast", &error), sweeps), 3);
    assert_true(sweeps[0].count == 1 && strcmp(sweeps[0].values[0], "volume") == 0 && sweeps[2].count == 3);
    assert_null(bench_table_find("paper9", &error));
}

static int setup(void **state)
{
    (void)state;
    backends_add();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_row_for_each_value_of_a_setting),
        cmocka_unit_test(times_of_raycasting),
        cmocka_unit_test(shares_of_passes),
        cmocka_unit_test(times_of_parts),
        cmocka_unit_test(substeps_beside_what_the_paper_says),
        cmocka_unit_test(cases_are_all_views_and_backends),
    };
    return cmocka_run_group_tests_name("app.bench_table", tests, setup, NULL);
}
