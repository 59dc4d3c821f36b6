#include "app/base/picture_text.h"

#include "app/base/read_file.h"

#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <zlib.h>

enum { CHUNKS_MAX = 256 };

typedef struct Source {
    const char *bytes;
    size_t size, at;
    char reason[128];
} Source;

bool picture_text_name(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ".png") == 0;
}

bool picture_text_is_png(const char *bytes, size_t size)
{
    enum { SIGNATURE = 8 };
    return size >= SIGNATURE && png_sig_cmp((png_const_bytep)bytes, 0, SIGNATURE) == 0;
}

static void on_error(png_structp png, png_const_charp message)
{
    Source *source = png_get_error_ptr(png);
    if (!*source->reason)
        snprintf(source->reason, sizeof source->reason, "%s", message);
    longjmp(*png_set_longjmp_fn(png, longjmp, sizeof(jmp_buf)), 1);
}

/* Keeps the first warning: libpng only warns about skipped text. */
static void on_warning(png_structp png, png_const_charp message)
{
    Source *source = png_get_error_ptr(png);
    if (!*source->reason)
        snprintf(source->reason, sizeof source->reason, "%s", message);
}

/* Limits allocations: libpng allocates a chunk's claimed size, and only warns about its limit. */
static png_voidp allocate(png_structp png, png_alloc_size_t size)
{
    (void)png;
    return size <= 4 * (png_alloc_size_t)PICTURE_TEXT_MAX ? malloc(size) : NULL;
}

static void release(png_structp png, png_voidp memory)
{
    (void)png;
    free(memory);
}

static void give(png_structp png, png_bytep out, size_t count)
{
    Source *source = png_get_io_ptr(png);
    if (count > source->size - source->at)
        png_error(png, "the file ends too early");
    memcpy(out, source->bytes + source->at, count);
    source->at += count;
}

static size_t length_of(const png_text *text)
{
    return text->compression >= PNG_ITXT_COMPRESSION_NONE ? text->itxt_length : text->text_length;
}

/* The last text of that key, as for repeated keys. */
static const png_text *find(const png_text *texts, int count, const char *key)
{
    const png_text *found = NULL;
    for (int i = 0; i < count; i++)
        if (strcmp(texts[i].key, key) == 0)
            found = &texts[i];
    return found;
}

/* True if a file name is safe for a terminal: ASCII without control characters. */
static bool is_plain(const char *name)
{
    for (const char *c = name; *c; c++)
        if (*c < ' ' || *c > '~' || *c == '/')
            return false;
    return strlen(name) < PICTURE_NAME_SIZE;
}

static void take_rest(const png_text *texts, int count, PictureText *out)
{
    const png_text *name = find(texts, count, PICTURE_NAME), *time = find(texts, count, PICTURE_TIME);
    char *end;
    if (name && is_plain(name->text))
        snprintf(out->name, sizeof out->name, "%s", name->text);
    out->time = time ? strtod(time->text, &end) : NAN;
    if (time && (*end || end == time->text || !isfinite(out->time)))
        out->time = NAN;
}

static bool take(const char *path, const Source *source, png_structp png, png_infop info, PictureText *out,
                 Error *error)
{
    png_textp texts = NULL;
    int count = 0;
    png_get_text(png, info, &texts, &count);
    const png_text *scene = find(texts, count, PICTURE_SCENE);
    for (const png_text *other = texts; other < scene; other++)
        if (strcmp(other->key, PICTURE_SCENE) == 0)
            return error_set(error, "%.300s: the picture carries more than one scene; which one is meant?",
                             path);
    if (!scene)
        return error_set(error,
                         "%.300s: the picture carries no scene%s%s; pictures of slosh do, unless "
                         "view.carries_scene: false or another program has taken it out",
                         path, *source->reason ? ": " : "", source->reason);
    out->size = length_of(scene);
    if (out->size > PICTURE_TEXT_MAX)
        return error_set(error, "%.300s: its scene is larger than 1 MiB; a scene is a page of YAML", path);
    out->scene = malloc(out->size + 1);
    if (!out->scene)
        return error_set(error, "%.300s: no memory to read it", path);
    memcpy(out->scene, scene->text, out->size);
    out->scene[out->size] = 0;
    take_rest(texts, count, out);
    return true;
}

static uint32_t big_endian(const unsigned char *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Checks length and sum of each chunk, also behind the text, where libpng stops. Returns NULL, or the fault.
 */
static const char *wrong_behind(const char *bytes, size_t size)
{
    enum { SIGNATURE = 8, FRAME = 12 }; /* length, name, sum */
    for (size_t at = SIGNATURE; size - at >= FRAME;) {
        const unsigned char *chunk = (const unsigned char *)bytes + at;
        const uint32_t length = big_endian(chunk);
        if (length > size - at - FRAME)
            break;
        if (crc32(0, chunk + 4, length + 4) != big_endian(chunk + 8 + length))
            return "a part has a false sum";
        if (memcmp(chunk + 4, "IEND", 4) == 0)
            return NULL;
        at += FRAME + length;
    }
    return "the file ends too early";
}

bool picture_text_parse(const char *path, const char *bytes, size_t size, PictureText *out, Error *error)
{
    Source source = {.bytes = bytes, .size = size};
    *out = (PictureText){.time = NAN};
    png_structp png = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning, NULL,
                                               allocate, release);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    volatile bool read = false;
    if (info && !setjmp(png_jmpbuf(png))) {
        png_set_read_fn(png, &source, give);
        png_set_chunk_malloc_max(png, PICTURE_TEXT_MAX + 4096);
        png_set_chunk_cache_max(png, CHUNKS_MAX);
        png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
        png_read_info(png, info);
        read = true;
    }
    const char *wrong = read ? wrong_behind(bytes, size) : NULL;
    if (wrong) {
        snprintf(source.reason, sizeof source.reason, "%s", wrong);
        read = false;
    }
    const bool ok = read ? take(path, &source, png, info, out, error)
                         : error_set(error, "%.300s: a cut or damaged picture: %s", path,
                                     *source.reason ? source.reason : "no memory to read it");
    png_destroy_read_struct(&png, &info, NULL);
    return ok;
}

bool picture_text_read(const char *path, PictureText *out, Error *error)
{
    size_t size;
    *out = (PictureText){.time = NAN};
    char *bytes = read_file(path, PICTURE_FILE_MAX, "picture", &size, error);
    if (!bytes)
        return false;
    const bool ok = picture_text_is_png(bytes, size) ? picture_text_parse(path, bytes, size, out, error)
                                                     : error_set(error, "%.300s: no PNG file", path);
    free(bytes);
    return ok;
}
