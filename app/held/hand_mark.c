#include "app/held/hand_mark.h"

#include "sim/base/hash.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static uint64_t add_log(uint64_t hash, const ReportLog *log)
{
    for (size_t i = 0; i < log->count; i++) {
        const ReportLogEntry *entry = &log->entries[i];
        const ReportLogDevice *device = &log->devices[entry->device];
        const uint16_t what[] = {entry->kind,         entry->device,        entry->size,
                                 device->row->vendor, device->row->product, device->bluetooth};
        hash = hash_add(hash, &entry->time, sizeof entry->time);
        hash = hash_add(hash, what, sizeof what);
        if (entry->size > 0) /* log->bytes is NULL if no report has a byte */
            hash = hash_add(hash, log->bytes + entry->offset, entry->size);
    }
    return hash;
}

/* Skips comments: they contain the user's path and may change between versions. */
static uint64_t add_yaml(uint64_t hash, const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        if (text[strspn(text, " ")] != '#')
            hash = hash_add(hash, text, length);
        text += length + (text[length] != 0);
    }
    return hash;
}

static bool add_mapping(uint64_t *hash, const Mapping *mapping)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return false;
    mapping_write(mapping, file);
    const bool whole = fclose(file) == 0;
    if (whole)
        *hash = add_yaml(*hash, text);
    free(text);
    return whole;
}

bool hand_mark(const ReportLog *log, const Mapping *mapping, const HandInput *axes, char mark[HAND_MARK_SIZE])
{
    uint64_t hash = add_log(HASH_NONE, log);
    hash = hash_add(hash, axes->right, sizeof axes->right);
    hash = hash_add(hash, axes->up, sizeof axes->up);
    hash = hash_add(hash, axes->away, sizeof axes->away);
    const bool ok = add_mapping(&hash, mapping);
    snprintf(mark, HAND_MARK_SIZE, "%016" PRIx64, hash);
    return ok;
}
