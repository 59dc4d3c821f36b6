/* Files: input read whole, results as JSON, and outputs that appear complete or not at all. */
#ifndef APP_BASE_FILE_H
#define APP_BASE_FILE_H

#include "sim/error.h"

#include <jansson.h>
#include <limits.h>
#include <stdbool.h>
#include <stddef.h>

/* Whole files in memory, and results as JSON. */

/* The bytes of any kind of file; the caller frees the bytes. NULL with "PATH: ...": missing, a folder, more
   than `limit` bytes (1 MiB or more), no memory. `what`: the expected kind, in words: "recording". */
char *read_file(const char *path, size_t limit, const char *what, size_t *size, Error *error);

/* JSON results: a file, written completely or not at all, or a stream. */

/* Writes `json` to a file or stream, indented, with a final newline. Returns false with the reason, and
   writes no file. `json` may be NULL after a failure to make the JSON: jansson takes only UTF-8 and finite
   numbers. Does not take the reference. */
bool json_file_write(const json_t *json, const char *path, Error *error);

/* True if the path is not a replaceable file: "-", /dev/stdout, /dev/stderr, a device, a pipe. */
bool json_is_stream(const char *path);

/* True if the path is writable; leaves no file. */
bool json_file_check(const char *path, Error *error);

/* JSON of a command that failed before any figures: {"command": COMMAND, WORD: INPUT, "output": OUTPUT,
   "error": why}; `output` may be NULL. */
json_t *failure_json(const char *command, const char *word, const char *input, const char *output,
                     const Error *error);

/* Writes the JSON unless `path` is NULL, reports a failed write, and releases the reference. */
void failure_json_write(json_t *json, const char *path);

/* A real number, or null if not finite: JSON cannot express other values. */
json_t *number_json(double number);

/* Output files and folders that appear complete or not at all: written under a temporary name, then
   renamed; and the lock of a file with one writer. */

/* The absolute path of the file after all links; of a missing file, its future path. Returns false with
   errno: links in a circle, an unreadable folder, a too long path. */
bool path_resolve(const char *path, char place[PATH_MAX]);

/* Temporary files and folders of unfinished outputs, for removal by a signal that ends the program. Only
   output.c adds entries. */

enum { OUTPUT_TEMP_SIZE = 1056 }; /* of a temporary name */

void output_pending_add(const char *temp);

/* Call after renaming or removal. */
void output_pending_remove(const char *temp);

/* Removes a folder and its files, but not its subfolders. May be called from a signal handler. */
void output_remove_folder(const char *path);

/* Removes the temporary files and folders of all unfinished outputs; returns their number. May be called from
   a signal handler. */
int output_discard_all(void);

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

/* Removes the temporary file; no effect before begin, after commit or a second time. */
void output_discard(Output *output);

/* Writes a file by `print`, which returns false if memory is short; the file is complete or not written at
   all. */
bool output_print(const char *path, bool (*print)(const void *of, FILE *file), const void *of, Error *error);

/* True if the path is writable; leaves no file. */
bool output_check(const char *path, Error *error);

/* Folders that appear complete or not at all: filled under a temporary name, then renamed. */

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

/* Files with one writer at a time: a kernel lock on the file, which ends with the program, even if killed.
   The lock belongs to the open file (F_OFD_SETLK, Linux 3.15). HDF5, ParaView and h5py lock by flock, which
   does not see this lock, so other programs may read a file during writing. On NFS both locks are one, and
   readers there need HDF5_USE_FILE_LOCKING=FALSE. */

typedef enum OutputLockState {
    OUTPUT_UNLOCKED, /* no such file */
    OUTPUT_LOCKED,
    OUTPUT_UNLOCKABLE /* the file cannot be locked: reported once on standard error */
} OutputLockState;

/* Zero-initialise before use. */
typedef struct OutputLock {
    OutputLockState state;
    int file;
} OutputLock;

/* Returns false with the reason if a different lock, of any program, holds the file. */
bool output_lock(OutputLock *lock, const char *path, Error *error);

/* May be called twice. */
void output_unlock(OutputLock *lock);

/* output_commit over a file locked by `older`, or over no file if `older` found none. Returns false with the
   reason if another program has begun to write a file of that name. Releases `older`. */
bool output_lock_commit(OutputLock *older, Output *output, Error *error);

#endif
