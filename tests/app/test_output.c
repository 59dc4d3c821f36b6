/* Files that appear whole or not at all. */
#include "tests/app/output_fixture.h"

#include "app/base/file.h"
#include "app/base/program.h"

#include <signal.h>
#include <sys/wait.h>

static void a_new_file_appears_at_the_commit(void **state)
{
    (void)state;
    Output output = {0};
    Error error = {{0}};
    assert_true(output_begin(&output, "new.txt", &error));
    write_text(output.temp, "whole");
    assert_false(exists("new.txt"));
    assert_true(output_commit(&output, &error));
    assert_text("new.txt", "whole");
    assert_int_equal(count_files("."), 1);
    output_discard(&output); /* no effect any more */
    assert_true(exists("new.txt"));
}

static void an_old_file_stays_until_then(void **state)
{
    (void)state;
    Output output = {0};
    Error error = {{0}};
    write_text("old.txt", "old");
    assert_true(output_begin(&output, "old.txt", &error));
    write_text(output.temp, "half");
    output_discard(&output);
    assert_text("old.txt", "old");
    assert_int_equal(count_files("."), 1);
    assert_true(output_begin(&output, "old.txt", &error));
    write_text(output.temp, "new");
    assert_true(output_commit(&output, &error));
    assert_text("old.txt", "new");
    assert_int_equal(count_files("."), 1);
}

/* An unused process number: of a finished child. */
static long dead(void)
{
    const pid_t child = fork();
    if (child == 0)
        _exit(0);
    waitpid(child, NULL, 0);
    return child;
}

/* As of a trial of the stability command that a driver ends. */
static void a_child_that_crashes_leaves_the_files_of_its_parent(void **state)
{
    (void)state;
    Output output = {0};
    Error error = {{0}};
    assert_true(output_begin(&output, "p.txt", &error));
    const pid_t child = fork();
    if (child == 0) {
        output_discard_all();
        _exit(0);
    }
    waitpid(child, NULL, 0);
    assert_int_equal(access(output.temp, F_OK), 0);
    output_discard_all();
    assert_int_not_equal(access(output.temp, F_OK), 0);
    output_discard(&output);
}

static void what_killed_writers_left_goes_with_the_next_one(void **state)
{
    (void)state;
    Output output = {0};
    Error error = {{0}};
    char file[64], folder[64], alive[64], other[64];
    const long gone = dead();
    snprintf(file, sizeof file, "a.txt.%ld.tmp", gone);
    snprintf(folder, sizeof folder, "a.txt.%ld.tmp", dead());
    snprintf(alive, sizeof alive, "a.txt.%ld.tmp", (long)getppid());
    snprintf(other, sizeof other, "b.txt.%ld.tmp", gone);
    write_text(file, "half");
    assert_int_equal(mkdir(folder, 0777), 0);
    write_text(alive, "half");
    write_text(other, "half");
    write_text("a.txt.tmp", "whole");
    assert_true(output_begin(&output, "a.txt", &error));
    assert_false(exists(file) || exists(folder));
    assert_true(exists(alive) && exists(other) && exists("a.txt.tmp"));
    output_discard(&output);
}

static void assert_refused(const char *path, const char *reason)
{
    Output output = {0};
    Error error = {{0}};
    assert_false(output_begin(&output, path, &error));
    assert_contains(error.message, reason);
    assert_string_equal(output.temp, "");
}

static void what_cannot_be_written_is_refused_at_once(void **state)
{
    (void)state;
    char long_name[2000];
    memset(long_name, 'a', sizeof long_name - 1);
    long_name[sizeof long_name - 1] = '\0';
    mkdir("folder", 0777);
    write_text("file", "");
    assert_refused("missing/out.txt", "No such file or directory; create it first");
    assert_refused("file/out.txt", "file is not a folder");
    assert_refused("folder", "is a folder; name a file");
    assert_refused("folder/", "is a folder; name a file");
    assert_refused("free/", "ends in a slash");
    assert_refused("", "empty");
    assert_refused(long_name, "more than 1023 bytes");
    assert_refused("/proc/out.txt", "cannot be written in the folder /proc");
    assert_refused("/dev/null", "is not a plain file");
    assert_int_equal(count_files("."), 2);
}

static void a_check_leaves_nothing(void **state)
{
    (void)state;
    Error error = {{0}};
    write_text("old.txt", "old");
    assert_true(output_check("new.txt", &error));
    assert_true(output_check("old.txt", &error));
    assert_text("old.txt", "old");
    assert_int_equal(count_files("."), 1);
    assert_false(output_check("missing/out.txt", &error));
}

/* ---- folders ---- */

/* `path` with a single file inside, through the temporary folder. */
static void make_folder(const char *path, const char *file, const char *text)
{
    OutputFolder folder = {.path = ""};
    Error error = {{0}};
    char name[1200];
    if (!output_folder_begin(&folder, path, ".txt", &error))
        fail_msg("%s", error.message);
    snprintf(name, sizeof name, "%s/%s", folder.temp, file);
    write_text(name, text);
    if (!output_folder_commit(&folder, &error))
        fail_msg("%s", error.message);
    output_folder_discard(&folder); /* no effect any more */
}

