#include "sim/base/key.h"

#include <stdio.h>
#include <string.h>

void key_bounds_text(const Key *key, char *text, size_t size)
{
    *text = 0;
    if (key->min == key->max)
        return;
    if (key->flags & KEY_OPEN_LOW)
        snprintf(text, size, "more than %g, at most %g", key->min, key->max);
    else
        snprintf(text, size, "%g to %g", key->min, key->max);
}

void key_range_text(const Key *key, char *text, size_t size)
{
    size_t used = 0;
    const char *name;
    *text = 0;
    for (int i = 0; (name = key_choice(key, i)) && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", name);
    if (key->type == KEY_POINTS && used < size)
        snprintf(text + used, size - used, ", or points of %g to %g", key->min, key->max);
    else if (key->type == KEY_BOOLEAN)
        snprintf(text, size, "true, false");
    else if (used == 0)
        key_bounds_text(key, text, size);
    used = strlen(text);
    if (key->zero)
        snprintf(text + used, size - used, " or %s", key->zero);
}

const char *key_choice(const Key *key, int index)
{
    if (!key->names)
        return key->choice ? key->choice(index) : NULL;
    const char *const *name = key->names;
    for (int i = 0; i < index && *name; i++)
        name = (const char *const *)(const void *)((const char *)name + key->stride);
    return *name;
}
