#include "app/scene/keys.h"

#include "sim/base/scalar.h"

#include <stddef.h>
#include <string.h>

const KeyScalar key_scalars[KEY_SCALARS] = {{"view.color_by", "view.range"},
                                            {"view.opacity.by", "view.opacity.range"},
                                            {"view.size.by", "view.size.range"}};

void key_range_free(const KeyScalar *scalar, void *base)
{
    *((bool *)base + scene_key_find(scalar->range)->aux) = true;
}

const char *key_ranged(const char *scalar)
{
    return strcmp(scalar, "auto") == 0 ? scalar_name(SCALAR_SPEED) : scalar;
}

void key_range_follow(const KeyScalar *scalar, const void *before, void *base)
{
    const Key *key = scene_key_find(scalar->by);
    char was[NAME_SIZE], now[NAME_SIZE];
    key_value_text(key, before, was, sizeof was);
    key_value_text(key, base, now, sizeof now);
    if (strcmp(key_ranged(was), key_ranged(now)) != 0)
        key_range_free(scalar, base);
}

void key_help_text(const Key *key, char *text, size_t size)
{
    const char *owner = key->owner && key->owner->name ? key->owner->name : "";
    snprintf(text, size, "%s%s%s", owner, *owner ? ": " : "", key->help);
}

/* True if a path with indices ([0]) matches the path of a row, which has none ([]). */
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

static const KeyLike views = {"views", "view", offsetof(Scene, view)};

const KeyLike *key_like(const Key *list)
{
    return strcmp(list->path, views.list) == 0 ? &views : NULL;
}

const Key *key_list_like(const char *path)
{
    const size_t length = strlen(views.list);
    return strncmp(path, views.list, length) == 0 && path[length] == '[' ? scene_key_find(views.list) : NULL;
}

/* Finds the row for views[1].kind, which is view.kind. */
static const Key *find_like(const char *path)
{
    char own[128];
    const Key *list = key_list_like(path);
    const char *behind = list ? strchr(path, ']') : NULL;
    if (!behind || behind[1] != '.')
        return NULL;
    snprintf(own, sizeof own, "%s%s", key_like(list)->mapping, behind + 1);
    return scene_key_find(own);
}

const Key *scene_key_find(const char *path)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++)
        if (path_matches(keys[i].path, path))
            return &keys[i];
    return find_like(path);
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
    const KeyLike *like = key_like(list);
    return list->offset + (size_t)index * list->size - (like ? like->at : 0);
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
