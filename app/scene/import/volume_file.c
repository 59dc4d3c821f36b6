#include "app/scene/import/import.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/scene/yaml/yaml.h"
#include "sim/base/key_rows.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <time.h>

enum { HEADER_BYTES_MAX = 1 << 20 };

static const struct {
    const char *name;
    size_t bytes;
} types[] = {
    [VOLUME_UINT8] = {"uint8", 1}, [VOLUME_INT8] = {"int8", 1},       [VOLUME_UINT16] = {"uint16", 2},
    [VOLUME_INT16] = {"int16", 2}, [VOLUME_FLOAT32] = {"float32", 4},
};

static const char *type_name(int type)
{
    return type <= VOLUME_FLOAT32 ? types[type].name : NULL;
}

static const char *order_name(int order)
{
    static const char *const names[] = {"little", "big", NULL};
    return names[order];
}

#define AT(field) offsetof(VolumeHeader, field)

static const Key keys[] = {
    TEXT("file", R, VOLUME_NAME_SIZE, AT(file), NULL, "the raw file, beside the header"),
    VEC3("size", R, "", 2, 65536, AT(size), "values along x, y, z"),
    CHOICE("type", R | KEY_INDEX, type_name, AT(type), "of the raw values"),
    CHOICE("byte_order", KEY_INDEX, order_name, AT(big), "of the raw values"),
    VEC3("spacing", R, "m", 1e-9, 1e6, AT(spacing), "between values"),
    VEC3("corner", 0, "m", -1e6, 1e6, AT(corner), "of the first value"),
    NUMBER("scale", 0, "", -1e30, 1e30, AT(scale), "of raw values"),
    NUMBER("offset", 0, "", -1e30, 1e30, AT(offset), "a value is offset + scale raw"),
    KEYS_END,
};

/* ---- the header ---- */

static bool known(const YamlTree *tree, const YamlNode *child, Error *error)
{
    Suggestion near = suggest_for(child->key);
    for (const Key *row = keys; row->path; row++) {
        suggest_offer(&near, row->path);
        if (strcmp(row->path, child->key) == 0)
            return true;
    }
    return tree_error_key(tree, child, error, "unknown key '%.60s'; %s%s", child->key,
                          near.best ? "did you mean "
                                    : "known here: file, size, type, byte_order, spacing, corner, ",
                          near.best ? near.best : "scale, offset");
}

static bool read_keys(const YamlTree *tree, VolumeHeader *header, Error *error)
{
    for (const YamlNode *child = tree->root->first; child; child = child->next)
        if (!known(tree, child, error))
            return false;
    for (const Key *row = keys; row->path; row++) {
        const YamlNode *child = node_child(tree->root, row->path);
        if (!child && row->flags & R)
            return error_set(error, "%s: '%s' is missing: %s", tree->path, row->path, row->help);
        if (child && !value_read(tree, row, child, row->path, (char *)header, error))
            return false;
    }
    const double *n = header->size;
    for (int k = 0; k < 3; k++)
        if (n[k] != rint(n[k]))
            return tree_error(tree, node_child(tree->root, "size"), error,
                              "size must be whole numbers, not %g", n[k]);
    return n[0] * n[1] * n[2] <= 0x1p32 ||
           tree_error(tree, node_child(tree->root, "size"), error, "size is %g values; at most 2^32 are read",
                      n[0] * n[1] * n[2]);
}

bool volume_header_parse(const char *path, const char *bytes, size_t size, VolumeHeader *header, Error *error)
{
    YamlTree tree = {.path = path};
    *header = (VolumeHeader){.scale = 1};
    bool ok = yaml_read(&tree, NULL, bytes, size, &tree.root, error);
    if (ok && tree.root && tree.root->kind == NODE_MAPPING)
        ok = read_keys(&tree, header, error);
    else if (ok)
        ok = error_set(error, "%s:1:1: no volume's header; it has `file:`, `size:`, `type:` and `spacing:`",
                       path);
    tree_free(&tree);
    return ok;
}

