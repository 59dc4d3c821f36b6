#include "app/scene/scene.h"

#include "app/run/measure/measure.h"
#include "app/scene/scene_private.h"
#include "render/frame/view.h"
#include "render/renderer.h"
#include "sim/base/key_rows.h"
#include "sim/def.h"
#include "sim/step/backend.h"
#include "sim/step/method.h"
#include "sim/world.h"

#include <assert.h>
#include <pthread.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const KeyScalar key_scalars[KEY_SCALARS] = {{"view.color_by", "view.range"},
                                            {"view.opacity.by", "view.opacity.range"},
                                            {"view.size.by", "view.size.range"}};

void key_range_reset(const KeyScalar *scalar, void *base)
{
    *((bool *)base + scene_key_find(scalar->range)->aux) = true;
}

const char *key_range_scalar(const char *scalar)
{
    return strcmp(scalar, "auto") == 0 ? scalar_name(SCALAR_SPEED) : scalar;
}

void key_range_update(const KeyScalar *scalar, const void *before, void *base)
{
    const Key *key = scene_key_find(scalar->by);
    char was[NAME_SIZE], now[NAME_SIZE];
    key_value_text(key, before, was, sizeof was);
    key_value_text(key, base, now, sizeof now);
    if (strcmp(key_range_scalar(was), key_range_scalar(now)) != 0)
        key_range_reset(scalar, base);
}

void key_help_text(const Key *key, char *text, size_t size)
{
    const char *owner = key->owner && key->owner->name ? key->owner->name : "";
    snprintf(text, size, "%s%s%s", owner, *owner ? ": " : "", key->help);
}

/* Order of paths as of strcmp; a path with indices ([0]) equals the path of a row, which has none ([]). */
static int path_order(const char *path, const char *row)
{
    while (*row && *row == *path) {
        if (*path == '[')
            path += 1 + strspn(path + 1, "0123456789");
        else
            path++;
        row++;
    }
    return (unsigned char)*path - (unsigned char)*row;
}

static const KeyListMapping views = {"views", "view", offsetof(Scene, view)};

const KeyListMapping *key_list_mapping(const Key *list)
{
    return strcmp(list->path, views.list) == 0 ? &views : NULL;
}

const Key *key_list_of_mapping(const char *path)
{
    const size_t length = strlen(views.list);
    return strncmp(path, views.list, length) == 0 && path[length] == '[' ? scene_key_find(views.list) : NULL;
}

/* Finds the row for views[1].kind, which is view.kind. */
static const Key *find_like(const char *path)
{
    char own[128];
    const Key *list = key_list_of_mapping(path);
    const char *behind = list ? strchr(path, ']') : NULL;
    if (!behind || behind[1] != '.')
        return NULL;
    snprintf(own, sizeof own, "%s%s", key_list_mapping(list)->mapping, behind + 1);
    return scene_key_find(own);
}

/* The rows by path: the panel looks for hundreds in each of its pictures. */
enum { KEYS_MAX = 512 };

static const Key *by_path[KEYS_MAX];

static int order_of_rows(const void *a, const void *b)
{
    return strcmp((*(const Key *const *)a)->path, (*(const Key *const *)b)->path);
}

static int order_to_row(const void *path, const void *row)
{
    return path_order(path, (*(const Key *const *)row)->path);
}

const Key *scene_key_find(const char *path)
{
    int count;
    scene_keys(&count);
    const Key *const *found = bsearch(path, by_path, (size_t)count, sizeof *by_path, order_to_row);
    return found ? *found : find_like(path);
}

int key_list_count(const Key *list, const Scene *scene)
{
    return *(const int *)(const void *)((const char *)scene + list->aux);
}

size_t key_list_at(const Key *list, int index)
{
    const KeyListMapping *like = key_list_mapping(list);
    assert(!(list->flags & KEY_POINTER));
    return list->offset + (size_t)index * list->size - (like ? like->at : 0);
}

