/* The scene embedded in a picture of slosh, in the text of the PNG file. */
#ifndef SLOSH_PICTURE_TEXT_H
#define SLOSH_PICTURE_TEXT_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Keywords of the chunks, all iTXt before the pixels: the scene's YAML, the name of the scene file, the time
   of the picture in s. */
#define PICTURE_SCENE "slosh scene"
#define PICTURE_NAME  "slosh name"
#define PICTURE_TIME  "slosh time"

enum { PICTURE_TEXT_MAX = 1 << 20, PICTURE_FILE_MAX = 256 << 20, PICTURE_NAME_SIZE = 128 };

typedef struct PictureText {
    char *scene;                  /* ended by a 0; the caller frees the text */
    size_t size;                  /* without the 0, at most PICTURE_TEXT_MAX */
    char name[PICTURE_NAME_SIZE]; /* "": none, or not plain ASCII */
    double time;                  /* NaN: not given */
} PictureText;

/* True if the path ends in ".png". */
bool picture_text_name(const char *path);

/* True if the bytes begin like a PNG file. */
bool picture_text_is_png(const char *bytes, size_t size);

/* Parses a file in memory up to its pixels, of which only lengths and sums are checked; pure. Returns false
   with "path: ...", and nothing to free, if the file is cut or damaged, has no scene or two, or a too long
   text. The text is not checked: check the scene like any scene file. */
bool picture_text_parse(const char *path, const char *bytes, size_t size, PictureText *out, Error *error);

/* Reads and parses a file. */
bool picture_text_read(const char *path, PictureText *out, Error *error);

#endif
