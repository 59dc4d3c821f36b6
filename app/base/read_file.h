/* Reads a whole file into memory. */
#ifndef SLOSH_READ_FILE_H
#define SLOSH_READ_FILE_H

#include "sim/base/error.h"

#include <stddef.h>

/* The bytes of any kind of file; the caller frees the bytes. NULL with "PATH: ...": missing, a folder, more
   than `limit` bytes (1 MiB or more), no memory. `what`: the expected kind, in words: "recording". */
char *read_file(const char *path, size_t limit, const char *what, size_t *size, Error *error);

#endif