bool volume_header_load(const char *path, VolumeHeader *header, Error *error)
{
    struct stat status;
    size_t size;
    *header = (VolumeHeader){.file = ""};
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))
        return error_set(error, "%s: no regular file; a header is read more than once", path);
    char *text = read_file(path, HEADER_BYTES_MAX, "volume's header", &size, error);
    const bool parsed = text && volume_header_parse(path, text, size, header, error);
    free(text);
    return parsed;
}

void volume_raw_path(const char *path, const VolumeHeader *header, char raw[VOLUME_PATH_SIZE])
{
    const char *slash = strrchr(path, '/');
    const int folder = slash && header->file[0] != '/' ? (int)(slash - path) + 1 : 0;
    snprintf(raw, VOLUME_PATH_SIZE, "%.*s%s", folder, path, header->file);
}

static size_t count_of(const VolumeHeader *header)
{
    return (size_t)header->size[0] * (size_t)header->size[1] * (size_t)header->size[2];
}

size_t volume_header_bytes(const VolumeHeader *header)
{
    return count_of(header) * types[header->type].bytes;
}

/* ---- the values ---- */

static double raw_value(int type, uint32_t bits)
{
    float number;
    switch (type) {
    case VOLUME_INT8:
        return (int8_t)bits;
    case VOLUME_INT16:
        return (int16_t)bits;
    case VOLUME_FLOAT32:
        memcpy(&number, &bits, sizeof number);
        return (double)number;
    default:
        return bits;
    }
}

void volume_values(const VolumeHeader *header, const unsigned char *raw, size_t count, float *value)
{
    const size_t bytes = types[header->type].bytes;
    for (size_t i = 0; i < count; i++) {
        uint32_t bits = 0;
        for (size_t b = 0; b < bytes; b++)
            bits |= (uint32_t)raw[i * bytes + b] << 8 * (header->big ? bytes - 1 - b : b);
        value[i] = (float)(header->offset + header->scale * raw_value(header->type, bits));
    }
}

/* A raw file with its header. */
typedef struct Raw {
    const char *path, *header_path;
    const VolumeHeader *header;
} Raw;

/* Checks the raw file: a device or pipe has no length to compare, and may never end. */
static bool raw_is_right(const Raw *raw, Error *error)
{
    struct stat status;
    const VolumeHeader *header = raw->header;
    const size_t wanted = volume_header_bytes(header);
    if (stat(raw->path, &status) != 0)
        return error_set(error, "%s: %s; %s says that its values are there", raw->path, strerror(errno),
                         raw->header_path);
    if (!S_ISREG(status.st_mode))
        return error_set(error, "%s: no regular file; %s says that its values are there", raw->path,
                         raw->header_path);
    if ((size_t)status.st_size != wanted)
        return error_set(error, "%s: %zu bytes, but %s says %g x %g x %g values of %s: %zu bytes", raw->path,
                         (size_t)status.st_size, raw->header_path, header->size[0], header->size[1],
                         header->size[2], type_name(header->type), wanted);
    return true;
}

/* Reads in chunks: raw values and floats are never both in memory as a whole. */
static bool read_chunks(const Raw *raw, FILE *file, float *value, Error *error)
{
    enum { CHUNK = 1 << 14 };
    unsigned char bytes[CHUNK * sizeof(float)];
    const size_t count = count_of(raw->header), each = types[raw->header->type].bytes;
    for (size_t done = 0; done < count;) {
        const size_t left = count - done, some = left < CHUNK ? left : CHUNK;
        if (fread(bytes, each, some, file) != some)
            return error_set(error, "%s: cannot be read (%s)", raw->path,
                             ferror(file) ? strerror(errno) : "it has become shorter");
        volume_values(raw->header, bytes, some, value + done);
        done += some;
    }
    return true;
}

