/* How a tree comes from YAML: a whole text, and the values of single settings. */
#ifndef SLOSH_SCENE_YAML_H
#define SLOSH_SCENE_YAML_H

#include "app/yaml/tree.h"

/* Reads a scene: one YAML document, a mapping. False with "path:line:column: ..."; tree_free is needed in
   either case. */
bool tree_read(Tree *tree, const char *path, const char *bytes, size_t size, Error *error);

/* Puts the value of "path=value" at its place, which is a path like `fluids[0].density`: mappings that are
   missing on the way are made, and an index one past the end of a list appends. `said` is
   what messages call it, such as "--backend cpu", and must outlive the tree; NULL: "--set path=value". False
   with "--set path=value: ...". */
bool tree_set(Tree *tree, const char *setting, const char *said, Error *error);

/* Reads one YAML document into nodes of the tree; `said` as in Node. *root is NULL where nothing stands in
   it. False with a message that names the place. */
bool yaml_read(Tree *tree, const char *said, const char *bytes, size_t size, Node **root, Error *error);

/* Whether the bytes are UTF-8 text without control characters and directives; yaml_read asks this first. */
bool yaml_text_check(const Tree *tree, const char *said, const char *bytes, size_t size, Error *error);

#endif
