/* A README that holds a table which the program prints. */
#ifndef SLOSH_TESTS_README_TABLE_H
#define SLOSH_TESTS_README_TABLE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static inline char *readme_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    char *text = calloc(1, 1 << 20);
    assert_non_null(text);
    assert_true(fread(text, 1, (1 << 20) - 1, file) > 0);
    fclose(file);
    return text;
}

/* Fails unless the README (path from the root) has what `print` writes, `source` being where that comes from.
   With SLOSH_KEYS=FILE it is written there, to be pasted. */
static inline void check_readme_table(void (*print)(FILE *file), const char *readme, const char *source)
{
    char path[512], *table = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&table, &size);
    print(file);
    fclose(file);
    if (getenv("SLOSH_KEYS")) {
        file = fopen(getenv("SLOSH_KEYS"), "w");
        assert_non_null(file);
        fputs(table, file);
        fclose(file);
    }
    snprintf(path, sizeof path, "%s/%s", SLOSH_SOURCE_DIR, readme);
    char *text = readme_text(path);
    const char *at = strstr(text, table);
    if (!at || at[size] == '|') /* a row behind it is one too many */
        fail_msg("the table in %s is not that of %s; run this with SLOSH_KEYS=FILE and paste FILE", readme,
                 source);
    free(text);
    free(table);
}

#endif
