/* Folders that appear whole or not at all: filled beside their name, renamed when whole. */
#ifndef SLOSH_OUTPUT_FOLDER_H
#define SLOSH_OUTPUT_FOLDER_H

#include "app/base/output_pending.h"
#include "sim/base/error.h"

/* One folder in the making. Zero-initialise it. Its files are called after it, NAME-0123.vtp or
   NAME-0123-part4.vtp in NAME, so that an older one is known to be ours and can be replaced. */
typedef struct OutputFolder {
    char path[1024];             /* the name that was asked for */
    char target[1024];           /* where it leads when it is a link, which stays */
    char temp[OUTPUT_TEMP_SIZE]; /* target.PID.tmp: fill this one until the commit; empty: none */
    const char *suffix;          /* ".vtp" */
} OutputFolder;

/* Creates the temporary folder. False with the reason: no such folder to put it in, one that may not be
   written, a name that is a file, or a folder with anything but files of ours, which stay untouched. */
bool output_folder_begin(OutputFolder *folder, const char *path, const char *suffix, Error *error);

/* Gives the folder its name; an older one is gone with all its files. On failure the temporary folder is
   removed and the older one stays. */
bool output_folder_commit(OutputFolder *folder, Error *error);

/* Removes the temporary folder; does nothing before begin, after commit or a second time. output_discard_all
   removes it too. */
void output_folder_discard(OutputFolder *folder);

#endif
