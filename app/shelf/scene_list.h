/* The scenes of a folder for choosing: name, title and idea. */
#ifndef SLOSH_SCENE_LIST_H
#define SLOSH_SCENE_LIST_H

#include "app/scene/scene_files.h"
#include "sim/base/error.h"

typedef struct SceneRow {
    char name[64]; /* file name without .yaml */
    char path[SCENE_PATH_SIZE];
    char title[128]; /* key `title`; without title the name */
    char idea[256];  /* first sentence of the file's head comment; "": none */
} SceneRow;

typedef struct SceneList {
    int count;
    SceneRow *rows; /* owned; ordered by name */
} SceneList;

/* Lists the scenes of a folder; NULL: the scenes that come with slosh. Broken YAML files are listed too:
   opening the file shows the error. Returns false with the reason: no such folder, no memory, no scene. */
bool scene_list_read(const char *folder, SceneList *list, Error *error);
void scene_list_free(SceneList *list); /* a zeroed one is allowed */

/* Extracts the first sentence of the head comment of a scene's text; "" without comment. Pure function. */
void scene_idea(const char *text, size_t size, char idea[256]);

#endif
