#include "app/output/pictures.h"

#include "app/base/output.h"
#include "app/output/video.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

struct Pictures {
    PicturesKind kind;
    char path[1024];
    Video *video;
    Output png;
    const ImageText *text; /* NULL: none */
    size_t count, of;      /* written; to come, 0: not known */
    bool made_folder;
};

bool pictures_kind(const char *path, PicturesKind *kind, Error *error)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *extension = strrchr(name, '.');
    if (path[0] && (!extension || extension == name || strcmp(name, "..") == 0))
        *kind = PICTURES_FOLDER;
    else if (extension && strcasecmp(extension, ".png") == 0)
        *kind = PICTURES_PNG;
    else if (extension && (strcasecmp(extension, ".mp4") == 0 || video_is_gif(path)))
        *kind = PICTURES_VIDEO;
    else
        return error_set(error, "cannot tell the format from '%s'; use .png, .mp4, .gif or a folder name",
                         path);
    return true;
}

static void frame_path(const Pictures *pictures, size_t index, char path[1088])
{
    size_t length = strlen(pictures->path);
    const char *slash = length && pictures->path[length - 1] == '/' ? "" : "/";
    snprintf(path, 1088, "%s%sframe_%0*zu.png", pictures->path, slash, number_digits(pictures->of, 5), index);
}

/* Makes the folder, and checks that a file can be written there. */
static bool begin_folder(Pictures *pictures, Error *error)
{
    char frame[1088];
    struct stat status;
    if (mkdir(pictures->path, 0777) == 0)
        pictures->made_folder = true;
    else if (errno != EEXIST)
        return error_set(error, "%s: the folder cannot be created: %s", pictures->path, strerror(errno));
    else if (stat(pictures->path, &status) == 0 && !S_ISDIR(status.st_mode))
        return error_set(error, "%s: is a file, not a folder; name a FILE.png, a FILE.mp4 or a folder",
                         pictures->path);
    frame_path(pictures, 0, frame);
    return output_check(frame, error);
}

static bool begin(Pictures *pictures, int width, int height, double fps, Error *error)
{
    if (strlen(pictures->path) + 1 == sizeof pictures->path)
        return error_set(error, "the name of the output is too long; name a shorter one");
    if (!pictures_kind(pictures->path, &pictures->kind, error))
        return false;
    if (pictures->kind == PICTURES_PNG)
        return output_begin(&pictures->png, pictures->path, error);
    if (pictures->kind == PICTURES_FOLDER)
        return begin_folder(pictures, error);
    pictures->video = video_create(pictures->path, width, height, fps, error);
    return pictures->video != NULL;
}

Pictures *pictures_create(const char *path, int width, int height, double fps, size_t count, Error *error)
{
    Pictures *pictures = calloc(1, sizeof *pictures);
    if (!pictures) {
        error_set(error, "%s: out of memory", path);
        return NULL;
    }
    snprintf(pictures->path, sizeof pictures->path, "%s", path);
    pictures->of = count;
    if (begin(pictures, width, height, fps, error))
        return pictures;
    pictures_discard(pictures);
    return NULL;
}

static bool write_png(const Output *output, const Image *image, const ImageText *text, Error *error)
{
    FILE *file = fopen(output->temp, "wb");
    if (!file)
        return error_set(error, "%s: cannot write the picture: %s", output->path, strerror(errno));
    bool written = image_write_stream(image, text, file, output->path, error);
    if (fclose(file) != 0 && written)
        written = error_set(error, "%s: cannot write the picture: %s", output->path, strerror(errno));
    return written;
}

static bool add_frame(const Pictures *pictures, const Image *image, Error *error)
{
    char path[1088];
    Output output = {0};
    frame_path(pictures, pictures->count, path);
    if (!output_begin(&output, path, error))
        return false;
    if (write_png(&output, image, pictures->text, error))
        return output_commit(&output, error);
    output_discard(&output);
    return false;
}

void pictures_carry(Pictures *pictures, const ImageText *text)
{
    pictures->text = text;
}

bool pictures_add(Pictures *pictures, const Image *image, Error *error)
{
    bool added = pictures->kind == PICTURES_PNG     ? write_png(&pictures->png, image, pictures->text, error)
                 : pictures->kind == PICTURES_VIDEO ? video_add(pictures->video, image->rgb, error)
                                                    : add_frame(pictures, image, error);
    pictures->count += added;
    return added;
}

bool pictures_has_older(const Pictures *pictures, char frame[1088])
{
    frame_path(pictures, pictures->count, frame);
    return pictures->kind == PICTURES_FOLDER && access(frame, F_OK) == 0;
}

bool pictures_finish(Pictures *pictures, Error *error)
{
    bool finished = true;
    if (pictures->kind == PICTURES_VIDEO) {
        finished = video_finish(pictures->video, error);
        pictures->video = NULL;
    } else if (pictures->kind == PICTURES_PNG) {
        finished = pictures->count > 0 ? output_commit(&pictures->png, error)
                                       : error_set(error, "%s: no picture was made", pictures->path);
    }
    pictures_discard(pictures);
    return finished;
}

size_t pictures_staying(const Pictures *pictures)
{
    return pictures && pictures->kind == PICTURES_FOLDER ? pictures->count : 0;
}

void pictures_discard(Pictures *pictures)
{
    if (!pictures)
        return;
    video_discard(pictures->video);
    output_discard(&pictures->png);
    if (pictures->made_folder && pictures->count == 0)
        rmdir(pictures->path);
    free(pictures);
}
