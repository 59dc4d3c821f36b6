/* slosh chart --views: errors of pictures, the plan, rows that are kept. */
#include "tests/scratch.h"

#include "app/lab/view_benchmark.h"

#include "sim/base/base.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { SIDE = 16, FACTOR = 2, LARGE = SIDE * FACTOR };

/* A picture of noise, the same each time. */
static void noise(uint8_t srgb[3 * LARGE * LARGE])
{
    unsigned state = 1;
    for (int i = 0; i < 3 * LARGE * LARGE; i++) {
        state = state * 1664525U + 1013904223U;
        srgb[i] = (uint8_t)(state >> 24);
    }
}

static void make(LinearPicture *picture, const uint8_t *srgb, int factor)
{
    assert_true(linear_picture_make(picture, srgb, LARGE / factor, LARGE / factor, factor));
}

static void a_picture_against_itself_is_nothing(void **state)
{
    (void)state;
    static uint8_t srgb[3 * LARGE * LARGE];
    LinearPicture a, b;
    noise(srgb);
    make(&a, srgb, FACTOR);
    make(&b, srgb, FACTOR);
    assert_true(picture_rms(&a, &b) == 0);
    assert_float_equal(picture_structure(&a, &b), 0, 1e-12);
    linear_picture_free(&a);
    linear_picture_free(&b);
}

/* Black beside white is half of the light, not of the code. */
static void means_are_of_light(void **state)
{
    (void)state;
    static uint8_t srgb[3 * LARGE * LARGE];
    LinearPicture a;
    for (int i = 0; i < LARGE * LARGE; i++)
        memset(srgb + 3 * (size_t)i, i % 2 ? 255 : 0, 3);
    srgb[1] = 188; /* of the first pixel's green */
    make(&a, srgb, FACTOR);
    assert_float_equal((double)a.rgb[0], 0.5, 1e-6);
    assert_float_equal((double)a.rgb[1], 0.5 + srgb_to_linear(188 / 255.0) / 4, 1e-6);
    assert_float_equal((double)a.rgb[3 * SIDE * SIDE - 1], 0.5, 1e-6);
    linear_picture_free(&a);
}

static void errors_are_what_they_say(void **state)
{
    (void)state;
    static uint8_t dark[3 * LARGE * LARGE], bright[3 * LARGE * LARGE];
    LinearPicture a, b;
    memset(bright, 255, sizeof bright);
    make(&a, dark, 1);
    make(&b, bright, 1);
    assert_float_equal(picture_rms(&a, &b), 1, 1e-6);
    assert_true(picture_structure(&a, &b) > 0.99);
    b.rgb[0] = 0.5F; /* a picture: all non-white pixels */
    assert_float_equal(picture_rms(&a, &b), sqrt(1 - 0.75 / (3.0 * LARGE * LARGE)), 1e-6);
    linear_picture_free(&a);
    linear_picture_free(&b);
}

/* The same noise, moved by a pixel, has the same light and another structure. */
static void structure_sees_what_moved(void **state)
{
    (void)state;
    static uint8_t srgb[3 * LARGE * LARGE], moved[3 * LARGE * LARGE];
    LinearPicture a, b, c;
    noise(srgb);
    memcpy(moved, srgb + 3, sizeof moved - 3);
    make(&a, srgb, 1);
    make(&b, moved, 1);
    for (int i = 0; i < 3 * LARGE * LARGE; i++)
        srgb[i] = (uint8_t)(srgb[i] > 250 ? 255 : srgb[i] + 5);
    make(&c, srgb, 1); /* a little brighter */
    assert_true(picture_structure(&a, &b) > 0.8);
    assert_true(picture_structure(&a, &c) < 0.05);
    linear_picture_free(&a);
    linear_picture_free(&b);
    linear_picture_free(&c);
}

