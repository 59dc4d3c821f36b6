#include "app/base/standard_streams.h"

#include "app/base/exit_code.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Opens a closed stream: open returns the lowest free number, and the numbers below are in use. */
static void fill(int stream)
{
    const int flags = stream == STDERR_FILENO ? O_WRONLY : O_RDONLY; /* keeps standard output unwritable */
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF)
        return;
    if (open("/dev/null", flags) < 0)
        open("/", O_RDONLY | O_DIRECTORY); /* no /dev: a descriptor that can neither be read nor written */
}

void standard_streams_open(void)
{
    fill(STDIN_FILENO);
    fill(STDOUT_FILENO);
    fill(STDERR_FILENO);
}

int standard_streams_flush(const char *program, int code)
{
    const bool before = ferror(stdout), now = fflush(stdout) != 0;
    if (code != 0 || (!before && !now))
        return code;
    fprintf(stderr, "%s: standard output: %s\n", program, now ? strerror(errno) : "a part was not written");
    return EXIT_FAILED;
}
