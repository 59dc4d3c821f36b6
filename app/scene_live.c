#include "app/scene_live.h"

#include "app/scene_keys.h"
#include "app/scene_value.h"
#include "app/scene_yaml.h"

#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 64 };

static bool fail(const char *setting, const char *what, Error *error)
{
    return error_set(error, "--set %.80s: %s", setting, what);
}

/* Splits "path=value"; the value, or NULL. */
static const char *split(const char *setting, char path[PATH_SIZE])
{
    const char *equals = strchr(setting, '=');
    if (!equals || equals == setting || equals - setting >= PATH_SIZE)
        return NULL;
    memcpy(path, setting, (size_t)(equals - setting));
    path[equals - setting] = 0;
    return equals + 1;
}

/* Where the offsets of a path's row count from: the scene, or the fluid that it names; NULL when there is no
 * such. */
static char *base_of(Scene *scene, const char *path)
{
    static const char list[] = "fluids[";
    if (!strchr(path, '['))
        return (char *)scene;
    if (strncmp(path, list, sizeof list - 1) != 0)
        return NULL;
    const long fluid = strtol(path + sizeof list - 1, NULL, 10);
    return fluid >= 0 && fluid < scene->world.fluid_count ? (char *)&scene->world.fluids[fluid] : NULL;
}

static bool starts_with(const char *text, const char *start)
{
    return strncmp(text, start, strlen(start)) == 0;
}

/* What the loader derives from the values. */
static void follow(Scene *scene, const char *path)
{
    if (starts_with(path, "view.camera."))
        scene->view.camera_auto = false;
    for (int f = 0; f < scene->world.fluid_count; f++)
        memcpy(scene->view.fluid_color[f], scene->world.fluids[f].color, sizeof scene->view.fluid_color[f]);
}

static bool read_into(Scene *scene, const char *setting, const char *path, const char *value, Error *error)
{
    const Key *key = scene_key_find(path);
    if (!key)
        return fail(setting, "no such key; `slosh info SCENE` lists them", error);
    if (!(key->flags & KEY_LIVE))
        return fail(setting,
                    "cannot change while the simulation runs; change it in the file, or at the start", error);
    char *base = base_of(scene, path);
    if (!base)
        return fail(setting, "there is no such fluid; they count from 0", error);
    Tree tree = {.path = scene->path};
    Node *node = NULL;
    const bool ok = yaml_read(&tree, setting, value, strlen(value), &node, error) &&
                    value_read(&tree, key, node, path, base, error);
    tree_free(&tree);
    return ok;
}

bool scene_set_live(Scene *scene, const char *setting, bool *concerns_world, Error *error)
{
    char path[PATH_SIZE];
    Scene changed = *scene;
    const char *value = split(setting, path);
    if (!value || !value[strspn(value, " \t")])
        return fail(setting, "no setting; write path=value, such as gravity=[0, -3, 0]", error);
    if (!read_into(&changed, setting, path, value, error))
        return false;
    follow(&changed, path);
    *scene = changed;
    if (concerns_world)
        *concerns_world = !starts_with(path, "view.") && strcmp(path, "title") != 0 &&
                          !strstr(path, "].color") && strcmp(path, "solver.step.realtime") != 0;
    return true;
}
