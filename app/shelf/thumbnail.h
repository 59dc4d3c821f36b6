/* Small pictures of scenes, that lists of them show. */
#ifndef SLOSH_THUMBNAIL_H
#define SLOSH_THUMBNAIL_H

#include "app/output/image.h"
#include "app/session/headless.h"
#include "sim/base/error.h"

#include <stdbool.h>

enum { THUMBNAIL_WIDTH = 256, THUMBNAIL_HEIGHT = 144 };

/* Simulates the scene with few particles for a moment, and draws it by its own view, in the context that is
   current. The image is owned by the caller. False with the reason: the scene is wrong, or it cannot run
   here. */
bool thumbnail_make(const char *path, Headless *context, Image *image, Error *error);

/* The file of the scene `name` in a folder of thumbnails; false where that is too long. */
bool thumbnail_path(const char *folder, const char *name, char path[1024]);

/* Whether that file is there and is younger than the scene and the program that makes it. */
bool thumbnail_is_new(const char *thumbnail, const char *scene);

#endif
