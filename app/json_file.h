/* JSON results, written whole or not at all. */
#ifndef SLOSH_JSON_FILE_H
#define SLOSH_JSON_FILE_H

#include "sim/error.h"

#include <jansson.h>

/* Writes `json` (NULL: memory ran out while it was made) to that file, indented, with a newline at the end;
   false with the reason, and no file. Does not take the reference. */
bool json_file_write(const json_t *json, const char *path, Error *error);

#endif