static void a_folder_replaces_an_older_one_whole(void **state)
{
    (void)state;
    make_folder("a", "a-0000.txt", "first");
    assert_text("a/a-0000.txt", "first");
    make_folder("a", "a-0001.txt", "second");
    assert_text("a/a-0001.txt", "second");
    assert_int_equal(count_files("a"), 1);
    mkdir("b", 0777); /* an empty file */
    make_folder("b", "b-0.txt", "third");
    assert_text("b/b-0.txt", "third");
    assert_int_equal(count_files("."), 2);
}

static void a_discarded_folder_leaves_the_older_one(void **state)
{
    (void)state;
    OutputFolder folder = {.path = ""};
    char name[1200];
    output_folder_discard(&folder);
    make_folder("a", "a-0000.txt", "old");
    assert_true(output_folder_begin(&folder, "a", ".txt", NULL));
    for (int k = 0; k < 300; k++) { /* more than one buffer of entries */
        snprintf(name, sizeof name, "%s/a-%04d.txt", folder.temp, k);
        write_text(name, "half");
    }
    output_folder_discard(&folder);
    assert_text("a/a-0000.txt", "old");
    assert_int_equal(count_files("."), 1);
}

static void assert_folder_refused(const char *path, const char *reason)
{
    OutputFolder folder = {.path = ""};
    Error error = {{0}};
    assert_false(output_folder_begin(&folder, path, ".txt", &error));
    assert_contains(error.message, reason);
    assert_string_equal(folder.temp, "");
}

/* Files of a different program are never lost, even if created late. */
static void a_folder_of_others_is_refused(void **state)
{
    (void)state;
    static const char *const others[] = {"a/notes", "a/a-1.txt~", "a/a-.txt", "a/b-1.txt", "a/a-1x.txt"};
    OutputFolder folder = {.path = ""};
    Error error = {{0}};
    char name[1200];
    make_folder("a", "a-0000.txt", "old");
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        write_text(others[i], "mine");
        assert_folder_refused("a", others[i] + 2);
        unlink(others[i]);
    }
    assert_true(output_folder_begin(&folder, "a", ".txt", &error));
    snprintf(name, sizeof name, "%s/a-0000.txt", folder.temp);
    write_text(name, "new");
    write_text("a/late", "mine");
    assert_false(output_folder_commit(&folder, &error));
    assert_contains(error.message, "'late' in it is no .txt of an export");
    assert_text("a/late", "mine");
    assert_text("a/a-0000.txt", "old");
    assert_int_equal(count_files("."), 1);
    write_text("file", "");
    assert_folder_refused("file", "file: is to be a folder");
    assert_folder_refused("missing/a", "missing/a: the folder cannot be created: No such file");
}

/* In a child: one signal sets the flag, the second ends the program and removes the temporary file. */
static void two_signals_end_the_program_and_leave_nothing(void **state)
{
    (void)state;
    int status = 0;
    pid_t child = fork();
    if (child == 0) {
        Output output = {0};
        OutputFolder folder = {.path = ""};
        char name[1200];
        signal(SIGTERM, SIG_DFL);
        interrupt_install();
        if (!output_begin(&output, "half.txt", NULL) || !output_folder_begin(&folder, "half", ".txt", NULL) ||
            interrupted())
            _exit(1);
        snprintf(name, sizeof name, "%s/half-0000.txt", folder.temp);
        write_text(name, "half");
        raise(SIGTERM);
        if (!interrupted() || !exists(output.temp) || !exists(name))
            _exit(2);
        raise(SIGTERM);
        _exit(3);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), EXIT_INTERRUPTED);
    assert_int_equal(count_files("."), 0);
}

/* nohup, and programs in the background of a script. */
static void an_ignored_signal_stays_ignored(void **state)
{
    (void)state;
    int status = 0;
    pid_t child = fork();
    if (child == 0) {
        signal(SIGHUP, SIG_IGN);
        interrupt_install();
        raise(SIGHUP);
        _exit(interrupted() ? 1 : 0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, folder_setup, folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_new_file_appears_at_the_commit),
        TEST(an_old_file_stays_until_then),
        TEST(a_child_that_crashes_leaves_the_files_of_its_parent),
        TEST(what_killed_writers_left_goes_with_the_next_one),
        TEST(what_cannot_be_written_is_refused_at_once),
        TEST(a_check_leaves_nothing),
        TEST(a_folder_replaces_an_older_one_whole),
        TEST(a_discarded_folder_leaves_the_older_one),
        TEST(a_folder_of_others_is_refused),
        TEST(two_signals_end_the_program_and_leave_nothing),
        TEST(an_ignored_signal_stays_ignored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
