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

/* The scene embedded in a picture's file as text: PICTURE_SCENE and further keywords
   (app/base/picture_text.h). */
typedef struct ImageText {
    const char *scene; /* YAML of the scene */
    const char *name;  /* name of the scene file, without folders */
    double time;       /* time of the picture, s */
} ImageText;

/* Returns false if memory is short. */
bool image_create(Image *image, int width, int height);
void image_destroy(Image *image);

/* Writes into an open stream and flushes the stream, which stays open. Returns false with the reason on any
   failure, such as a full disk. `name` is for messages. `text`: NULL for none. */
bool image_write_stream(const Image *image, const ImageText *text, FILE *stream, const char *name,
                        Error *error);

/* Writes the file `path`; leaves no file on failure. Use a temporary name and rename for files that must
   appear complete. */
bool image_write(const Image *image, const ImageText *text, const char *path, Error *error);

/* Reads a PNG file with any kind of pixels; returns false with the reason, and nothing to destroy. */
bool image_read(const char *path, Image *image, Error *error);

#endif
