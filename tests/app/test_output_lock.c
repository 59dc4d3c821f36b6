#define _GNU_SOURCE /* F_OFD_SETLK */
/* One writer a file, whatever the names and whatever the file system can. */
#include "tests/app/output_fixture.h"

#include "app/base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/syscall.h>

/* In libc's place: a file system that has no locks. */
static int no_locks;

int fcntl(int file, int command, ...) /* NOLINT(readability-inconsistent-declaration-parameter-name) */
{
    va_list arguments;
    va_start(arguments, command);
    void *argument = va_arg(arguments, void *);
    va_end(arguments);
    if (no_locks && command == F_OFD_SETLK) {
        errno = no_locks;
        return -1;
    }
    return (int)syscall(SYS_fcntl, file, command, argument);
}

static void begin(Output *output, OutputLock *lock, OutputLock *older, const char *path)
{
    Error error = {{0}};
    if (!output_begin(output, path, &error) || !output_lock(older, path, &error) ||
        !output_lock(lock, output->temp, &error))
        fail_msg("%s", error.message);
}

static void assert_busy(const char *path)
{
    OutputLock lock = {.state = OUTPUT_UNLOCKED};
    Error error = {{0}};
    assert_false(output_lock(&lock, path, &error));
    assert_contains(error.message,
                    "is being written by another slosh; wait for its end, or name another file");
    assert_int_equal(lock.state, OUTPUT_UNLOCKED);
}

/* Both writers began before the file existed. Two programs have separate temporary names, but this
   program does not: the second writer begins with a different name. */
static void the_second_to_commit_is_refused(void **state)
{
    (void)state;
    Output one = {.path = ""}, other = {.path = ""};
    OutputLock locks[4] = {{.file = 0}};
    Error error = {{0}};
    begin(&one, &locks[0], &locks[1], "a");
    begin(&other, &locks[2], &locks[3], "b");
    strcpy(other.path, "a");
    strcpy(other.target, "a");
    write_text(one.temp, "one");
    assert_true(output_lock_commit(&locks[1], &one, &error));
    assert_busy("a");
    assert_false(output_lock_commit(&locks[3], &other, &error));
    assert_contains(error.message, "a: is being written by another slosh");
    assert_text("a", "one");
    assert_int_equal(count_files("."), 1);
    output_unlock(&locks[0]);
    output_unlock(&locks[0]);
    assert_true(output_lock(&locks[3], "a", &error));
    for (int i = 0; i < 4; i++)
        output_unlock(&locks[i]);
}

static void an_older_file_is_held_until_it_is_replaced(void **state)
{
    (void)state;
    Output one = {.path = ""};
    OutputLock lock = {.file = 0}, older = {.file = 0};
    Error error = {{0}};
    write_text("a", "old");
    symlink("a", "b");
    link("a", "c");
    begin(&one, &lock, &older, "a");
    assert_busy("a");
    assert_busy("b");
    assert_busy("c");
    write_text(one.temp, "one");
    assert_true(output_lock_commit(&older, &one, &error));
    assert_text("a", "one");
    assert_busy("a");
    assert_true(output_lock(&older, "c", &error)); /* still the old file */
    output_unlock(&older);
    output_unlock(&lock);
    assert_true(output_lock(&lock, "a", &error));
    output_unlock(&lock);
}

/* The file is removed, or put in another's place, by hand. */
static void what_happens_to_the_older_file_is_noticed(void **state)
{
    (void)state;
    for (int replaced = 0; replaced < 2; replaced++) {
        Output one = {.path = ""};
        OutputLock lock = {.file = 0}, older = {.file = 0};
        Error error = {{0}};
        write_text("a", "old");
        begin(&one, &lock, &older, "a");
        write_text(one.temp, "one");
        write_text("b", "other");
        assert_int_equal(replaced ? rename("b", "a") : unlink("a"), 0);
        assert_true(output_lock_commit(&older, &one, &error));
        assert_text("a", "one");
        assert_busy("a");
        output_unlock(&lock);
    }
}

static void where_there_are_no_locks_that_is_said_once(void **state)
{
    (void)state;
    const int reasons[] = {ENOLCK, EINVAL, EOPNOTSUPP};
    const int before = dup(STDERR_FILENO);
    write_text("a", "old");
    assert_non_null(freopen("said", "w", stderr));
    for (int i = 0; i < 3; i++) {
        Output one = {.path = ""};
        OutputLock lock = {.file = 0}, older = {.file = 0};
        Error error = {{0}};
        no_locks = reasons[i];
        begin(&one, &lock, &older, "a");
        assert_int_equal(older.state, OUTPUT_UNLOCKABLE);
        write_text(one.temp, "one");
        assert_true(output_lock_commit(&older, &one, &error));
        assert_text("a", "one");
        output_unlock(&lock);
    }
    no_locks = 0;
    fflush(stderr);
    dup2(before, STDERR_FILENO);
    assert_text("said",
                "a: cannot be locked here (No locks available): another slosh that writes the same file "
                "will not be noticed\n");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, folder_setup, folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(the_second_to_commit_is_refused),
        TEST(an_older_file_is_held_until_it_is_replaced),
        TEST(what_happens_to_the_older_file_is_noticed),
        TEST(where_there_are_no_locks_that_is_said_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
