/* Resolves paths. */
#ifndef SLOSH_FILE_PLACE_H
#define SLOSH_FILE_PLACE_H

#include <limits.h>
#include <stdbool.h>

/* The absolute path of the file after all links; of a missing file, its future path. Returns false with
   errno: links in a circle, an unreadable folder, a too long path. */
bool file_place(const char *path, char place[PATH_MAX]);

#endif
