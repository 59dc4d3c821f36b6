/* From the tree of a scene file to the Scene, row by row of the table of keys. */
#ifndef SLOSH_SCENE_READ_H
#define SLOSH_SCENE_READ_H

#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Fills `scene` with defaults and with what the tree says: every key known, every value of its type and in
   its range. Where one key must fit another is scene_check's business. */
bool scene_read(const Tree *tree, Scene *scene, Error *error);

#endif