const char *key_element(const Key *list, const void *base, int index)
{
    const char *field = (const char *)base + list->offset;
    return list->flags & KEY_POINTER ? *(const char *const *)(const void *)field + (size_t)index * list->size
                                     : (const char *)base + key_list_at(list, index);
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

/* The table of keys, made of the groups of keys in sequence. */

static const KeyOwner chart = {
    .name = "slosh chart", .command = "chart", .need = "slosh chart, which alone reads it"};

/* The scene's own keys, each group at its place in the table. Bounds of all keys are wide: bounds catch wrong
   units and signs, not unusual choices. */
/* clang-format off */
static const Key title_keys[] = {
    TEXT("title", L | I, sizeof((Scene *)0)->title, offsetof(Scene, title), "the file's name", "what the scene shows"),
    KEYS_END,
};
static const Key realtime_keys[] = {
    BOOLEAN("solver.step.realtime", L | I, offsetof(Scene, realtime),
            "in the window, simulate as many frames as the clock asks for; false: as many as it can"),
    KEYS_END,
};
static const Key metric_keys[] = {
    NAMES_OF("metrics", 1, SCENE_METRICS_MAX, metric_kinds, offsetof(Scene, metrics), offsetof(Scene, metric_count),
          "what is compared of two runs of the scene, [front, kinetic_energy] and so on; slosh info explains them", .owner = &chart, .flags = I),
    KEYS_END,
};
static const Key views_keys[] = {
    {.path = "views", .type = KEY_LIST, .flags = I, .unit = "", BOUNDS(0, PANELS_MAX), .offset = offsetof(Scene, views),
     .aux = offsetof(Scene, view_count), .size = sizeof(ViewDef),
     .help = "pictures beside each other: each entry has keys of view, and all else as view has it"},
    KEYS_END,
};
/* clang-format on */

/* The rows of each owner are defined beside the struct with their fields. */
extern const Key box_keys[], fluid_keys[], solid_keys[], solver_keys[], step_keys[],
    box_motion_keys[];                                            /* sim/def */
extern const Key preset_keys[];                                   /* app/scene */
extern const Key probe_keys[];                                    /* app/run/measure */
extern const Key motion_keys[], solid_motion_keys[], hand_keys[]; /* sim/box */
extern const Key touch_keys[];                                    /* sim/flow */
extern const Key method_keys[], backend_keys[];                   /* sim/step */
extern const Key view_keys[], view_frame_keys[];                  /* render/frame */

static Key table[KEYS_MAX];
static int table_count;
static const Key *above_of[KEYS_MAX]; /* the mapping above a row; NULL: none */
static const Key *list_of[KEYS_MAX];  /* the list of a row of its elements; NULL: none */

static size_t moved(size_t offset, size_t by)
{
    return offset == KEY_NOWHERE ? KEY_NOWHERE : offset + by;
}

/* The mapping above a row to be added. */
static const Key *find_mapping(const Key *key)
{
    const Key *above = NULL;
    for (const Key *row = table; row < table + table_count; row++) {
        const size_t length = strlen(row->path);
        if (row->type == KEY_MAPPING && strncmp(key->path, row->path, length) == 0 &&
            key->path[length] == '.')
            above = row;
    }
    return above;
}

/* Lists come before the rows of their elements. */
static const Key *find_list(const Key *key)
{
    const char *brackets = strstr(key->path, "[].");
    if (!brackets || strstr(brackets + 1, "[]."))
        return NULL;
    const size_t length = (size_t)(brackets - key->path);
    for (const Key *row = table; row < table + table_count; row++)
        if (strlen(row->path) == length && strncmp(row->path, key->path, length) == 0)
            return row;
    return NULL;
}

/* Adds a row; rows of list elements have offsets within the element. */
static void table_add(const Key *key, size_t at, const KeyOwner *owner)
{
    assert(table_count < KEYS_MAX);
    Key *row = &table[table_count];
    const Key *above = find_mapping(key);
    const size_t by = strstr(key->path, "[]") ? 0 : at;
    *row = *key;
    row->offset = moved(key->offset, by);
    row->aux = moved(key->aux, by);
    row->flags |= above ? above->flags & KEY_IDLE : 0;
    if (!key->owner && !(above && above->owner == owner))
        row->owner = owner; /* otherwise by the mapping above */
    above_of[table_count] = above;
    list_of[table_count] = find_list(key);
    table_count++;
}

const Key *key_list(const Key *key)
{
    return list_of[key - table];
}

static const Key *mapping_of(const Key *row)
{
    return above_of[row - table];
}

static void add_rows(const Key *rows, size_t at, const KeyOwner *owner)
{
    for (const Key *key = rows; key && key->path; key++)
        table_add(key, at, owner);
}

/* Adds the own settings of each method. */
static void add_methods(void)
{
    static KeyOwner owners[METHODS_MAX];
    const Method *const *method = method_list();
    for (int i = 0; method[i]; i++) {
        owners[i] = (KeyOwner){.name = method[i]->name, .key = "solver.method", .value = method[i]->name};
        add_rows(method[i]->keys, offsetof(Scene, world.of_method) + (size_t)i * sizeof(MethodDef),
                 &owners[i]);
    }
}

/* Adds the own settings of each backend. */
static void add_backends(void)
{
    static KeyOwner owners[BACKENDS_MAX];
    const Backend *const *backend = backend_list();
    for (int i = 0; backend[i]; i++) {
        owners[i] = (KeyOwner){.name = backend[i]->name, .key = "solver.backend", .value = backend[i]->name};
        add_rows(backend[i]->keys, offsetof(Scene, world.of_backend) + (size_t)i * sizeof(BackendDef),
                 &owners[i]);
    }
}

/* Adds the own settings of each view. */
static void add_views(void)
{
    static KeyOwner owners[VIEW_KINDS_MAX];
    for (int i = 0; view_at(i); i++) {
        owners[i] = (KeyOwner){.key = "view.kind", .value = view_at(i)->name};
        add_rows(view_at(i)->keys, offsetof(Scene, view.own) + view_own_offset(i), &owners[i]);
    }
}

/* Adds the own settings of each overlay. */
static void add_overlays(void)
{
    static KeyOwner owners[OVERLAY_KINDS_MAX];
    static char shows[OVERLAY_KINDS_MAX][NAME_SIZE + 16];
    for (int i = 0; overlay_list[i]; i++) {
        snprintf(shows[i], sizeof shows[i], "view.%s.show", overlay_list[i]->name);
        owners[i] = (KeyOwner){.key = shows[i], .value = "true"};
        add_rows(overlay_list[i]->keys, offsetof(Scene, view.own) + overlay_own_offset(i), &owners[i]);
    }
}

/* Adds all groups in display order: rows, offset of their struct in a Scene, and the owner of rows without
   one (NULL: always read). */
static void table_make(void)
{
    const size_t world = offsetof(Scene, world), view = offsetof(Scene, view);
    add_rows(title_keys, 0, NULL);
    add_rows(box_keys, world, NULL);
    add_rows(fluid_keys, world, NULL);
    add_rows(solid_keys, world, NULL);
    add_rows(solid_motion_keys, 0, NULL);
    add_rows(method_keys, world, NULL);
    add_rows(preset_keys, 0, NULL);
    add_methods();
    add_rows(backend_keys, world, NULL);
    add_backends();
    add_rows(solver_keys, world, NULL);
    add_rows(step_keys, world, NULL);
    add_rows(realtime_keys, 0, NULL);
    add_rows(hand_keys, offsetof(Scene, world.limits), NULL);
    add_rows(touch_keys, offsetof(Scene, touch), NULL);
    add_rows(box_motion_keys, world, NULL);
    add_rows(motion_keys, 0, NULL);
    add_rows(metric_keys, 0, NULL);
    add_rows(probe_keys, offsetof(Scene, probes), NULL);
    add_rows(view_keys, view, NULL);
    add_views();
    add_overlays();
    add_rows(view_frame_keys, view, NULL);
    add_rows(views_keys, 0, NULL);
    for (int i = 0; i < table_count; i++)
        by_path[i] = &table[i];
    qsort(by_path, (size_t)table_count, sizeof *by_path, order_of_rows);
}

int scene_view_count(const Scene *scene)
{
    return scene->view_count > 0 ? scene->view_count : 1;
}

bool scene_shows(const Scene *scene, const ViewDef *view)
{
    return !view->file && strcmp(text_or_empty(view->set), text_or_empty(scene->compared_set)) == 0;
}

bool scene_view_reads_acceleration(const ViewDef *view)
{
    return renderer_attributes(view) & PARTICLE_SCALAR(SCALAR_ACCELERATION_X) * 7U;
}

const ViewDef *scene_view(const Scene *scene, int index)
{
    return scene->view_count > 0 ? &scene->views[index] : &scene->view;
}

const Key *scene_keys(int *count)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, table_make);
    *count = table_count;
    return table;
}

