/* A whole file in memory. */
#ifndef SLOSH_READ_FILE_H
#define SLOSH_READ_FILE_H

#include "sim/base/error.h"

#include <stddef.h>

/* The bytes of a file of whatever kind, which the caller frees. NULL with "PATH: ...": missing, a folder,
   more than `limit` bytes (1 MiB or more), no memory. `what` is what it shall be, in words: "recording". */
char *read_file(const char *path, size_t limit, const char *what, size_t *size, Error *error);

#endif
