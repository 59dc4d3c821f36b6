/* Reads trees from YAML: a whole text, or values of single settings. */
#ifndef SLOSH_SCENE_YAML_H
#define SLOSH_SCENE_YAML_H

#include "app/yaml/tree.h"

/* Reads a scene: one YAML document, a mapping. Returns false with "path:line:column: ..."; call tree_free
   in either case. */
bool tree_read(Tree *tree, const char *path, const char *bytes, size_t size, Error *error);

/* Sets "path=value", with a path like `fluids[0].density`. Missing mappings on the path are created, and
   an index one past the end of a list appends. `said` names the setting in messages, such as "--backend
   cpu", and must outlive the tree; NULL: "--set path=value". Returns false with "--set path=value: ...". */
bool tree_set(Tree *tree, const char *setting, const char *said, Error *error);

/* Reads one YAML document into nodes of the tree; `said` as in Node. *root is NULL for an empty document.
   Returns false with a message naming the place. */
bool yaml_read(Tree *tree, const char *said, const char *bytes, size_t size, Node **root, Error *error);

/* Returns true if the bytes are UTF-8 text without control characters and directives; called first by
   yaml_read. */
bool yaml_text_check(const Tree *tree, const char *said, const char *bytes, size_t size, Error *error);

#endif
