#include "app/recording/recording.h"

#include "app/base/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool recording_read(const char *path, Recording *out, Error *error)
{
    size_t size;
    *out = (Recording){0};
    char *bytes = read_file(path, RECORDING_BYTES_MAX, "recording", &size, error);
    const bool ok = bytes && recording_parse(path, bytes, size, out, error);
    free(bytes);
    return ok;
}

bool recording_is_file(const char *path)
{
    static const char BEGIN[] = "slosh recording ";
    char bytes[sizeof BEGIN - 1];
    FILE *file = fopen(path, "rb");
    const bool is = file && fread(bytes, 1, sizeof bytes, file) == sizeof bytes &&
                    memcmp(bytes, BEGIN, sizeof bytes) == 0;
    if (file)
        fclose(file);
    return is;
}
