/* Where scene files lie, and their bytes. */
#ifndef SLOSH_SCENE_PATH_H
#define SLOSH_SCENE_PATH_H

#include "sim/base/error.h"

#include <dirent.h>
#include <stddef.h>

enum { SCENE_PATH_SIZE = 1024, SCENE_NAMES_MAX = 64, SCENE_BYTES_MAX = 1 << 20 };

/* The scenes that come with slosh: names without .yaml, in alphabetical order. */
typedef struct SceneNames {
    int count;
    char name[SCENE_NAMES_MAX][48];
} SceneNames;

void scene_path_names(SceneNames *names);

/* For scandir: whether the entry is named like a scene file. */
int scene_path_is_yaml(const struct dirent *entry);

/* The file that `name` means: a path, else a path or a bare name (with or without .yaml) among what comes
   with slosh, then in the user's own folder (app/base/place.h), then a bare name here. A folder is meant only
   where there is nothing else: outputs have the names of scenes too. False, saying where was looked and which
   scene may be meant, when there is none. */
bool scene_path_find(const char *name, char path[SCENE_PATH_SIZE], Error *error);

/* The file's bytes, or of a picture those of the scene that it carries (the caller frees them), or NULL: a
   directory, unreadable, larger than SCENE_BYTES_MAX, or a file of slosh that another command takes. */
char *scene_file_read(const char *path, size_t *size, Error *error);

#endif
