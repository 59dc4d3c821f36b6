/* The files of volume data that a scene's views name. */
#ifndef SLOSH_SCENE_VIEW_FILES_H
#define SLOSH_SCENE_VIEW_FILES_H

#include "app/base/notes.h"
#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Reads them, found from the folder of tree->path, and hands them to the views. False with "file:line: ..."
   where one cannot be read; of a recorded run that is a note, and what is of the file is left out. */
bool scene_read_view_files(const Tree *tree, const SceneSettings *settings, Scene *scene, Notes *notes,
                           Error *error);

#endif
