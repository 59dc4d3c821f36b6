/* Settings put into the text of a scene, so that comments and layout stay. */
#ifndef SLOSH_YAML_PATCH_H
#define SLOSH_YAML_PATCH_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* The text with "path=value" in it, ended by a 0, which the caller frees; it is read as what tree_set makes
   of the one given. NULL with the reason: that is no scene, or such a setting has no place in it. A value is
   replaced where it stands, a new key comes into its mapping. Where that cannot be done the block of the
   first key of the path is written anew, and its comments are gone: then *lost (may be NULL) becomes true. */
char *yaml_patch(const char *path, const char *text, size_t size, const char *setting, bool *lost,
                 Error *error);

#endif
