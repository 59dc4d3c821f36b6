/* The scenes of a folder as people choose from them: name, title, and what each shows. */
#ifndef SLOSH_SCENE_LIST_H
#define SLOSH_SCENE_LIST_H

#include "app/base/path.h"
#include "sim/base/error.h"

typedef struct SceneRow {
    char name[64]; /* of the file, without .yaml */
    char path[SCENE_PATH_SIZE];
    char title[128]; /* its key `title`; of a file without one the name */
    char idea[256];  /* first sentence of the comment that the file begins with; "": none */
} SceneRow;

typedef struct SceneList {
    int count;
    SceneRow *rows; /* owned; in the order of their names */
} SceneList;

/* `folder` NULL: the scenes that come with slosh. A file that is no YAML is in the list too: opening it says
   why. False with the reason: no such folder, no memory, no scene in it. */
bool scene_list_read(const char *folder, SceneList *list, Error *error);
void scene_list_free(SceneList *list); /* a zeroed one is allowed */

/* The first sentence of the comment at the start of a scene's text; "" without one. Pure. */
void scene_idea(const char *text, size_t size, char idea[256]);

#endif
