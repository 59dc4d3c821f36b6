#include "app/volume/volume_kept.h"

#include "app/volume/volume_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <time.h>

/* Identifies an unmodified file. */
typedef struct Stamp {
    dev_t device;
    ino_t number;
    off_t size;
    struct timespec written;
} Stamp;

typedef struct Kept {
    struct Kept *next;
    Stamp stamps[2]; /* of the header and the raw file, when last read */
    RangedVolume data;
} Kept;

static Kept *all_kept;

static size_t values_of(const VolumeData *volume)
{
    return (size_t)volume->size[0] * (size_t)volume->size[1] * (size_t)volume->size[2];
}

/* Returns false if the file is missing. */
static bool take_stamp(const char *path, Stamp *stamp)
{
    struct stat status;
    if (stat(path, &status) != 0)
        return false;
    *stamp = (Stamp){status.st_dev, status.st_ino, status.st_size, status.st_mtim};
    return true;
}

static bool take_stamps(const char *path, Stamp stamps[2])
{
    char raw[VOLUME_PATH_SIZE];
    VolumeHeader header;
    Error none;
    if (!take_stamp(path, &stamps[0]) || !volume_header_load(path, &header, &none))
        return false;
    volume_raw_path(path, &header, raw);
    return take_stamp(raw, &stamps[1]);
}

static bool same_stamp(const Stamp *a, const Stamp *b)
{
    return a->device == b->device && a->number == b->number && a->size == b->size &&
           a->written.tv_sec == b->written.tv_sec && a->written.tv_nsec == b->written.tv_nsec;
}

static Kept *find_stamps(const Stamp stamps[2])
{
    for (Kept *kept = all_kept; kept; kept = kept->next)
        if (same_stamp(&kept->stamps[0], &stamps[0]) && same_stamp(&kept->stamps[1], &stamps[1]))
            return kept;
    return NULL;
}

static bool same(const VolumeData *a, const VolumeData *b)
{
    bool places = true;
    for (int k = 0; k < 3; k++)
        places &= a->size[k] == b->size[k] && a->corner[k] == b->corner[k] && a->spacing[k] == b->spacing[k];
    return places && memcmp(a->value, b->value, values_of(a) * sizeof *a->value) == 0;
}

static void find_range(RangedVolume *data)
{
    const size_t count = values_of(&data->volume);
    bool any = false;
    for (size_t i = 0; i < count; i++) {
        const float value = data->volume.value[i];
        if (!isfinite(value))
            continue;
        data->low = any ? fminf(data->low, value) : value;
        data->high = any ? fmaxf(data->high, value) : value;
        any = true;
    }
}

const RangedVolume *volume_kept(const char *path, Error *error)
{
    VolumeData volume;
    float *values;
    Stamp stamps[2] = {{0}};
    const bool stamped = take_stamps(path, stamps);
    Kept *kept = stamped ? find_stamps(stamps) : NULL;
    if (kept)
        return &kept->data;
    if (!volume_file_load(path, &volume, &values, error)) {
        free(values);
        return NULL;
    }
    for (kept = all_kept; kept; kept = kept->next)
        if (same(&kept->data.volume, &volume)) {
            free(values);
            memcpy(kept->stamps, stamps, sizeof stamps);
            return &kept->data;
        }
    kept = calloc(1, sizeof *kept);
    if (!kept) {
        free(values);
        error_set(error, "%.300s: no memory", path);
        return NULL;
    }
    kept->data.volume = volume;
    memcpy(kept->stamps, stamps, sizeof stamps);
    find_range(&kept->data);
    kept->next = all_kept;
    all_kept = kept;
    return &kept->data;
}
