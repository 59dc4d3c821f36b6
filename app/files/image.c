#include "app/files/pictures.h"
#include "app/scene/scene.h"
#include "app/scene/yaml/yaml.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool image_create(Image *image, int width, int height)
{
    *image = (Image){width, height, calloc((size_t)width * (size_t)height, 3)};
    return image->rgb != NULL;
}

void image_destroy(Image *image)
{
    free(image->rgb);
    *image = (Image){0};
}

static void on_png_error(png_structp png, png_const_charp message)
{
    snprintf(png_get_error_ptr(png), 128, "%s", message);
    longjmp(*png_set_longjmp_fn(png, longjmp, sizeof(jmp_buf)), 1);
}

static void on_png_warning(png_structp png, png_const_charp message)
{
    (void)png, (void)message;
}

/* Detects short writes: libpng's own writer checks them, but its flush does not. */
static void write_bytes(png_structp png, png_bytep data, size_t size)
{
    if (fwrite(data, 1, size, png_get_io_ptr(png)) != size)
        png_error(png, strerror(errno));
}

static void flush_bytes(png_structp png)
{
    if (fflush(png_get_io_ptr(png)) != 0)
        png_error(png, strerror(errno));
}

/* Adds the text; libpng copies the strings. */
static void add_text(png_structp png, png_infop info, const ImageText *text)
{
    char time[40];
    snprintf(time, sizeof time, "%.9g", text->time);
    const png_text chunks[] = {
        {.compression = PNG_TEXT_COMPRESSION_NONE,
         .key = (char *)"Software",
         .text = (char *)"slosh " SLOSH_VERSION},
        {.compression = PNG_ITXT_COMPRESSION_NONE, .key = (char *)PICTURE_NAME, .text = (char *)text->name},
        {.compression = PNG_ITXT_COMPRESSION_NONE, .key = (char *)PICTURE_TIME, .text = time},
        {.compression = PNG_ITXT_COMPRESSION_zTXt, .key = (char *)PICTURE_SCENE, .text = (char *)text->scene},
    };
    png_set_text(png, info, chunks, sizeof chunks / sizeof *chunks);
}

static void write_png(png_structp png, png_infop info, const Image *image, const ImageText *text)
{
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_compression_level(png, 6);
    if (text)
        add_text(png, info, text);
    png_write_info(png, info);
    for (int y = 0; y < image->height; y++)
        png_write_row(png, image->rgb + 3 * (size_t)image->width * (size_t)y);
    png_write_end(png, info);
}

bool image_write_stream(const Image *image, const ImageText *text, FILE *stream, const char *name,
                        Error *error)
{
    char reason[128] = "out of memory";
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, reason, on_png_error, on_png_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    bool written = false;
    if (info && !setjmp(png_jmpbuf(png))) {
        png_set_write_fn(png, stream, write_bytes, flush_bytes);
        write_png(png, info, image, text);
        flush_bytes(png);
        written = true;
    }
    png_destroy_write_struct(&png, &info);
    return written || error_set(error, "%s: cannot write the picture: %s", name, reason);
}

bool image_write(const Image *image, const ImageText *text, const char *path, Error *error)
{
    FILE *file = fopen(path, "wb");
    if (!file)
        return error_set(error, "%s: cannot create the file: %s", path, strerror(errno));
    bool written = image_write_stream(image, text, file, path, error);
    if (fclose(file) != 0 && written)
        written = error_set(error, "%s: cannot write the picture: %s", path, strerror(errno));
    if (!written)
        unlink(path);
    return written;
}

bool image_read(const char *path, Image *image, Error *error)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&png, path))
        return error_set(error, "%.300s: %s", path, png.message);
    png.format = PNG_FORMAT_RGB;
    const bool capacity =
        png.width <= 16384 && png.height <= 16384 && image_create(image, (int)png.width, (int)png.height);
    if (capacity && png_image_finish_read(&png, NULL, image->rgb, 0, NULL))
        return true;
    error_set(error, "%.300s: %s", path, capacity ? png.message : "no memory for the picture");
    if (capacity)
        image_destroy(image);
    else
        png_image_free(&png);
    return false;
}

/* A SceneFileNamed: adds a setting with only the last part of a whole path. */
static void leave_folder(void *user, YamlNode *node, const char *path)
{
    const char *slash = strrchr(node->text, '/');
    if (slash && (*node->text == '/' || *node->text == '~'))
        setting_list_add_text(user, path, slash + 1);
}

/* Shortens the whole paths in the text, which is replaced. Returns false if such a path remains. */
static bool leave_paths(char **text, Error *error)
{
    SettingList names = {.count = 0};
    YamlTree tree;
    bool ok = tree_read(&tree, "the scene", *text, strlen(*text), error);
    if (ok)
        scene_each_file(&tree, leave_folder, &names);
    for (int i = 0; ok && i < names.count; i++) {
        char *next = yaml_patch("the scene", *text, strlen(*text), names.set[i], NULL, error);
        ok = next != NULL;
        if (ok)
            free(*text);
        *text = ok ? next : *text;
    }
    ok = ok && !names.lacks;
    tree_free(&tree);
    setting_list_free(&names);
    return ok;
}

bool embedded_scene_make(const SceneSource *save, EmbeddedScene *out, Error *error)
{
    char beside[1100];
    SceneSaved saved;
    const char *slash = strrchr(save->path, '/'), *name = slash ? slash + 1 : save->path;
    *out = (EmbeddedScene){.scene = NULL};
    snprintf(beside, sizeof beside, "%.*spicture.png", (int)(name - save->path), save->path);
    char *text = scene_save_text(save, beside, &saved, error);
    setting_list_free(&saved.changed);
    if (!text || !leave_paths(&text, error) ||
        (strlen(text) > PICTURE_TEXT_MAX && !error_set(error, "%s: more than 1 MiB of text", save->path))) {
        free(text);
        return false;
    }
    out->scene = text;
    snprintf(out->name, sizeof out->name, "%s", name);
    return true;
}

ImageText embedded_scene_text(const EmbeddedScene *embedded, double time)
{
    return (ImageText){embedded->scene, embedded->name, time};
}

void embedded_scene_free(EmbeddedScene *embedded)
{
    free(embedded->scene);
    *embedded = (EmbeddedScene){.scene = NULL};
}
