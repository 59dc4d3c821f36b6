/* PNG files of 8-bit RGB, rows from the top down. */
#ifndef SLOSH_IMAGE_H
#define SLOSH_IMAGE_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* 3 * width * height bytes, sRGB. */
typedef struct Image {
    int width, height;
    uint8_t *rgb; /* owned */
} Image;

/* What a picture shows, which its file carries as text: IMAGE_TEXT_SCENE and so on (app/base/picture_text.h).
 */
typedef struct ImageText {
    const char *scene; /* its YAML */
    const char *name;  /* of its file, without folders */
    double time;       /* s, that the picture is of */
} ImageText;

/* False when memory is short. */
bool image_create(Image *image, int width, int height);
void image_destroy(Image *image);

/* Writes into an open stream and flushes it; false, with the reason, when any of it fails (a full disk too).
   `name` is for the message. The stream stays open. `text`: NULL for none. */
bool image_write_stream(const Image *image, const ImageText *text, FILE *stream, const char *name,
                        Error *error);

/* Writes the file `path`; on failure none is left. The caller renames if it must appear whole. */
bool image_write(const Image *image, const ImageText *text, const char *path, Error *error);

/* Reads a PNG file, of whatever kind its pixels are; false with the reason, and nothing to destroy. */
bool image_read(const char *path, Image *image, Error *error);

#endif