const KeyOwner *key_owner(const Key *key)
{
    const Key *row = key;
    while (row && !row->owner)
        row = mapping_of(row);
    const KeyOwner *owner = row ? row->owner : NULL;
    const bool decides = owner && owner->key && strcmp(owner->key, key->path) == 0;
    return decides ? NULL : owner; /* the key that selects an owner is always read */
}

void scene_default(Scene *scene)
{
    *scene = (Scene){.world = world_def_default(),
                     .view = view_def_default(),
                     .realtime = true,
                     .touch = touch_def_default()};
    snprintf(scene->preset, sizeof scene->preset, "%s", solver_preset_list[0].name);
    scene->metric_count = metric_defaults(scene->metrics);
}

/* Tests if the owner of a key is in use in a scene. */

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
            elements += *(const int *)(const void *)(key_element(&keys[i], outer, e) + list->aux);
    }
    return elements;
}

static bool is_as_owned(const Scene *scene, const Key *key, const KeyOwner *owner)
{
    char now[NAME_SIZE];
    if (key->type == KEY_LIST)
        return elements_of(scene, key) > 0;
    key_value_text(key, scene, now, sizeof now);
    if (owner->unless)
        return strcmp(now, owner->unless) != 0;
    return owner->value ? strcmp(now, owner->value) == 0 : strcmp(now, "none") != 0;
}

