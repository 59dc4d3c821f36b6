/* Fuzz target of a volume's header: accepted headers are usable. The raw values, taken partly from the
   header's bytes, match scale and offset. */
#include "app/scene/import/import.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void must(bool ok)
{
    if (!ok)
        abort();
}

static void check_header(const VolumeHeader *header)
{
    double values = 1;
    char raw[VOLUME_PATH_SIZE];
    must(memchr(header->file, '\0', sizeof header->file) != NULL);
    must(header->type >= VOLUME_UINT8 && header->type <= VOLUME_FLOAT32);
    for (int k = 0; k < 3; k++) {
        must(header->size[k] >= 2 && header->size[k] == rint(header->size[k]));
        must(header->spacing[k] > 0 && isfinite(header->spacing[k]) && isfinite(header->corner[k]));
        values *= header->size[k];
    }
    must(values <= 0x1p32 && isfinite(header->scale) && isfinite(header->offset));
    must((double)volume_header_bytes(header) >= values);
    volume_raw_path("folder/fuzz.yaml", header, raw);
    must(header->file[0] == '/' ? strcmp(raw, header->file) == 0
                                : strncmp(raw, "folder/", strlen("folder/")) == 0);
}

static void check_values(const VolumeHeader *header, const uint8_t *data, size_t size)
{
    enum { MOST = 64 };
    float value[MOST];
    size_t count = size / sizeof(float);
    count = count < MOST ? count : MOST;
    volume_values(header, data, count, value);
    for (size_t i = 0; i < count && header->type != VOLUME_FLOAT32; i++) {
        const double off = fabs((double)value[i] - header->offset), most = fabs(header->scale) * 65535;
        must(off <= most + 1e-6 * (most + fabs(header->offset)) + 1e-37);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    VolumeHeader header;
    Error error = {""};
    if (!volume_header_parse("fuzz.yaml", (const char *)data, size, &header, &error)) {
        must(strncmp(error.message, "fuzz.yaml:", strlen("fuzz.yaml:")) == 0);
        return 0;
    }
    check_header(&header);
    check_values(&header, data, size);
    return 0;
}
