/* Where scene files lie, and their bytes. */
#ifndef SLOSH_SCENE_PATH_H
#define SLOSH_SCENE_PATH_H

#include "sim/error.h"

#include <stddef.h>

enum { SCENE_PATH_SIZE = 1024 };

/* The file that `name` means: a path, else a path or a bare name (with or without .yaml) beside the sources
   that the program was built from. False, saying where was looked, when there is none. */
bool scene_path_find(const char *name, char path[SCENE_PATH_SIZE], Error *error);

/* The file's bytes (the caller frees them), or NULL: a directory, unreadable, larger than SCENE_BYTES_MAX. */
char *scene_file_read(const char *path, size_t *size, Error *error);

#endif
