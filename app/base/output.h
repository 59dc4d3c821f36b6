/* Files that appear complete or not at all: written under a temporary name, then renamed. */
#ifndef SLOSH_OUTPUT_H
#define SLOSH_OUTPUT_H

#include "app/base/output_pending.h"
#include "sim/base/error.h"

#include <stdbool.h>

/* A file being written. Zero-initialise before use. */
typedef struct Output {
    char path[1024];   /* the name that was asked for */
    char target[1024]; /* the file that gets replaced: where `path` leads when it is a link, which stays */
    char temp[OUTPUT_TEMP_SIZE]; /* target.PID.tmp, in the same folder, from "./" or "/" on: write here until
                                    the commit; empty: none */
} Output;

/* Creates the empty temporary file, which shows at once if the file is writable. Returns false with the
   reason: no such folder, a read-only folder, a name of a folder. `path` need not exist; an existing file
   stays unchanged until the commit. */
bool output_begin(Output *output, const char *path, Error *error);

/* Renames the temporary file to the final name, replacing an older file. On failure the temporary file is
   removed. */
bool output_commit(Output *output, Error *error);

/* Commits only if there is no file of that name. An existing file stays, *there is true, and the output must
   still be committed or discarded. */
bool output_commit_new(Output *output, bool *there, Error *error);

/* Resolves `path` if it is a link; also for folders (output_folder). Returns false with the reason, for
   example a too long path. */
bool output_target(const char *path, char target[1024], Error *error);

/* Removes the temporary file; no effect before begin, after commit or a second time. */
void output_discard(Output *output);

/* Removes temporary files of the same output left by writers that no longer run. Each begin of an output
   calls this function. */
void output_clear_stale(const char *target);

/* True if the path is writable; leaves no file. */
bool output_check(const char *path, Error *error);

#endif
