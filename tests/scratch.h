/* Files and folders of a test's own, in TMPDIR; gone at its end, where an assertion has failed too. */
#ifndef SLOSH_TEST_SCRATCH_H
#define SLOSH_TEST_SCRATCH_H

#include <fts.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SCRATCH_SIZE = 200, SCRATCH_PATH = 300 /* of the folder's contents */ };

static char scratch_root[SCRATCH_SIZE];
static pid_t scratch_owner; /* leaves the folder's tree unchanged */

/* A file, a link, or a folder and all in it; what a link names stays. */
static inline void scratch_remove(const char *path)
{
    char whole[SCRATCH_PATH];
    snprintf(whole, sizeof whole, "%s", path);
    FTS *tree = fts_open((char *const[]){whole, NULL}, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    FTSENT *entry;
    while (tree && (entry = fts_read(tree)))
        if (entry->fts_info != FTS_D) /* the folder comes after the contents */
            remove(entry->fts_accpath);
    if (tree)
        fts_close(tree);
}

static inline void scratch_end(void)
{
    if (getpid() == scratch_owner)
        scratch_remove(scratch_root);
}

/* An unused name ending in `suffix`. */
static inline char *scratch_name(char path[SCRATCH_SIZE], const char *suffix)
{
    static int count;
    const char *folder = getenv("TMPDIR");
    if (!*scratch_root) {
        snprintf(scratch_root, sizeof scratch_root, "%s/slosh-test-XXXXXX",
                 folder && *folder ? folder : P_tmpdir);
        if (strlen(scratch_root) > SCRATCH_SIZE - 32 || !mkdtemp(scratch_root)) {
            perror(scratch_root);
            exit(1);
        }
        scratch_owner = getpid();
        atexit(scratch_end);
    }
    const int length = snprintf(path, SCRATCH_SIZE, "%s/%d", scratch_root, ++count);
    snprintf(path + length, (size_t)(SCRATCH_SIZE - length), "%s", suffix);
    return path;
}

/* An empty file. */
static inline char *scratch_file(char path[SCRATCH_SIZE], const char *suffix)
{
    FILE *file = fopen(scratch_name(path, suffix), "w");
    if (!file || fclose(file) != 0) {
        perror(path);
        exit(1);
    }
    return path;
}

/* An empty folder. */
static inline char *scratch_folder(char path[SCRATCH_SIZE])
{
    char *made = mkdtemp(strcat(scratch_name(path, ""), "-XXXXXX"));
    if (!made) {
        perror(path);
        exit(1);
    }
    return made;
}

#endif
