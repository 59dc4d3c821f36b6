/* Inside the scene tree: what its files share. */
#ifndef SLOSH_SCENE_YAML_H
#define SLOSH_SCENE_YAML_H

#include "app/yaml/tree.h"

typedef struct TreeBlock TreeBlock;

/* Zeroed memory that lives as long as the tree; NULL when there is none left. */
void *tree_alloc(Tree *tree, size_t size);

/* Reads one YAML document into nodes of the tree; `said` as in Node. *root is NULL where nothing stands in
   it. False with a message that names the place. */
bool yaml_read(Tree *tree, const char *said, const char *bytes, size_t size, Node **root, Error *error);

/* Whether the bytes are UTF-8 text without control characters and directives; yaml_read asks this first. */
bool yaml_text_check(const Tree *tree, const char *said, const char *bytes, size_t size, Error *error);

typedef struct PathPart {
    long index; /* of a list, from 0; -1: a key */
    char key[64];
} PathPart;

/* Takes the next part off a path like `fluids[0].density`; false when it is none. */
bool path_next(const char **path, PathPart *part);

#endif
