#include "app/recording.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool too_large(const char *path, Error *error)
{
    return error_set(error, "%s: larger than 1 GiB; no recording is, name one", path);
}

/* The bytes of a file of whatever kind, at most one more than is allowed. */
static char *read_bytes(FILE *file, size_t *size)
{
    size_t room = 1 << 16;
    char *bytes = malloc(room);
    *size = 0;
    while (bytes && (*size += fread(bytes + *size, 1, room - *size, file)) == room &&
           room <= RECORDING_BYTES_MAX) {
        room *= 2;
        char *more = realloc(bytes, room);
        if (!more)
            free(bytes);
        bytes = more;
    }
    return bytes;
}

static bool parse_file(FILE *file, const char *path, Recording *out, Error *error)
{
    size_t size;
    errno = 0;
    char *bytes = read_bytes(file, &size);
    bool ok = false;
    if (!bytes)
        error_set(error, "%s: no memory to read it", path);
    else if (ferror(file))
        error_set(error, "%s: cannot be read (%s)", path, strerror(errno));
    else if (size > RECORDING_BYTES_MAX)
        too_large(path, error);
    else
        ok = recording_parse(path, bytes, size, out, error);
    free(bytes);
    return ok;
}

bool recording_read(const char *path, Recording *out, Error *error)
{
    struct stat status;
    *out = (Recording){0};
    if (stat(path, &status) == 0 && S_ISDIR(status.st_mode))
        return error_set(error, "%s: a directory; name a recording in it", path);
    if (stat(path, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > RECORDING_BYTES_MAX)
        return too_large(path, error);
    FILE *file = fopen(path, "rb");
    if (!file)
        return error_set(error, "%s: cannot be opened (%s); name a recording of slosh", path,
                         strerror(errno));
    const bool ok = parse_file(file, path, out, error);
    fclose(file);
    return ok;
}
