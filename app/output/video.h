/* MP4 files of H.264, by a pipe to the program ffmpeg. */
#ifndef SLOSH_VIDEO_H
#define SLOSH_VIDEO_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Video Video;

/* Starts ffmpeg. An odd width or height gets its last column or row twice, since the format knows only even
   ones. The file appears at its name when it is whole. NULL with the reason: the file can't be written (see
   output_begin), ffmpeg is not there. */
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
