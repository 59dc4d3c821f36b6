/* A separate folder for each test with output files. */
#ifndef SLOSH_TEST_OUTPUT_FIXTURE_H
#define SLOSH_TEST_OUTPUT_FIXTURE_H

/* cmocka's needs */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/scratch.h"

#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* setup and teardown: *state is the folder's name, and the working folder is in it. */
static inline int folder_setup(void **state)
{
    char *folder = malloc(SCRATCH_SIZE);
    if (!folder || chdir(scratch_folder(folder)) != 0)
        return -1;
    *state = folder;
    return 0;
}

static inline int folder_teardown(void **state)
{
    int left = chdir("/");
    scratch_remove(*state);
    free(*state);
    return left;
}

/* How many entries the working folder has. */
static inline int count_files(const char *folder)
{
    int count = -2; /* . and .. */
    DIR *dir = opendir(folder);
    while (dir && readdir(dir))
        count++;
    if (dir)
        closedir(dir);
    return count;
}

static inline bool exists(const char *path)
{
    return access(path, F_OK) == 0;
}

static inline void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static inline void assert_text(const char *path, const char *text)
{
    char read[256] = "";
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    read[fread(read, 1, sizeof read - 1, file)] = '\0';
    fclose(file);
    assert_string_equal(read, text);
}

static inline void assert_contains(const char *text, const char *part)
{
    if (!strstr(text, part))
        fail_msg("'%s' does not contain '%s'", text, part);
}

#endif
