/* MP4 files of H.264 and animated GIF, by a pipe to the program ffmpeg. */
#ifndef SLOSH_VIDEO_H
#define SLOSH_VIDEO_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Video Video;

/* Whether the path ends in ".gif". */
bool video_is_gif(const char *path);

/* Starts ffmpeg: for a GIF where the path says so, with a palette of its own for each picture, at most 50 a
   second, which play in a loop; else for an MP4. An odd width or height gets its last column or row twice,
   since MP4 knows only even ones. The file appears at its name when it is whole. NULL with the reason: the
   file can't be written (see output_begin), ffmpeg is not there. */
Video *video_create(const char *path, int width, int height, double fps, Error *error);

/* One more picture: 3 * width * height bytes of sRGB, rows from the top down. False when ffmpeg has ended:
   `error` has its last line. */
bool video_add(Video *video, const uint8_t *rgb, Error *error);

/* Waits for ffmpeg, gives the file its name and frees `video`. On failure no file is left. A video without
   pictures is a failure. */
bool video_finish(Video *video, Error *error);

/* Ends ffmpeg, removes the file, frees `video`; NULL is allowed. */
void video_discard(Video *video);

#endif
