/* Where a path leads. */
#ifndef SLOSH_FILE_PLACE_H
#define SLOSH_FILE_PLACE_H

#include <limits.h>
#include <stdbool.h>

/* The absolute path of the file itself, behind all links; of a file that is not there yet, the path that it
   would get. False with errno: links in a circle, a folder that may not be looked into, a path too long. */
bool file_place(const char *path, char place[PATH_MAX]);

#endif
