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

static void add(StableRows *rows, uint64_t key, StableFinder finder)
{
    const StableRow row = row_of(key, finder);
    assert_true(stable_rows_add(rows, &row));
}

/* What another map wrote meanwhile stays; of one trial, the one that went on. */
static void rows_of_two_maps_come_together(void **state)
{
    (void)state;
    char path[SCRATCH_SIZE];
    StableRows own = {0}, theirs = {0};
    Error error;
    scratch_name(path, "");
    assert_true(stable_rows_merge(&own, path, &error)); /* no file yet */
    add(&own, 1, FOUND_BY_NOBODY);
    add(&own, 2, FOUND_BY_LOOK);
    add(&own, 3, FOUND_BY_LOOKS);
    add(&theirs, 2, FOUND_BY_SENTINEL);
    add(&theirs, 3, FOUND_BY_LOOK);
    add(&theirs, 4, FOUND_BY_NOBODY);
    assert_true(stable_rows_write(&theirs, path, &error));
    assert_true(stable_rows_merge(&own, path, &error));
    assert_int_equal(own.count, 4);
    assert_int_equal(stable_rows_find(&own, 2)->finder, FOUND_BY_SENTINEL);
    assert_int_equal(stable_rows_find(&own, 3)->finder, FOUND_BY_LOOKS);
    assert_non_null(stable_rows_find(&own, 4));
    stable_rows_free(&own);
    stable_rows_free(&theirs);
}

/* Only one that is not there is empty: what cannot be read is not to be replaced. */
static void an_unreadable_table_is_refused(void **state)
{
    (void)state;
    char path[SCRATCH_SIZE];
    StableRows rows = {0};
    Error error;
    scratch_name(path, "");
    assert_true(stable_rows_read(&rows, path, NULL, &error));
    assert_int_equal(symlink(path, path), 0);
    assert_false(stable_rows_read(&rows, path, NULL, &error));
    assert_non_null(strstr(error.message, "cannot be read: Too many levels of symbolic links"));
    assert_false(stable_rows_merge(&rows, path, &error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_two_maps_come_together),
        cmocka_unit_test(an_unreadable_table_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
