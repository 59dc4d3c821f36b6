/* The scene that a picture of slosh carries in the text of its PNG file. */
#ifndef SLOSH_PICTURE_TEXT_H
#define SLOSH_PICTURE_TEXT_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Keywords of its chunks, all iTXt before the picture itself: the scene's YAML, the name of its file, the
   time that the picture is of in s. */
#define PICTURE_SCENE "slosh scene"
#define PICTURE_NAME  "slosh name"
#define PICTURE_TIME  "slosh time"

enum { PICTURE_TEXT_MAX = 1 << 20, PICTURE_FILE_MAX = 256 << 20, PICTURE_NAME_SIZE = 128 };

typedef struct PictureText {
    char *scene;                  /* ended by a 0, which the caller frees */
    size_t size;                  /* without that, at most PICTURE_TEXT_MAX */
    char name[PICTURE_NAME_SIZE]; /* "": none, or not of plain letters */
    double time;                  /* NaN: it does not say */
} PictureText;

/* Whether the path ends in ".png". */
bool picture_text_name(const char *path);

/* Whether the bytes begin as a PNG file. */
bool picture_text_is_png(const char *bytes, size_t size);

/* Reads a file in memory up to its pixels, which are not looked at; pure. False, and nothing to free, with
   "path: ...": it is cut or damaged, it carries no scene, its text is too long. What the text says is not
   judged: it is a scene as any other file's. */
bool picture_text_parse(const char *path, const char *bytes, size_t size, PictureText *out, Error *error);

/* The same of a file. */
bool picture_text_read(const char *path, PictureText *out, Error *error);

#endif
