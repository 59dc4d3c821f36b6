/* Thumbnails: small pictures of scenes, for lists. */
#ifndef SLOSH_THUMBNAIL_H
#define SLOSH_THUMBNAIL_H

#include "app/files/pictures.h"
#include "app/run/offscreen.h"
#include "sim/base/error.h"

#include <stdbool.h>

enum { THUMBNAIL_WIDTH = 256, THUMBNAIL_HEIGHT = 144 };

/* Simulates the scene briefly with few particles, and draws its own view in the current context. The
   caller owns the image. Returns false with the reason: the scene is wrong, or cannot run here. */
bool thumbnail_make(const char *path, Headless *context, Image *image, Error *error);

/* Makes the path of scene `name` in a folder of thumbnails; returns false if too long. */
bool thumbnail_path(const char *folder, const char *name, char path[1024]);

/* True if the thumbnail exists and is newer than the scene and the program. */
bool thumbnail_is_new(const char *thumbnail, const char *scene);

#endif
