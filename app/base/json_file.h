/* JSON results: a file, written whole or not at all, or a stream. */
#ifndef SLOSH_JSON_FILE_H
#define SLOSH_JSON_FILE_H

#include "sim/base/error.h"

#include <jansson.h>

/* Writes `json` (NULL: it could not be made, for jansson takes no text but UTF-8 and no number that is not
   finite) to that file or stream, indented, with a newline at the end; false with the reason, and no file.
   Does not take the reference. */
bool json_file_write(const json_t *json, const char *path, Error *error);

/* Whether the path is no file that could be replaced: "-", /dev/stdout, /dev/stderr, a device, a pipe. */
bool json_is_stream(const char *path);

/* Whether it could be written there, without leaving anything. */
bool json_file_check(const char *path, Error *error);

/* {"command": COMMAND, WORD: INPUT, "output": OUTPUT, "error": why} of a command that failed before it had
   figures; the output may be NULL. */
json_t *failure_json(const char *command, const char *word, const char *input, const char *output,
                     const Error *error);

/* Writes it where `path` is not NULL, says it where that fails, and releases the reference. */
void failure_json_write(json_t *json, const char *path);

/* A real, or null where the number is not finite: JSON has no other word for that. */
json_t *number_json(double number);

#endif