bool key_owner_used(const KeyOwner *owner, const Scene *scene, KeyUse use)
{
    if (owner->command)
        return scene->purpose == SCENE_FOR_CHART || use == KEY_OF_FILE;
    const Key *key = scene_key_find(owner->key);
    if (key->flags & KEY_LIVE && scene->purpose == SCENE_FOR_WINDOW && use != KEY_AT_PRESENT)
        return true;
    return (key->flags & KEY_IDLE && use == KEY_OF_FILE) || is_as_owned(scene, key, owner);
}

const KeyOwner *key_owner_missing(const Key *key, const Scene *scene, KeyUse use)
{
    const Key *above = mapping_of(key);
    const KeyOwner *outer = above ? key_owner_missing(above, scene, use) : NULL;
    if (outer)
        return strcmp(outer->key ? outer->key : "", key->path) == 0 ? NULL : outer;
    return key->owner && !key_owner_used(key->owner, scene, use) ? key->owner : NULL;
}

void key_owner_condition(const KeyOwner *owner, char *text, size_t size)
{
    if (owner->need)
        snprintf(text, size, "%s", owner->need);
    else
        snprintf(text, size, "%s: %s", owner->key, owner->value);
}

/* Fills in the index: "fluids[].viscosity" gives "fluids[1].viscosity". */
static void path_of(const Key *key, int element, char path[TERM_SIZE])
{
    const char *inner = strstr(key->path, "[]");
    if (inner)
        snprintf(path, TERM_SIZE, "%.*s[%d]%s", (int)(inner - key->path), key->path, element,
                 inner + strlen("[]"));
    else
        snprintf(path, TERM_SIZE, "%s", key->path);
}

/* True if the term is on in the struct at `base`. */
static bool is_on(const Key *key, const void *base, char value[TERM_SIZE])
{
    char text[TIME_TABLE_ROWS * 48];
    key_value_text(key, base, text, sizeof text);
    snprintf(value, TERM_SIZE, "%.*s", TERM_SIZE - 1, text);
    return strcmp(text, key->off) != 0;
}

int scene_terms(const Scene *scene, SceneTerm terms[TERMS_MAX])
{
    int count, found = 0;
    const Key *keys = scene_keys(&count);
    for (const Key *key = keys; key < keys + count; key++) {
        const KeyOwner *owner = key->off ? key_owner(key) : NULL;
        if (!key->off || (owner && !key_owner_used(owner, scene, KEY_SAID)))
            continue;
        const Key *list = key_list(key);
        for (int e = 0; e < (list ? key_list_count(list, scene) : 1) && found < TERMS_MAX; e++) {
            SceneTerm *term = &terms[found];
            const size_t at = list ? key_list_at(list, e) : 0;
            term->key = key;
            path_of(key, e, term->path);
            found += is_on(key, (const char *)scene + at, term->value);
        }
    }
    return found;
}
