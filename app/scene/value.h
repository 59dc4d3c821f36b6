/* One value of a scene: from its node to the field of its row. */
#ifndef SLOSH_SCENE_VALUE_H
#define SLOSH_SCENE_VALUE_H

#include "app/scene/keys.h"
#include "app/yaml/tree.h"

/* Reads a number, curve, integer, boolean, text, choice, vector, colour, range or control points into `base`
   + the key's offset; `shown` is the key's path for people. False with "place: shown must be ...". */
bool value_read(const Tree *tree, const Key *key, const Node *node, const char *shown, char *base,
                Error *error);

#endif
