/* Reads a single value from YAML: from its node to the field of its key. */
#ifndef SLOSH_VALUE_H
#define SLOSH_VALUE_H

#include "app/yaml/tree.h"
#include "sim/base/key.h"

/* Reads a number, curve, integer, boolean, text, choice, vector, colour, range or control points into
   `base` + the key's offset; `shown` is the key's path for messages. Returns false with "place: shown must
   be ...". */
bool value_read(const Tree *tree, const Key *key, const Node *node, const char *shown, char *base,
                Error *error);

#endif
