/* slosh stability: trials that are kept. */
#include "tests/scratch.h"

#include "app/lab/stability.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static StableRow row_of(uint64_t key, StableFinder finder)
{
    StableRow row = {.key = key, .method = "mueller", .backend = "cpu", .steps = 7, .finder = finder};
    row.outcome.kind = finder == FOUND_BY_NOBODY ? OUTCOME_HOLDS : OUTCOME_BLOWN_UP;
    return row;
}

static void add(Trials *rows, uint64_t key, StableFinder finder)
{
    const StableRow row = row_of(key, finder);
    assert_true(trials_add(rows, &row, NULL));
}

/* Rows written meanwhile by a second map stay; of a trial, the row of the longer run. */
static void rows_of_two_maps_come_together(void **state)
{
    (void)state;
    char path[SCRATCH_SIZE];
    Trials own = {.table = &stable_table}, theirs = {.table = &stable_table};
    Error error;
    scratch_name(path, "");
    assert_true(trials_merge(&own, path, NULL, &error)); /* no file yet */
    add(&own, 1, FOUND_BY_NOBODY);
    add(&own, 2, FOUND_BY_LOOK);
    add(&own, 3, FOUND_BY_LOOKS);
    add(&theirs, 2, FOUND_BY_SENTINEL);
    add(&theirs, 3, FOUND_BY_LOOK);
    add(&theirs, 4, FOUND_BY_NOBODY);
    assert_true(trials_write(&theirs, path, &error));
    assert_true(trials_merge(&own, path, NULL, &error));
    assert_int_equal(own.count, 4);
    assert_int_equal(((StableRow *)trials_find(&own, 2))->finder, FOUND_BY_SENTINEL);
    assert_int_equal(((StableRow *)trials_find(&own, 3))->finder, FOUND_BY_LOOKS);
    assert_non_null(trials_find(&own, 4));
    trials_free(&own);
    trials_free(&theirs);
}

/* Only a missing file counts as empty: an unreadable file must not be replaced. */
static void an_unreadable_table_is_refused(void **state)
{
    (void)state;
    char path[SCRATCH_SIZE];
    Trials rows = {.table = &stable_table};
    Error error;
    scratch_name(path, "");
    assert_true(trials_read(&rows, path, NULL, &error));
    assert_int_equal(symlink(path, path), 0);
    assert_false(trials_read(&rows, path, NULL, &error));
    assert_non_null(strstr(error.message, "cannot be read: Too many levels of symbolic links"));
    assert_false(trials_merge(&rows, path, NULL, &error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_two_maps_come_together),
        cmocka_unit_test(an_unreadable_table_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
