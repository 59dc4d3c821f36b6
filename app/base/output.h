/* Files that appear whole or not at all: written beside their name, renamed when whole. */
#ifndef SLOSH_OUTPUT_H
#define SLOSH_OUTPUT_H

#include "app/base/output_pending.h"
#include "sim/base/error.h"

#include <stdbool.h>

/* One file in the making. Zero-initialise it. */
typedef struct Output {
    char path[1024];   /* the name that was asked for */
    char target[1024]; /* the file that gets replaced: where `path` leads when it is a link, which stays */
    char temp[OUTPUT_TEMP_SIZE]; /* target.PID.tmp, in the same folder: write here until the commit; empty:
                                    none */
} Output;

/* Creates the empty temporary file, and so finds out at once whether the file can be written. False with the
   reason: no such folder, a folder that may not be written, a name that is a folder. `path` need not exist;
   when it does it stays as it is until the commit. */
bool output_begin(Output *output, const char *path, Error *error);

/* Gives the file its name, in place of an older one. On failure the temporary file is removed. */
bool output_commit(Output *output, Error *error);

/* The same where no file has that name; where one has, *there is true, it stays, and the output is still to
   be committed or discarded. */
bool output_commit_new(Output *output, bool *there, Error *error);

/* `path` itself, or, when it is a link, where it leads; false with the reason, also for a path that is too
   long. Of the other kind of output, output_folder, too. */
bool output_target(const char *path, char target[1024], Error *error);

/* Removes the temporary file; does nothing before begin, after commit or a second time. */
void output_discard(Output *output);

/* Removes what writers of the same output left beside it that no longer run. The begin of each output does
 * so. */
void output_clear_stale(const char *target);

/* Whether a file could be written there, without leaving one. */
bool output_check(const char *path, Error *error);

#endif
