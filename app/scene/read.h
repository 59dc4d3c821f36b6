/* Reads the tree of a scene file into a Scene, row by row of the table of keys. */
#ifndef SLOSH_SCENE_READ_H
#define SLOSH_SCENE_READ_H

#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Fills `scene` with defaults and the values of the tree; checks that each key is known, and each value has
   its type and range. Cross checks of keys are in scene_check. */
bool scene_read(const Tree *tree, Scene *scene, Error *error);

#endif
