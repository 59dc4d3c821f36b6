/* Lines on a file, a bar on a terminal, nothing when quiet. */
#define _GNU_SOURCE
#include "tests/app/output_fixture.h"

#include "app/base/program.h"

#include <poll.h>
#include <pty.h>

/* What all of a run from 0 to 1 in `steps` writes into `stream`. */
static void run(FILE *stream, int steps, bool quiet)
{
    Progress progress;
    progress_begin(&progress, stream, "work", quiet);
    for (int i = 0; i <= steps; i++)
        progress_update(&progress, (double)i / steps);
    progress_end(&progress);
    fflush(stream);
}

static void read_back(FILE *stream, char text[4096])
{
    rewind(stream);
    text[fread(text, 1, 4095, stream)] = '\0';
    fclose(stream);
}

static void a_file_gets_a_line_every_tenth(void **state)
{
    (void)state;
    char text[4096];
    FILE *stream = tmpfile();
    int lines = 0;
    run(stream, 1000, false);
    read_back(stream, text);
    for (const char *c = text; *c; c++)
        lines += *c == '\n';
    assert_int_equal(lines, 10);
    assert_contains(text, "work:  50 %");
    assert_contains(text, "work: 100 %  0:00 elapsed\n");
    assert_null(strchr(text, '\r'));
    assert_null(strchr(text, '\033'));
}

static void quiet_says_nothing(void **state)
{
    (void)state;
    char text[4096];
    FILE *stream = tmpfile();
    run(stream, 100, true);
    read_back(stream, text);
    assert_string_equal(text, "");
}

/* All output at the terminal's far end until a pause. */
static void read_terminal(int master, char text[1 << 16])
{
    size_t length = 0;
    struct pollfd wait = {.fd = master, .events = POLLIN};
    while (length < (1 << 16) - 1 && poll(&wait, 1, 300) > 0) {
        ssize_t got = read(master, text + length, (1 << 16) - 1 - length);
        length += got > 0 ? (size_t)got : 0;
    }
    text[length] = '\0';
}

static void a_terminal_gets_one_line_that_is_wiped(void **state)
{
    (void)state;
    enum { UPDATES = 1000 };
    static char text[1 << 16];
    static const char wiped[] = "\r\033[K";
    int master, slave, drawn = 0;
    assert_int_equal(openpty(&master, &slave, NULL, NULL, NULL), 0);
    FILE *stream = fdopen(slave, "w");
    Progress progress;
    progress_begin(&progress, stream, "work", false);
    for (int i = 0; i < UPDATES; i++)
        progress_update(&progress, 0.4);
    progress_end(&progress);
    fflush(stream);
    read_terminal(master, text);
    for (const char *c = text; *c; c++)
        drawn += *c == '[' && c[1] == '#';
    assert_contains(text,
                    "\rwork [############------------------]  40 %  0:00 elapsed, about 0:00 left\033[K");
    assert_in_range(drawn, 1, UPDATES / 10); /* redrawn by time, not by updates */
    assert_null(strchr(text, '\n'));
    assert_string_equal(text + strlen(text) - strlen(wiped), wiped);
    fclose(stream);
    close(master);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_gets_a_line_every_tenth),
        cmocka_unit_test(quiet_says_nothing),
        cmocka_unit_test(a_terminal_gets_one_line_that_is_wiped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
