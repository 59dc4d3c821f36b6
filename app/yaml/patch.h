/* Writes settings into the text of a scene, keeping comments and layout. */
#ifndef SLOSH_YAML_PATCH_H
#define SLOSH_YAML_PATCH_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Returns the text with "path=value" written in, ended by a 0; the caller frees the text. Reading the
   result gives the same tree as tree_set on the given text. Returns NULL with the reason if the text is no
   scene or the setting has no place. An existing value is replaced in place, a new key is added to its
   mapping. If impossible, the block of the path's first key is rewritten without its comments: then *lost
   (may be NULL) becomes true. */
char *yaml_patch(const char *path, const char *text, size_t size, const char *setting, bool *lost,
                 Error *error);

#endif
