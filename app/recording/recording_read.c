#include "app/base/read_file.h"
#include "app/recording/recording.h"

#include <stdlib.h>

bool recording_read(const char *path, Recording *out, Error *error)
{
    size_t size;
    *out = (Recording){0};
    char *bytes = read_file(path, RECORDING_BYTES_MAX, "recording", &size, error);
    const bool ok = bytes && recording_parse(path, bytes, size, out, error);
    free(bytes);
    return ok;
}
