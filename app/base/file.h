/* Whole files: input in memory, results as JSON. */
#ifndef APP_BASE_FILE_H
#define APP_BASE_FILE_H

#include "slosh/error.h"

#include <jansson.h>
#include <stddef.h>

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

#endif
