/* JSON results, written whole or not at all. */
#ifndef SLOSH_JSON_FILE_H
#define SLOSH_JSON_FILE_H

#include "sim/error.h"

#include <jansson.h>

/* Writes `json` (NULL: it could not be made, for jansson takes no text but UTF-8 and no number that is not
   finite) to that file, indented, with a newline at the end; false with the reason, and no file. Does not
   take the reference. */
bool json_file_write(const json_t *json, const char *path, Error *error);

/* A real, or null where the number is not finite: JSON has no other word for that. */
json_t *number_json(double number);

#endif