/* Returns NULL with the reason. */
static float *read_raw(const Raw *raw, Error *error)
{
    const size_t count = count_of(raw->header), bytes = count * sizeof(float);
    if (!raw_is_right(raw, error))
        return NULL;
    float *value = (double)bytes < memory_bytes() ? calloc(count, sizeof(float)) : NULL;
    if (!value) {
        error_set(error, "%s: no memory for %zu values, %.3g GB; this machine has %.3g GB", raw->path, count,
                  1e-9 * (double)bytes, 1e-9 * memory_bytes());
        return NULL;
    }
    FILE *file = fopen(raw->path, "rb");
    const bool ok = file ? read_chunks(raw, file, value, error)
                         : error_set(error, "%s: cannot be opened (%s)", raw->path, strerror(errno));
    if (file)
        fclose(file);
    if (ok)
        return value;
    free(value);
    return NULL;
}

/* Checks for finite values: elsewhere no surface can be found. */
static bool all_finite(const char *path, const VolumeData *volume, Error *error)
{
    const size_t wide = (size_t)volume->size[0], high = (size_t)volume->size[1],
                 count = wide * high * (size_t)volume->size[2];
    for (size_t i = 0; i < count; i++)
        if (!isfinite(volume->value[i]))
            return error_set(error, "%s: value %zu %zu %zu is %g; only finite numbers can be shown", path,
                             i % wide, i / wide % high, i / wide / high, (double)volume->value[i]);
    return true;
}

bool volume_file_load(const char *path, VolumeData *volume, float **values, Error *error)
{
    VolumeHeader header;
    char raw[VOLUME_PATH_SIZE];
    *values = NULL;
    if (!volume_header_load(path, &header, error))
        return false;
    volume_raw_path(path, &header, raw);
    *values = read_raw(&(Raw){raw, path, &header}, error);
    if (!*values)
        return false;
    *volume = (VolumeData){.value = *values};
    for (int k = 0; k < 3; k++) {
        volume->size[k] = (int)header.size[k];
        volume->corner[k] = header.corner[k];
        volume->spacing[k] = header.spacing[k];
    }
    if (all_finite(raw, volume, error))
        return true;
    free(*values);
    *values = NULL;
    return false;
}

/* Identifies an unmodified file. */
typedef struct VolumeStamp {
    dev_t device;
    ino_t number;
    off_t size;
    struct timespec written;
} VolumeStamp;

typedef struct CachedVolume {
    struct CachedVolume *next;
    VolumeStamp stamps[2]; /* of the header and the raw file, when last read */
    RangedVolume data;
} CachedVolume;

static CachedVolume *all_kept;

static size_t values_of(const VolumeData *volume)
{
    return (size_t)volume->size[0] * (size_t)volume->size[1] * (size_t)volume->size[2];
}

/* Returns false if the file is missing. */
static bool take_stamp(const char *path, VolumeStamp *stamp)
{
    struct stat status;
    if (stat(path, &status) != 0)
        return false;
    *stamp = (VolumeStamp){status.st_dev, status.st_ino, status.st_size, status.st_mtim};
    return true;
}

static bool take_stamps(const char *path, VolumeStamp stamps[2])
{
    char raw[VOLUME_PATH_SIZE];
    VolumeHeader header;
    Error none;
    if (points_file_is(path))
        return take_stamp(path, &stamps[0]);
    if (!take_stamp(path, &stamps[0]) || !volume_header_load(path, &header, &none))
        return false;
    volume_raw_path(path, &header, raw);
    return take_stamp(raw, &stamps[1]);
}

static bool same_stamp(const VolumeStamp *a, const VolumeStamp *b)
{
    return a->device == b->device && a->number == b->number && a->size == b->size &&
           a->written.tv_sec == b->written.tv_sec && a->written.tv_nsec == b->written.tv_nsec;
}

static CachedVolume *find_stamps(const VolumeStamp stamps[2])
{
    for (CachedVolume *kept = all_kept; kept; kept = kept->next)
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

const RangedVolume *volume_file_cached(const char *path, Error *error)
{
    VolumeData volume;
    float *values;
    VolumeStamp stamps[2] = {{0}};
    const bool stamped = take_stamps(path, stamps);
    CachedVolume *kept = stamped ? find_stamps(stamps) : NULL;
    if (kept)
        return &kept->data;
    if (!(points_file_is(path) ? points_file_load(path, &volume, &values, error)
                               : volume_file_load(path, &volume, &values, error))) {
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
