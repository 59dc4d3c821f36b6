/* Tests if the owner of a key is in use in a scene. */
#include "app/scene/keys.h"

#include <string.h>

static bool stands_in(const char *key, const char *list)
{
    const size_t length = strlen(list);
    return strncmp(key, list, length) == 0 && strncmp(key + length, "[].", strlen("[].")) == 0;
}

/* Total count of elements of the row's lists, over all elements of the outer list. */
static int elements_of(const Scene *scene, const Key *list)
{
    int count, elements = 0;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        if (keys[i].type != KEY_LIST || !stands_in(list->path, keys[i].path))
            continue;
        const char *outer = (const char *)scene;
        for (int e = 0; e < *(const int *)(const void *)(outer + keys[i].aux); e++)
            elements +=
                *(const int *)(const void *)(outer + keys[i].offset + (size_t)e * keys[i].size + list->aux);
    }
    return elements;
}

static bool is_of_value(const Scene *scene, const Key *key, const char *value)
{
    char now[NAME_SIZE];
    if (key->type == KEY_LIST)
        return elements_of(scene, key) > 0;
    key_value_text(key, scene, now, sizeof now);
    return value ? strcmp(now, value) == 0 : strcmp(now, "none") != 0;
}

bool key_owner_used(const KeyOwner *owner, const Scene *scene, bool said)
{
    if (owner->command)
        return scene->purpose == SCENE_FOR_CHART || !said;
    const Key *key = scene_key_find(owner->key);
    if (key->flags & KEY_LIVE && scene->purpose == SCENE_FOR_WINDOW)
        return true;
    return (key->flags & KEY_IDLE && !said) || is_of_value(scene, key, owner->value);
}

void key_owner_need(const KeyOwner *owner, char *text, size_t size)
{
    if (owner->need)
        snprintf(text, size, "%s", owner->need);
    else
        snprintf(text, size, "%s: %s", owner->key, owner->value);
}
