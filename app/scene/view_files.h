/* Files of volume data named by a scene's views. */
#ifndef SLOSH_SCENE_VIEW_FILES_H
#define SLOSH_SCENE_VIEW_FILES_H

#include "app/base/notes.h"
#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Reads the files, found from the folder of tree->path, and passes them to the views. Returns false with
   "file:line: ..." if a file is unreadable; in a recorded run this gives a note, and the file's part is left
   out. */
bool scene_read_view_files(const Tree *tree, const SceneSettings *settings, Scene *scene, Notes *notes,
                           Error *error);

#endif
