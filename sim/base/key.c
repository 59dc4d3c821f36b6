#include "sim/base/key.h"

const char *key_choice(const Key *key, int index)
{
    if (!key->names)
        return key->choice ? key->choice(index) : NULL;
    const char *const *name = key->names;
    for (int i = 0; i < index && *name; i++)
        name = (const char *const *)(const void *)((const char *)name + key->stride);
    return *name;
}
