#include "app/scene/live.h"

#include "app/base/suggest.h"
#include "app/scene/check.h"
#include "app/scene/keys.h"
#include "app/yaml/value.h"
#include "app/yaml/yaml.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 256 };

/* A setting to apply to the scene. */
typedef struct Change {
    const char *setting;
    char path[PATH_SIZE];
    const Key *key;
    const Key *list; /* list with the key in its elements; NULL: none */
    int element;     /* index in the path */
    Error *error;
} Change;

/* True if keys of the list's elements may change. */
static bool list_is_live(const Key *list)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++)
        if (key_like(list) || (keys[i].flags & KEY_LIVE && key_list(&keys[i]) == list))
            return true;
    return false;
}

/* Adds the list's elements, empty, to the tree. */
static bool tree_add_list(Tree *tree, const Scene *scene, const Key *list, Error *error)
{
    for (int e = 0; e < key_list_count(list, scene); e++) {
        char *setting = tree_alloc(tree, PATH_SIZE); /* owned by the tree */
        if (!setting)
            return error_set(error, "no memory");
        snprintf(setting, PATH_SIZE, "%s[%d]=", list->path, e);
        if (!tree_set(tree, setting, NULL, error))
            return false;
    }
    return true;
}

/* Makes the tree for checks and messages: an empty scene, with elements in lists with live keys, and the
   setting. Call tree_free in any case. */
static bool tree_make(Tree *tree, const Scene *scene, const char *setting, Error *error)
{
    int count;
    const Key *keys = scene_keys(&count);
    if (!tree_read(tree, scene->path, "{}", 2, error))
        return false;
    for (int i = 0; i < count; i++)
        if (keys[i].type == KEY_LIST && list_is_live(&keys[i]) &&
            !tree_add_list(tree, scene, &keys[i], error))
            return false;
    return tree_set(tree, setting, NULL, error);
}

static bool unknown_key(const Change *change)
{
    int count;
    const Key *keys = scene_keys(&count);
    Suggestion near = suggest_for(change->path);
    for (int i = 0; i < count; i++)
        if (keys[i].flags & KEY_LIVE)
            suggest_offer(&near, keys[i].path);
    if (near.best)
        return error_set(change->error, "--set %s: unknown key '%.60s'; did you mean '%s'?", change->setting,
                         change->path, near.best);
    return error_set(change->error,
                     "--set %s: unknown key '%.60s'; `slosh info SCENE` lists the keys of a scene",
                     change->setting, change->path);
}

static bool find_element(const Scene *scene, Change *change)
{
    const char *index = strchr(change->path, '[');
    change->list = index ? key_list_like(change->path) : NULL;
    if (!change->list)
        change->list = key_list(change->key);
    change->element = index ? (int)strtol(index + 1, NULL, 10) : 0;
    const int count = change->list ? key_list_count(change->list, scene) : 0;
    if (!change->list || change->element < count)
        return true;
    const char *list = change->list->path;
    return error_set(change->error, "--set %s: the scene has no %s[%d]; use at most %s[%d]", change->setting,
                     list, change->element, list, count - 1);
}

/* The view with the changed key. */
static const ViewDef *view_of(const Scene *scene, const Change *change)
{
    return change->list ? &scene->views[change->element] : &scene->view;
}

static bool find_key(const Scene *scene, Change *change)
{
    change->key = scene_key_find(change->path);
    if (!change->key)
        return unknown_key(change);
    if (!(change->key->flags & KEY_LIVE))
        return error_set(change->error,
                         "--set %s: %s cannot change while the simulation runs; set it before the start",
                         change->setting, change->path);
    if (!find_element(scene, change))
        return false;
    if (strncmp(change->key->path, "view.camera.", strlen("view.camera.")) == 0 &&
        view_of(scene, change)->camera_auto)
        return error_set(change->error,
                         "--set %s: the camera is automatic; give the scene a view.camera with from and to",
                         change->setting);
    return true;
}

static void *base_of(Scene *scene, const Change *change)
{
    return (char *)scene + (change->list ? key_list_at(change->list, change->element) : 0);
}

static bool in_world(const Scene *scene, const Change *change, const void *base)
{
    const uintptr_t world = (uintptr_t)&scene->world, field = (uintptr_t)base + change->key->offset;
    return field >= world && field < world + sizeof scene->world && !(change->key->flags & KEY_IDLE);
}

/* Makes ranges automatic whose scalar changed. */
static void ranges_follow(const Scene *before, Scene *after)
{
    const Key *views = scene_key_find("views");
    for (int k = 0; k < KEY_SCALARS; k++) {
        key_range_follow(&key_scalars[k], before, after);
        for (int i = 0; i < after->view_count; i++) {
            const size_t at = key_list_at(views, i);
            key_range_follow(&key_scalars[k], (const char *)before + at, (char *)after + at);
        }
    }
}

/* Accepts an error that the scene had before the change: by hand the box may have become smaller than the
   initial fluid. */
static bool check(const Tree *tree, const Scene *before, const Scene *after, Error *error)
{
    Error was;
    return scene_check(tree, after, error) ||
           (!scene_check(tree, before, &was) && strcmp(was.message, error->message) == 0);
}

static bool take(Tree *tree, const Change *change, Scene *scene, bool *concerns_world)
{
    Scene after = *scene;
    tree->dimensions = scene->world.dimensions;
    void *base = base_of(&after, change);
    if (!value_read(tree, change->key, tree_near(tree, change->path), change->path, base, change->error) ||
        !check(tree, scene, &after, change->error))
        return false;
    ranges_follow(scene, &after);
    after.world.acceleration |= scene->world.acceleration; /* accelerations stay on once kept */
    if (concerns_world)
        *concerns_world = in_world(&after, change, base);
    *scene = after;
    return true;
}

bool scene_set_live(Scene *scene, const char *setting, bool *concerns_world, Error *error)
{
    Tree tree;
    Change change = {.setting = setting, .error = error};
    bool ok = tree_make(&tree, scene, setting, error);
    if (ok) {
        snprintf(change.path, sizeof change.path, "%.*s", (int)strcspn(setting, "="), setting);
        ok = find_key(scene, &change) && take(&tree, &change, scene, concerns_world);
    }
    tree_free(&tree);
    return ok;
}
