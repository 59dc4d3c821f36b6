#include "app/base/read_file.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool too_large(const char *path, size_t limit, const char *what, Error *error)
{
    const bool giga = limit % (1 << 30) == 0;
    return error_set(error, "%s: larger than %zu %s; no %s is, name one", path, limit >> (giga ? 30 : 20),
                     giga ? "GiB" : "MiB", what);
}

/* Reads the file, but stops slightly above the limit. */
static char *read_bytes(FILE *file, size_t limit, size_t *size)
{
    size_t room = 1 << 16;
    char *bytes = malloc(room);
    *size = 0;
    while (bytes && (*size += fread(bytes + *size, 1, room - *size, file)) == room && room <= limit) {
        room *= 2;
        char *more = realloc(bytes, room);
        if (!more)
            free(bytes);
        bytes = more;
    }
    return bytes;
}

static char *read_open(FILE *file, const char *path, size_t limit, const char *what, size_t *size,
                       Error *error)
{
    errno = 0;
    char *bytes = read_bytes(file, limit, size);
    if (!bytes)
        error_set(error, "%s: no memory to read it", path);
    else if (ferror(file))
        error_set(error, "%s: cannot be read (%s)", path, strerror(errno));
    else if (*size > limit)
        too_large(path, limit, what, error);
    else
        return bytes;
    free(bytes);
    return NULL;
}

char *read_file(const char *path, size_t limit, const char *what, size_t *size, Error *error)
{
    struct stat status;
    const bool there = stat(path, &status) == 0;
    *size = 0;
    if (there && S_ISDIR(status.st_mode)) {
        error_set(error, "%s: a directory; name a %s in it", path, what);
        return NULL;
    }
    if (there && S_ISREG(status.st_mode) && (uintmax_t)status.st_size > limit) {
        too_large(path, limit, what, error);
        return NULL;
    }
    FILE *file = fopen(path, "rb");
    if (!file) {
        error_set(error, "%s: cannot be opened (%s); name a %s of slosh", path, strerror(errno), what);
        return NULL;
    }
    char *bytes = read_open(file, path, limit, what, size, error);
    fclose(file);
    return bytes;
}
