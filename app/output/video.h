/* MP4 files of H.264 and animated GIFs, written through a pipe to ffmpeg. */
#ifndef SLOSH_VIDEO_H
#define SLOSH_VIDEO_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Video Video;

/* True if the path ends in ".gif". */
bool video_is_gif(const char *path);

/* Starts ffmpeg. A path with .gif gives a GIF with a palette per picture, at most 50 pictures per second,
   played in a loop; other paths give an MP4. An odd width or height gets its last column or row twice, as MP4
   needs even sizes. The file appears under its name when complete. Returns NULL with the reason: not writable
   (see output_begin), or ffmpeg is missing. */
Video *video_create(const char *path, int width, int height, double fps, Error *error);

/* Adds a picture: 3 * width * height bytes of sRGB, rows from the top down. Returns false if ffmpeg has
   ended: `error` has its last line. */
bool video_add(Video *video, const uint8_t *rgb, Error *error);

/* Waits for ffmpeg, gives the file its name and frees `video`. Leaves no file on failure. A video without
   pictures is a failure. */
bool video_finish(Video *video, Error *error);

/* Ends ffmpeg, removes the file, frees `video`; NULL is allowed. */
void video_discard(Video *video);

#endif
