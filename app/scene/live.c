#include "app/scene/live.h"

#include "app/base/suggest.h"
#include "app/scene/check.h"
#include "app/scene/keys.h"
#include "app/scene/value.h"
#include "app/yaml/yaml.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 256 };

/* A setting on its way into the scene. */
typedef struct Change {
    const char *setting;
    char path[PATH_SIZE];
    const Key *key;
    int fluid; /* index in the path */
    Error *error;
} Change;

/* The tree of a scene that says nothing but that it has its fluids, and the setting: what the checks read and
   messages point at. tree_free is needed in either case. */
static bool tree_make(Tree *tree, const Scene *scene, const char *setting, Error *error)
{
    char fluid[FLUIDS_MAX][32];
    if (!tree_read(tree, scene->path, "{}", 2, error))
        return false;
    for (int f = 0; f < scene->world.fluid_count; f++) {
        snprintf(fluid[f], sizeof fluid[f], "fluids[%d]=", f);
        if (!tree_set(tree, fluid[f], NULL, error))
            return false;
    }
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

static bool find_key(const Scene *scene, Change *change)
{
    change->key = scene_key_find(change->path);
    if (!change->key)
        return unknown_key(change);
    if (!(change->key->flags & KEY_LIVE))
        return error_set(change->error,
                         "--set %s: %s cannot change while the simulation runs; set it before the start",
                         change->setting, change->path);
    const char *index = strchr(change->path, '[');
    change->fluid = index ? (int)strtol(index + 1, NULL, 10) : 0;
    if (change->fluid >= scene->world.fluid_count)
        return error_set(change->error, "--set %s: the scene has no fluids[%d]; use at most fluids[%d]",
                         change->setting, change->fluid, scene->world.fluid_count - 1);
    if (strncmp(change->path, "view.camera.", strlen("view.camera.")) == 0 && scene->view.camera_auto)
        return error_set(change->error,
                         "--set %s: the camera is automatic; give the scene a view.camera with from and to",
                         change->setting);
    return true;
}

/* The fluids are the only list with keys that may change. */
static char *base_of(Scene *scene, const Change *change)
{
    const bool of_fluid = strncmp(change->key->path, "fluids[]", strlen("fluids[]")) == 0;
    return of_fluid ? (char *)&scene->world.fluids[change->fluid] : (char *)scene;
}

static bool in_world(const Scene *scene, const Change *change, const char *base)
{
    const uintptr_t world = (uintptr_t)&scene->world, field = (uintptr_t)base + change->key->offset;
    return field >= world && field < world + sizeof scene->world && !(change->key->flags & KEY_IDLE);
}

static bool take(Tree *tree, const Change *change, Scene *scene, bool *concerns_world)
{
    Scene after = *scene;
    tree->dimensions = scene->world.dimensions;
    char *base = base_of(&after, change);
    if (!value_read(tree, change->key, tree_near(tree, change->path), change->path, base, change->error) ||
        !scene_check(tree, &after, change->error))
        return false;
    if (after.view.color_by != scene->view.color_by)
        after.view.range_auto = true; /* a range is of one scalar */
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