static void plan_of(const char *setting, ViewPlan *plan)
{
    static Args args;
    Error error;
    args = (Args){.scene_count = 1, .scenes = {SLOSH_SOURCE_DIR "/scenes/box_slosh.yaml"}};
    args.settings.set[args.settings.count++] = "view.volume.step=0.5";
    if (*setting)
        args.settings.set[args.settings.count++] = setting;
    if (!view_plan_make(&args, plan, &error))
        fail_msg("%s", error.message);
}

static const ViewJob *job_named(const ViewPlan *plan, const char *view, const char *name)
{
    for (int i = 0; i < plan->count; i++)
        if (strcmp(plan->jobs[i].kind->name, view) == 0 && strcmp(plan->jobs[i].name, name) == 0)
            return &plan->jobs[i];
    return NULL;
}

static bool sets(const ViewJob *job, const char *setting)
{
    for (int i = 0; i < job->set_count; i++)
        if (strcmp(job->set[i], setting) == 0)
            return true;
    return false;
}

static void each_view_has_its_grades(void **state)
{
    (void)state;
    static ViewPlan plan;
    plan_of("", &plan);
    for (int i = 0; view_at(i); i++)
        assert_non_null(job_named(&plan, view_at(i)->name, "as it is"));
    assert_true(plan.reference_count > 4);
    assert_non_null(job_named(&plan, "volume", "step=1"));
    assert_null(job_named(&plan, "volume", "step=0.5")); /* unchanged */
    assert_non_null(job_named(&plan, "volume", "method=slabs"));
    assert_null(job_named(&plan, "splat", "filter_iterations=4")); /* without a filter */
    const ViewJob *coarse = job_named(&plan, "volume", "all coarsest"),
                  *fine = job_named(&plan, "volume", "all finest");
    assert_true(sets(coarse, "--set view.volume.step=4") && sets(coarse, "--set view.volume.cells=24"));
    assert_true(sets(fine, "--set view.volume.step=0.25") && sets(fine, "--set view.volume.cells=192"));
    for (int i = 0; i < fine->set_count; i++)
        assert_null(strstr(fine->set[i], "method")); /* all of them give the same picture */
}

/* The ends of a view with a single grade are runs of the grade. */
static void no_picture_is_planned_twice(void **state)
{
    (void)state;
    static ViewPlan plan;
    plan_of("view.kind=slice", &plan);
    assert_non_null(job_named(&plan, "slice", "samples=64"));
    assert_null(job_named(&plan, "slice", "all coarsest"));
    assert_null(job_named(&plan, "slice", "all finest"));
    plan_of("view.slice.samples=48", &plan); /* an end of its own */
    assert_null(job_named(&plan, "slice", "all coarsest"));
    assert_non_null(job_named(&plan, "slice", "samples=1024"));
}

/* Scene settings finer than all grades, or of a different kind, are the reference's. */
static void a_reference_is_no_coarser_than_the_scene(void **state)
{
    (void)state;
    static ViewPlan plan;
    plan_of("view.volume.cells=300", &plan);
    for (int i = 0; i < plan.reference_count; i++)
        assert_false(sets(&plan.references[i], "--set view.volume.cells=192"));
    assert_true(sets(job_named(&plan, "volume", "all coarsest"), "--set view.volume.cells=24"));
    plan_of("view.splat.shape=ellipsoid", &plan);
    for (int i = 0; i < plan.reference_count; i++)
        assert_false(sets(&plan.references[i], "--set view.splat.shape=perspective"));
}

static void one_view_by_name(void **state)
{
    (void)state;
    static ViewPlan plan;
    plan_of("view.kind=splat", &plan);
    for (int i = 0; i < plan.count; i++)
        assert_string_equal(plan.jobs[i].kind->name, "splat");
    assert_true(plan.count > 4);
}

/* Each grade's values are valid for the key: view_job_scene reads the values. */
static void grades_can_be_set(void **state)
{
    (void)state;
    static ViewPlan plan;
    static Scene scene;
    Error error;
    plan_of("view.splat.filter=narrow_range", &plan);
    assert_non_null(job_named(&plan, "splat", "filter_iterations=4"));
    for (int i = 0; i < plan.count; i++)
        if (!view_job_scene(&plan, &plan.jobs[i], &scene, &error))
            fail_msg("%s", error.message);
}

