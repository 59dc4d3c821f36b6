/* The table of keys, made of the groups of keys in sequence. */
#include "app/scene/keys.h"

#include "app/metric/metric_list.h"
#include "app/scene/preset.h"
#include "render/frame/overlay.h"
#include "render/frame/view.h"
#include "render/renderer.h"
#include "sim/base/key_rows.h"
#include "sim/world/backend.h"
#include "sim/world/method.h"
#include "sim/world/world.h"

#include <assert.h>
#include <pthread.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

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
    box_motion_keys[];                                            /* sim/matter */
extern const Key preset_keys[];                                   /* app/scene */
extern const Key probe_keys[];                                    /* app/probe */
extern const Key motion_keys[], solid_motion_keys[], hand_keys[]; /* sim/box */
extern const Key touch_keys[];                                    /* sim/touch */
extern const Key method_keys[], backend_keys[];                   /* sim/world */
extern const Key view_keys[], view_frame_keys[];                  /* render/frame */

enum { KEYS_MAX = 512 };

static Key table[KEYS_MAX];
static int table_count;

static size_t moved(size_t offset, size_t by)
{
    return offset == KEY_NOWHERE ? KEY_NOWHERE : offset + by;
}

/* The mapping above a row; NULL: none. */
static const Key *mapping_of(const Key *key)
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

/* Adds a row; rows of list elements have offsets within the element. */
static void table_add(const Key *key, size_t at, const KeyOwner *owner)
{
    assert(table_count < KEYS_MAX);
    Key *row = &table[table_count];
    const Key *above = mapping_of(key);
    const size_t by = strstr(key->path, "[]") ? 0 : at;
    *row = *key;
    row->offset = moved(key->offset, by);
    row->aux = moved(key->aux, by);
    row->flags |= above ? above->flags & KEY_IDLE : 0;
    if (!key->owner && !(above && above->owner == owner))
        row->owner = owner; /* otherwise by the mapping above */
    table_count++;
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
        add_rows(view_at(i)->keys, offsetof(Scene, view.of_view) + (size_t)i * sizeof(ViewOwn), &owners[i]);
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
        add_rows(overlay_list[i]->keys, offsetof(Scene, view.of_overlay) + (size_t)i * sizeof(ViewOwn),
                 &owners[i]);
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
}

int scene_view_count(const Scene *scene)
{
    return scene->view_count > 0 ? scene->view_count : 1;
}

bool scene_shows(const Scene *scene, const ViewDef *view)
{
    return !*view->file && strcmp(view->set, scene->beside) == 0;
}

bool scene_view_accelerates(const ViewDef *view)
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
    snprintf(scene->preset, sizeof scene->preset, "%s", preset_list[0].name);
    scene->metric_count = metric_defaults(scene->metrics);
}
