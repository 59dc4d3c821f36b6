#include "app/base/file.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool too_large(const char *path, size_t limit, const char *what, Error *error)
{
    const bool giga = limit % (1 << 30) == 0;
    return error_set(error, "%s: larger than %zu %s; no %s is, name one", path, limit >> (giga ? 30 : 20),
                     giga ? "GiB" : "MiB", what);
}

/* Reads the file, but stops slightly above the limit. */
static char *read_bytes(FILE *file, size_t limit, size_t *size)
{
    size_t capacity = 1 << 16;
    char *bytes = malloc(capacity);
    *size = 0;
    while (bytes && (*size += fread(bytes + *size, 1, capacity - *size, file)) == capacity &&
           capacity <= limit) {
        capacity *= 2;
        char *more = realloc(bytes, capacity);
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

static bool write_text(const json_t *json, FILE *file)
{
    return json_dumpf(json, file, JSON_INDENT(1) | JSON_REAL_PRECISION(9)) == 0 && fputc('\n', file) != EOF;
}

static bool write_named(const json_t *json, const char *name)
{
    FILE *file = fopen(name, "w");
    if (!file)
        return false;
    const bool ok = write_text(json, file);
    return (fclose(file) == 0) && ok;
}

/* The stream of the path, for any redirection; NULL: the path is a file. */
static FILE *own_stream(const char *path)
{
    if (strcmp(path, "-") == 0 || strcmp(path, "/dev/stdout") == 0)
        return stdout;
    return strcmp(path, "/dev/stderr") == 0 ? stderr : NULL;
}

bool json_is_stream(const char *path)
{
    struct stat status;
    return own_stream(path) ||
           (stat(path, &status) == 0 && (S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode)));
}

static bool write_stream(const json_t *json, const char *path)
{
    FILE *stream = own_stream(path);
    return stream ? write_text(json, stream) && fflush(stream) == 0 : write_named(json, path);
}

bool json_file_check(const char *path, Error *error)
{
    if (!json_is_stream(path))
        return output_check(path, error);
    return own_stream(path) || access(path, W_OK) == 0 ||
           error_set(error, "%s: cannot be written: %s", path, strerror(errno));
}

bool json_file_write(const json_t *json, const char *path, Error *error)
{
    Output output = {0};
    const bool stream = json_is_stream(path);
    if (!stream && !output_begin(&output, path, error))
        return false;
    if (json && (stream ? write_stream(json, path) : write_named(json, output.temp)))
        return stream || output_commit(&output, error);
    if (!json)
        error_set(error, "%s: the results hold a name that is not UTF-8, or a number that is not finite",
                  path);
    else
        error_set(error, "%s: cannot write the results: %s", path, strerror(errno));
    output_discard(&output);
    return false;
}

json_t *failure_json(const char *command, const char *word, const char *input, const char *output,
                     const Error *error)
{
    return json_pack("{s:s, s:s, s:s*, s:s}", "command", command, word, input, "output", output, "error",
                     error->message);
}

void failure_json_write(json_t *json, const char *path)
{
    Error error = {{0}};
    if (path && !json_file_write(json, path, &error))
        fprintf(stderr, "%s\n", error.message);
    json_decref(json);
}

json_t *number_json(double number)
{
    return isfinite(number) ? json_real(number) : json_null();
}
