/* Changes of a scene during the simulation: a setting as text, or as a value. */
#include "app/scene/scene.h"

#include "app/base/program.h"
#include "app/scene/scene_private.h"
#include "app/scene/yaml/yaml.h"
#include "render/frame/view.h"
#include "sim/base/base.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 256 };

/* A setting to apply to the scene. */
typedef struct LiveChange {
    const char *setting;
    char path[PATH_SIZE];
    const Key *key;
    const Key *list; /* list with the key in its elements; NULL: none */
    int element;     /* index in the path */
    Error *error;
} LiveChange;

/* True if keys of the list's elements may change. */
static bool list_is_live(const Key *list)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++)
        if (key_list_mapping(list) || (keys[i].flags & KEY_LIVE && key_list(&keys[i]) == list))
            return true;
    return false;
}

/* Adds the list's elements, empty, to the tree. */
static bool tree_add_list(YamlTree *tree, const Scene *scene, const Key *list, Error *error)
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
static bool tree_make(YamlTree *tree, const Scene *scene, const char *setting, Error *error)
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

static bool unknown_live_key(const LiveChange *change)
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

static bool find_element(const Scene *scene, LiveChange *change)
{
    const char *index = strchr(change->path, '[');
    change->list = index ? key_list_of_mapping(change->path) : NULL;
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
static const ViewDef *view_of(const Scene *scene, const LiveChange *change)
{
    return change->list ? &scene->views[change->element] : &scene->view;
}

static bool find_key(const Scene *scene, LiveChange *change)
{
    change->key = scene_key_find(change->path);
    if (!change->key)
        return unknown_live_key(change);
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

static void *base_of(Scene *scene, const LiveChange *change)
{
    return (char *)scene + (change->list ? key_list_at(change->list, change->element) : 0);
}

static bool in_world(const Scene *scene, const LiveChange *change, const void *base)
{
    const uintptr_t world = (uintptr_t)&scene->world, field = (uintptr_t)base + change->key->offset;
    return field >= world && field < world + sizeof scene->world && !(change->key->flags & KEY_IDLE);
}

/* Makes ranges automatic whose scalar changed. */
static void ranges_find_async(const Scene *before, Scene *after)
{
    const Key *views = scene_key_find("views");
    for (int k = 0; k < KEY_SCALARS; k++) {
        key_range_update(&key_scalars[k], before, after);
        for (int i = 0; i < after->view_count; i++) {
            const size_t at = key_list_at(views, i);
            key_range_update(&key_scalars[k], (const char *)before + at, (char *)after + at);
        }
    }
}

/* Accepts an error of the scene before the change: by hand the box may have become smaller than the
   initial fluid. */
static bool check(const YamlTree *tree, const Scene *before, const Scene *after, Error *error)
{
    Error was;
    return scene_check(tree, after, error) ||
           (!scene_check(tree, before, &was) && strcmp(was.message, error->message) == 0);
}

static bool take(YamlTree *tree, const LiveChange *change, Scene *scene, bool *concerns_world)
{
    Scene after = *scene;
    tree->dimensions = scene->world.dimensions;
    void *base = base_of(&after, change);
    if (!value_read(tree, change->key, tree_nearest(tree, change->path), change->path, base, change->error) ||
        !check(tree, scene, &after, change->error))
        return false;
    ranges_find_async(scene, &after);
    after.world.acceleration |= scene->world.acceleration; /* accelerations stay on once kept */
    if (concerns_world)
        *concerns_world = in_world(&after, change, base);
    *scene = after;
    return true;
}

bool scene_set_live(Scene *scene, const char *setting, bool *concerns_world, Error *error)
{
    YamlTree tree;
    LiveChange change = {.setting = setting, .error = error};
    bool ok = tree_make(&tree, scene, setting, error);
    if (ok) {
        snprintf(change.path, sizeof change.path, "%.*s", (int)strcspn(setting, "="), setting);
        ok = find_key(scene, &change) && take(&tree, &change, scene, concerns_world);
    }
    tree_free(&tree);
    return ok;
}

/* ---- a setting as a value ---- */

/* The key with its field at the begin of a value. */
static Key own_key(const Key *key)
{
    Key own = *key;
    own.offset = 0;
    own.type = key->type == KEY_CURVE ? KEY_NUMBER : key->type;
    own.aux = offsetof(SettingValue, range.automatic) - offsetof(SettingValue, bytes);
    return own;
}

void setting_value_path(const SettingValue *value, char path[SETTING_TEXT_SIZE])
{
    const char *list = strstr(value->key->path, "[]");
    if (list)
        snprintf(path, SETTING_TEXT_SIZE, "%.*s[%d]%s", (int)(list - value->key->path), value->key->path,
                 value->element, list + strlen("[]"));
    else
        snprintf(path, SETTING_TEXT_SIZE, "%s", value->key->path);
}

void setting_value_text(const SettingValue *value, char text[SETTING_TEXT_SIZE])
{
    const Key own = own_key(value->key);
    setting_value_path(value, text);
    const size_t used = strlen(text);
    snprintf(text + used, SETTING_TEXT_SIZE - used, "=");
    key_exact_text(&own, value->bytes, 3, text + used + 1, SETTING_TEXT_SIZE - used - 1);
}

/* Bytes of the key's field; 0: a type without a widget. */
static size_t field_size(const Key *key)
{
    switch (key->type) {
    case KEY_NUMBER:
    case KEY_CURVE:
        return sizeof(double);
    case KEY_INTEGER:
        return sizeof(int);
    case KEY_BOOLEAN:
        return sizeof(bool);
    case KEY_CHOICE:
        return key->flags & KEY_INDEX ? sizeof(int) : NAME_SIZE;
    case KEY_VEC3:
        return sizeof(double[3]);
    case KEY_COLOR:
        return key->flags & KEY_SINGLE ? sizeof(float[3]) : sizeof(double[3]);
    case KEY_RANGE:
        return sizeof(double[2]);
    case KEY_POINTS:
        return sizeof(ControlPoints);
    default:
        return 0;
    }
}

static bool are_in_range(const Key *key, const double *numbers, int count)
{
    bool in = true;
    for (int k = 0; k < count; k++)
        in = in && isfinite(numbers[k]) && value_in_range(key, numbers[k]);
    return in;
}

static bool is_choice(const SettingValue *value)
{
    const char *name;
    for (int i = 0; (name = key_choice(value->key, i)); i++)
        if (value->key->flags & KEY_INDEX ? value->whole == i : strcmp(value->name, name) == 0)
            return true;
    return false;
}

static bool is_color(const SettingValue *value)
{
    bool in = true;
    for (int k = 0; k < 3; k++) {
        const double linear = value->key->flags & KEY_SINGLE ? (double)value->single[k] : value->number[k];
        in = in && linear >= 0 && linear <= 1;
    }
    return in;
}

static bool are_points(const SettingValue *value)
{
    const ControlPoints *points = &value->points;
    bool in = points->count >= 1 && points->count <= CONTROL_POINTS_MAX;
    for (int k = 0; in && k < points->count; k++)
        in = points->x[k] >= 0 && points->x[k] <= 1 && (k == 0 || points->x[k] > points->x[k - 1]);
    return in && are_in_range(value->key, points->y, points->count);
}

/* True if the value alone is surely valid. */
static bool is_valid(const SettingValue *value)
{
    switch (value->key->type) {
    case KEY_NUMBER:
    case KEY_CURVE:
        return are_in_range(value->key, value->number, 1);
    case KEY_INTEGER:
        return value_in_range(value->key, value->whole);
    case KEY_BOOLEAN:
        return true;
    case KEY_CHOICE:
        return value->key->offset != KEY_NOWHERE && is_choice(value);
    case KEY_VEC3:
        return are_in_range(value->key, value->number, 3);
    case KEY_COLOR:
        return is_color(value);
    case KEY_RANGE:
        return value->range.automatic[0] ||
               (!value->range.automatic[1] && are_in_range(value->key, value->range.ends, 2));
    case KEY_POINTS:
        return are_points(value);
    default:
        return false;
    }
}

/* The automatic range of the key's scalar; NULL: none. */
static bool *range_of(const Key *key, char *base)
{
    for (int k = 0; k < KEY_SCALARS; k++)
        if (strcmp(key_scalars[k].by, key->path) == 0)
            return (bool *)base + scene_key_find(key_scalars[k].range)->aux;
    return NULL;
}

static void save(const Key *key, char *base, SettingBefore *before)
{
    const bool *range = range_of(key, base);
    memcpy(before->field, base + key->offset, field_size(key));
    if (key->type == KEY_CURVE)
        before->table = *(const TimeTable *)(const void *)(base + key->aux);
    if (key->type == KEY_RANGE)
        memcpy(before->automatic, base + key->aux, sizeof before->automatic);
    else if (range)
        before->automatic[0] = *range;
}

/* The points with zeros after the last point. */
static ControlPoints points_alone(const ControlPoints *points)
{
    ControlPoints alone = {.count = points->count};
    for (int k = 0; k < points->count; k++) {
        alone.x[k] = points->x[k];
        alone.y[k] = points->y[k];
    }
    return alone;
}

static void put(const SettingValue *value, char *base)
{
    const Key *key = value->key;
    if (key->type == KEY_CHOICE && !(key->flags & KEY_INDEX))
        snprintf(base + key->offset, NAME_SIZE, "%s", value->name);
    else if (key->type == KEY_POINTS)
        *(ControlPoints *)(void *)(base + key->offset) = points_alone(&value->points);
    else
        memcpy(base + key->offset, value->bytes, field_size(key));
    if (key->type == KEY_CURVE)
        *(TimeTable *)(void *)(base + key->aux) = (TimeTable){0};
    if (key->type == KEY_RANGE)
        memcpy(base + key->aux, value->range.automatic, sizeof value->range.automatic);
}

void scene_set_back(Scene *scene, const SettingValue *value, const SettingBefore *before)
{
    const Key *key = value->key, *list = key_list(key);
    char *base = (char *)scene + (list ? key_list_at(list, value->element) : 0);
    bool *range = range_of(key, base);
    memcpy(base + key->offset, before->field, field_size(key));
    if (key->type == KEY_CURVE)
        *(TimeTable *)(void *)(base + key->aux) = before->table;
    if (key->type == KEY_RANGE)
        memcpy(base + key->aux, before->automatic, sizeof before->automatic);
    else if (range)
        *range = before->automatic[0];
}

/* Sets the text of the value, with all checks; a refusal has the words of a file. */
static bool set_by_text(Scene *scene, const SettingValue *value, bool *concerns_world, Error *error)
{
    char text[SETTING_TEXT_SIZE];
    setting_value_text(value, text);
    return scene_set_live(scene, text, concerns_world, error);
}

/* Makes the range automatic after a change of the scalar. */
static void range_follows(const Key *key, const SettingBefore *before, char *base)
{
    char was[NAME_SIZE], now[NAME_SIZE];
    bool *range = range_of(key, base);
    Key own = own_key(key);
    if (!range)
        return;
    key_value_text(&own, before->field, was, sizeof was);
    key_value_text(key, base, now, sizeof now);
    *range = *range || strcmp(key_range_scalar(was), key_range_scalar(now)) != 0;
}

bool scene_set_value(Scene *scene, const SettingValue *value, SettingBefore *before, bool *concerns_world,
                     Error *error)
{
    const Key *key = value->key;
    const LiveChange change = {.key = key, .list = key_list(key), .element = value->element};
    const bool there =
        !change.list || (!(change.list->flags & KEY_POINTER) && /* such a list has no live keys */
                         value->element < key_list_count(change.list, scene));
    const bool may = key->flags & KEY_LIVE && there && is_valid(value) &&
                     strncmp(key->path, "view.camera.", strlen("view.camera.")) != 0;
    char *base = there ? base_of(scene, &change) : NULL;
    const bool acceleration = scene->world.acceleration;
    if (there)
        save(key, base, before);
    if (!may)
        return set_by_text(scene, value, concerns_world, error);
    put(value, base);
    if (!scene_check_key(scene, key->path)) {
        scene_set_back(scene, value, before);
        return set_by_text(scene, value, concerns_world, error);
    }
    range_follows(key, before, base);
    scene->world.acceleration |= acceleration; /* stays on once kept */
    if (concerns_world)
        *concerns_world = in_world(scene, &change, base);
    return true;
}
