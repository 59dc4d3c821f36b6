/* Finds and reads scene files. */
#ifndef SLOSH_SCENE_PATH_H
#define SLOSH_SCENE_PATH_H

#include "sim/base/error.h"

#include <dirent.h>
#include <stddef.h>

enum { SCENE_PATH_SIZE = 1024, SCENE_NAMES_MAX = 64, SCENE_BYTES_MAX = 1 << 20 };

/* The scenes of slosh: names without .yaml, in alphabetical order. */
typedef struct SceneNames {
    int count;
    char name[SCENE_NAMES_MAX][48];
} SceneNames;

void scene_path_names(SceneNames *names);

/* For scandir: true if the entry's name is a scene file's. */
int scene_path_is_yaml(const struct dirent *entry);

/* The file of `name`: a path, otherwise a path or a bare name (with or without .yaml) in slosh's own folder.
   Then the user's folder (app/base/place.h), then a bare name in the present folder. Folders come last, as
   outputs have the names of scenes too. If there is no file, returns false with the searched places and the
   nearest scene name. */
bool scene_path_find(const char *name, char path[SCENE_PATH_SIZE], Error *error);

/* The file's bytes, or the scene embedded in a picture; the caller frees the bytes. NULL: a folder,
   unreadable, larger than SCENE_BYTES_MAX, or a file for a different command. */
char *scene_file_read(const char *path, size_t *size, Error *error);

#endif
