#include "app/scene/scene.h"

#include "app/base/file.h"
#include "app/base/program.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

enum { CHUNKS_MAX = 256 };

typedef struct PngSource {
    const char *bytes;
    size_t size, at;
    char reason[128];
} PngSource;

bool picture_text_name(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ".png") == 0;
}

/* True if the bytes begin like a PNG file. */
static bool picture_text_is_png(const char *bytes, size_t size)
{
    enum { SIGNATURE = 8 };
    return size >= SIGNATURE && png_sig_cmp((png_const_bytep)bytes, 0, SIGNATURE) == 0;
}

static void on_error(png_structp png, png_const_charp message)
{
    PngSource *source = png_get_error_ptr(png);
    if (!*source->reason)
        snprintf(source->reason, sizeof source->reason, "%s", message);
    longjmp(*png_set_longjmp_fn(png, longjmp, sizeof(jmp_buf)), 1);
}

/* Keeps the first warning: libpng only warns about skipped text. */
static void on_warning(png_structp png, png_const_charp message)
{
    PngSource *source = png_get_error_ptr(png);
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
    PngSource *source = png_get_io_ptr(png);
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

static bool take(const char *path, const PngSource *source, png_structp png, png_infop info, PictureText *out,
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
    PngSource source = {.bytes = bytes, .size = size};
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

int scene_path_is_yaml(const struct dirent *entry)
{
    const char *dot = strrchr(entry->d_name, '.');
    return dot && dot != entry->d_name && strcmp(dot, ".yaml") == 0;
}

/* Adds the scene names of a folder. */
static void add_names(SceneNames *names, const char *folder)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, scene_path_is_yaml, alphasort);
    for (int i = 0; i < count; i++) {
        const char *name = entries[i]->d_name;
        const size_t length = strlen(name) - strlen(".yaml");
        if (names->count < SCENE_NAMES_MAX && length < sizeof names->name[0])
            snprintf(names->name[names->count++], sizeof names->name[0], "%.*s", (int)length, name);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
}

void scene_path_names(SceneNames *names)
{
    char folder[PROGRAM_PATH_SIZE], scenes[PROGRAM_PATH_SIZE + 8];
    names->count = 0;
    if (!program_data_folder(folder))
        return;
    snprintf(scenes, sizeof scenes, "%s/scenes", folder);
    add_names(names, scenes);
}

/* True if the path exists and is not a folder. */
static bool try_path(char path[SCENE_PATH_SIZE], const char *folder, const char *name, const char *ending)
{
    struct stat status;
    const int length = snprintf(path, SCENE_PATH_SIZE, "%s%s%s", folder, name, ending);
    return length < SCENE_PATH_SIZE && stat(path, &status) == 0 && !S_ISDIR(status.st_mode);
}

/* Collects all possible names: scenes of slosh, the user's scenes, scenes in the present folder. */
static void all_names(SceneNames *names)
{
    char folder[PROGRAM_PATH_SIZE], scenes[PROGRAM_PATH_SIZE + 8];
    scene_path_names(names);
    if (program_user_folder(folder)) {
        snprintf(scenes, sizeof scenes, "%s/scenes", folder);
        add_names(names, scenes);
        add_names(names, folder);
    }
    add_names(names, ".");
}

static bool no_file(const char *name, Error *error)
{
    SceneNames names;
    Suggestion near = suggest_for(name);
    char hint[96] = "name a scene file", shipped[PROGRAM_PATH_SIZE], own[PROGRAM_PATH_SIZE];
    all_names(&names);
    for (int i = 0; i < names.count; i++)
        suggest_offer(&near, names.name[i]);
    if (near.best)
        snprintf(hint, sizeof hint, "did you mean '%.60s'?", near.best);
    if (*name == '/')
        return error_set(error, "%.300s: no such file; %s", name, hint);
    const bool has_shipped = program_data_folder(shipped), has_own = program_user_folder(own);
    return error_set(error, "%.300s: no such file, neither here%s%.300s%s%s%.300s; %s", name,
                     has_shipped ? " nor in " : "", has_shipped ? shipped : "", has_shipped ? "/scenes" : "",
                     has_own ? " nor in " : "", has_own ? own : "", hint);
}

/* Looks in a folder and in its folder scenes/. */
static bool try_folder(char path[SCENE_PATH_SIZE], const char *folder, const char *name)
{
    char beside[PROGRAM_PATH_SIZE + 2], among[PROGRAM_PATH_SIZE + 16];
    snprintf(beside, sizeof beside, "%s/", folder);
    snprintf(among, sizeof among, "%s/scenes/", folder);
    return try_path(path, beside, name, "") || try_path(path, among, name, "") ||
           try_path(path, among, name, ".yaml") || try_path(path, beside, name, ".yaml");
}

bool scene_path_find(const char *name, char path[SCENE_PATH_SIZE], Error *error)
{
    if (!*name)
        return error_set(error, "the scene's name is empty; name a file such as scenes/box_slosh.yaml");
    if (try_path(path, "", name, ""))
        return true;
    char folder[PROGRAM_PATH_SIZE];
    if (*name != '/' && ((program_data_folder(folder) && try_folder(path, folder, name)) ||
                         (program_user_folder(folder) && try_folder(path, folder, name)) ||
                         try_path(path, "", name, ".yaml")))
        return true;
    const int length = snprintf(path, SCENE_PATH_SIZE, "%s", name);
    return (length < SCENE_PATH_SIZE && access(path, F_OK) == 0) || no_file(name, error);
}

/* Names the command that takes a different file of slosh; NULL: unknown file. */
static const char *taken_by(const char *bytes, size_t size)
{
    static const struct {
        const char *begin, *words;
    } kinds[] = {
        {"slosh recording ",
         "a recorded session, no scene; the window, slosh replay and slosh render take it"},
        {"slosh device recording ", "a recording of motion devices, no scene; --device file:PATH takes it"},
        {"\x89HDF\r\n\x1a\n",
         "a file of snapshots, no scene; slosh play, slosh render and slosh export take it, and slosh run goes on with one by -o and "
         "--resume"},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (size >= strlen(kinds[i].begin) && memcmp(bytes, kinds[i].begin, strlen(kinds[i].begin)) == 0)
            return kinds[i].words;
    return NULL;
}

/* The scene embedded in a picture. */
static char *read_picture(const char *path, size_t *size, Error *error)
{
    PictureText text;
    if (!picture_text_read(path, &text, error))
        return NULL;
    *size = text.size;
    return text.scene;
}

/* Reads at most one byte more than the limit, whatever the file size claims; of a picture, the embedded
   scene. */
static char *read_bytes(FILE *file, const char *path, size_t *size, Error *error)
{
    char *bytes = malloc(SCENE_BYTES_MAX + 1);
    if (!bytes) {
        error_set(error, "%s: no memory to read it", path);
        return NULL;
    }
    *size = fread(bytes, 1, SCENE_BYTES_MAX + 1, file);
    const bool failed = ferror(file);
    if (!failed && picture_text_is_png(bytes, *size)) {
        free(bytes);
        return read_picture(path, size, error);
    }
    const char *other = failed ? NULL : taken_by(bytes, *size);
    if (other)
        error_set(error, "%s: %s", path, other);
    else if (failed)
        error_set(error, "%s: cannot be read (%s)", path, strerror(errno));
    else if (*size > SCENE_BYTES_MAX)
        error_set(error, "%s: larger than 1 MiB; a scene file is a page of YAML", path);
    if (!failed && !other && *size <= SCENE_BYTES_MAX)
        return bytes;
    free(bytes);
    return NULL;
}

char *scene_file_read(const char *path, size_t *size, Error *error)
{
    struct stat status;
    if (stat(path, &status) == 0 && S_ISDIR(status.st_mode)) {
        error_set(error, "%s: a directory; name a scene file in it", path);
        return NULL;
    }
    FILE *file = fopen(path, "rb");
    if (!file) {
        error_set(error, "%s: cannot be opened (%s)", path, strerror(errno));
        return NULL;
    }
    char *bytes = read_bytes(file, path, size, error);
    fclose(file);
    return bytes;
}
