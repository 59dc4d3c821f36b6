#include "app/play/files.h"

#include "app/base/output.h"
#include "app/files/pictures.h"
#include "sim/base/stage.h"

#include <stdio.h>

static const double MOVIE_FPS = 30;

static bool read_picture(const Panels *panels, int width, int height, Image *image, Error *error)
{
    if (!image_create(image, width, height))
        return error_set(error, "no memory for a picture");
    return panels_read(panels, image->rgb, error);
}

static void take_screenshot(Files *files, const Panels *panels, int width, int height, const ImageText *text,
                            Notice *notice)
{
    Image image = {0};
    Output output = {.temp = ""};
    Error error = {{0}};
    char path[1024];
    dated_file_name(path, "png");
    files->shoot = false;
    if (read_picture(panels, width, height, &image, &error) && output_begin(&output, path, &error) &&
        image_write(&image, text, output.temp, &error) && output_commit(&output, &error))
        notice_tell(notice, text ? "%s: the picture; slosh %s opens its scene again" : "%s: the picture",
                    path, path);
    else
        notice_error(notice, error.message);
    output_discard(&output);
    image_destroy(&image);
}

bool files_end(Files *files, Notice *notice)
{
    Error error = {{0}};
    Video *video = files->video;
    if (!video)
        return true;
    files->video = NULL;
    if (!video_finish(video, &error)) {
        notice_error(notice, error.message);
        return false;
    }
    notice_tell(notice, "%s: the video, %.1f s", files->path, (double)files->pictures / MOVIE_FPS);
    return true;
}

bool files_due(const Files *files)
{
    return files->video && wall_ms() >= files->next_ms;
}

void files_video(Files *files, int width, int height, Notice *notice)
{
    Error error = {{0}};
    if (files->video) {
        files_end(files, notice);
        return;
    }
    *files = (Files){.shoot = files->shoot, .width = width, .height = height};
    dated_file_name(files->path, "mp4");
    files->video = video_create(files->path, width, height, MOVIE_FPS, &error);
    if (files->video)
        notice_tell(notice, "%s: recording until you ask again", files->path);
    else
        notice_error(notice, error.message);
}

/* Adds the picture as often as frames are due: a video runs at its own, even rate. Frames lost in a stall of
   over a second stay lost. */
static bool add_due(Files *files, const Image *image, Error *error)
{
    const double now = wall_ms();
    if (files->pictures == 0 || files->next_ms < now - 1000)
        files->next_ms = now;
    while (files->next_ms <= now) {
        if (!video_add(files->video, image->rgb, error))
            return false;
        files->next_ms += 1000 / MOVIE_FPS;
        files->pictures++;
    }
    return true;
}

static void take_frame(Files *files, const Panels *panels, int width, int height, Notice *notice)
{
    Image image = {0};
    Error error = {{0}};
    if (width != files->width || height != files->height) {
        files_end(files, notice);
        return;
    }
    if (!read_picture(panels, width, height, &image, &error) || !add_due(files, &image, &error)) {
        video_discard(files->video);
        files->video = NULL;
        notice_error(notice, error.message);
    }
    image_destroy(&image);
}

void files_take(Files *files, const Panels *panels, int width, int height, const ImageText *text,
                Notice *notice)
{
    if (files_due(files))
        take_frame(files, panels, width, height, notice);
    if (files->shoot)
        take_screenshot(files, panels, width, height, text, notice);
}