static ViewRow row_of(uint64_t key, const char *view, double ms, double off)
{
    ViewRow row = {.key = key, .ms = ms, .error = off, .structure = off / 2, .clock = "finish"};
    snprintf(row.view, sizeof row.view, "%s", view);
    snprintf(row.settings, sizeof row.settings, "cells=%d", (int)key);
    return row;
}

static void rows_come_back(void **state)
{
    (void)state;
    Trials rows = {.table = &view_table}, again = {.table = &view_table};
    char path[SCRATCH_SIZE];
    Error error;
    const ViewRow a = row_of(7, "splat", 3.5, 0.25), b = row_of(9, "volume", 12, 0.125),
                  broken = row_of(10, "volume", (double)NAN, (double)NAN);
    scratch_file(path, "");
    assert_true(trials_add(&rows, &a, NULL));
    assert_true(trials_add(&rows, &b, NULL));
    assert_true(trials_add(&rows, &broken, NULL));
    assert_true(trials_add(&rows, &a, NULL)); /* in place */
    assert_int_equal(rows.count, 3);
    assert_true(trials_write(&rows, path, &error));
    FILE *file = fopen(path, "a");
    fputs("0000000000000001,splat,no numbers,finish,x,0,0\n", file);
    fclose(file);
    assert_true(trials_read(&again, path, NULL, &error));
    assert_int_equal(again.count, 2); /* what is not drawn is drawn again */
    assert_memory_equal(trials_find(&again, 7), &a, sizeof a);
    assert_memory_equal(trials_find(&again, 9), &b, sizeof b);
    file = fopen(path, "w");
    fputs("key,role,method,backend,step\n", file);
    fclose(file);
    assert_false(trials_read(&again, path, NULL, &error));
    trials_free(&rows);
    trials_free(&again);
}

/* Only a missing file counts as empty: an unreadable file must not be replaced. */
static void an_unreadable_table_is_refused(void **state)
{
    (void)state;
    Trials rows = {.table = &view_table};
    char path[SCRATCH_SIZE];
    Error error;
    scratch_name(path, "");
    assert_true(trials_read(&rows, path, NULL, &error));
    assert_int_equal(symlink(path, path), 0);
    assert_false(trials_read(&rows, path, NULL, &error));
    assert_non_null(strstr(error.message, "cannot be read: Too many levels of symbolic links"));
}

static void the_front_is_each_views_own(void **state)
{
    (void)state;
    Trials rows = {.table = &view_table};
    const ViewRow all[] = {row_of(1, "splat", 3, 0.2),
                           row_of(2, "splat", 5, 0.1),
                           row_of(3, "splat", 6, 0.15),
                           row_of(4, "volume", 100, 0.5),
                           row_of(5, "splat", 9, 0.0995),
                           row_of(6, "splat", 10, 0.09),
                           row_of(7, "splat", (double)NAN, (double)NAN)};
    const bool front[] = {true, true, false, true, false /* hardly nearer */, true, false};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        assert_true(trials_add(&rows, &all[i], NULL));
    for (int i = 0; i < rows.count; i++)
        assert_int_equal(view_on_front(&rows, i), front[i]);
    trials_free(&rows);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_against_itself_is_nothing),
        cmocka_unit_test(means_are_of_light),
        cmocka_unit_test(errors_are_what_they_say),
        cmocka_unit_test(structure_sees_what_moved),
        cmocka_unit_test(each_view_has_its_grades),
        cmocka_unit_test(no_picture_is_planned_twice),
        cmocka_unit_test(a_reference_is_no_coarser_than_the_scene),
        cmocka_unit_test(one_view_by_name),
        cmocka_unit_test(grades_can_be_set),
        cmocka_unit_test(rows_come_back),
        cmocka_unit_test(an_unreadable_table_is_refused),
        cmocka_unit_test(the_front_is_each_views_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
