#include "tests/program.h"

#include <stdio.h>
#include <string.h>

int test_argc;
char **test_argv;

static int list(const char *program)
{
    fprintf(stderr, "%s NAME [ARGS]: one of\n", program);
    for (const TestFile *file = test_files; file->name; file++)
        fprintf(stderr, "  %s\n", file->name);
    return 2;
}

int main(int argc, char **argv)
{
    for (const TestFile *file = test_files; argc > 1 && file->name; file++)
        if (strcmp(argv[1], file->name) == 0) {
            test_argc = argc - 2;
            test_argv = argv + 2;
            return file->run();
        }
    return list(argv[0]);
}
