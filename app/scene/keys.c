#include "app/scene/keys.h"

#include <string.h>

void key_help_text(const Key *key, char *text, size_t size)
{
    const char *owner = key->owner && key->owner->name ? key->owner->name : "";
    snprintf(text, size, "%s%s%s", owner, *owner ? ": " : "", key->help);
}

/* Whether a path with indices ([0]) is that of a row, which has none ([]). */
static bool path_matches(const char *row, const char *path)
{
    while (*row && *row == *path) {
        if (*path == '[')
            path += 1 + strspn(path + 1, "0123456789");
        else
            path++;
        row++;
    }
    return !*row && !*path;
}

const Key *scene_key_find(const char *path)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++)
        if (path_matches(keys[i].path, path))
            return &keys[i];
    return NULL;
}

const Key *key_list(const Key *key)
{
    char path[128];
    const char *brackets = strstr(key->path, "[].");
    if (!brackets || strstr(brackets + 1, "[]."))
        return NULL;
    snprintf(path, sizeof path, "%.*s", (int)(brackets - key->path), key->path);
    return scene_key_find(path);
}

int key_list_count(const Key *list, const Scene *scene)
{
    return *(const int *)(const void *)((const char *)scene + list->aux);
}

size_t key_list_at(const Key *list, int index)
{
    return list->offset + (size_t)index * list->size;
}

const char *key_name_in(const Key *key, const char *parent)
{
    const size_t length = strlen(parent);
    const char *name = key->path;
    if (length > 0) {
        if (strncmp(name, parent, length) != 0 || name[length] != '.')
            return NULL;
        name += length + 1;
    }
    return strpbrk(name, ".[") ? NULL : name;
}
