/* Folders that appear complete or not at all: filled under a temporary name, then renamed. */
#ifndef SLOSH_OUTPUT_FOLDER_H
#define SLOSH_OUTPUT_FOLDER_H

#include "app/base/output_pending.h"
#include "sim/base/error.h"

/* A folder being written. Zero-initialise before use. Its files are named after the folder, NAME-0123.vtp or
   NAME-0123-part4.vtp in NAME, so that an older export folder is recognised and can be replaced. */
typedef struct OutputFolder {
    char path[1024];             /* the requested name */
    char target[1024];           /* target of the link if `path` is a link, which stays */
    char temp[OUTPUT_TEMP_SIZE]; /* target.PID.tmp: fill this folder until the commit; empty: none */
    const char *suffix;          /* ".vtp" */
} OutputFolder;

/* Creates the temporary folder. Returns false with the reason: no such parent folder, no write permission, a
   file of that name, or a folder with files other than exports, which stay untouched. */
bool output_folder_begin(OutputFolder *folder, const char *path, const char *suffix, Error *error);

/* Renames the folder to its final name; an older folder is removed with all its files. On failure the
   temporary folder is removed and the older folder stays. */
bool output_folder_commit(OutputFolder *folder, Error *error);

/* Removes the temporary folder; no effect before begin, after commit or a second time. output_discard_all
   removes the temporary folder too. */
void output_folder_discard(OutputFolder *folder);

#endif
