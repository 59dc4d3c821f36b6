/* The scene's live keys, from the table of keys. */
#include "app/panel/panel_parts.h"
#include "app/scene/keys.h"
#include "render/frame/legend.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { NAME_LENGTH = 48, PATH_LENGTH = 64 };

/* What goes with a scalar; of a range, which one it is while it is automatic. */
static const struct {
    const char *path;
    enum { COLOR_RANGE, OPACITY_RANGE, SIZE_RANGE } range;
} color_keys[] = {
    {"view.color_by", COLOR_RANGE},        {"view.colormap", COLOR_RANGE},
    {"view.color_curve", COLOR_RANGE},     {"view.range", COLOR_RANGE},
    {"view.opacity.by", OPACITY_RANGE},    {"view.opacity.curve", OPACITY_RANGE},
    {"view.opacity.range", OPACITY_RANGE}, {"view.size.by", SIZE_RANGE},
    {"view.size.curve", SIZE_RANGE},       {"view.size.range", SIZE_RANGE},
};

/* Live keys that are no widget among the scene's. */
static const struct {
    const char *path, *why;
} elsewhere[] = {
    {"view.camera.from", "the mouse moves the camera"},
    {"view.camera.to", "the mouse moves the camera"},
    {"view.camera.fov", "the mouse moves the camera"},
};

static bool is_elsewhere(const Key *key)
{
    if (key->type == KEY_TEXT) /* words have no widget: they are for scenes and --set */
        return true;
    for (size_t i = 0; i < sizeof elsewhere / sizeof *elsewhere; i++)
        if (strcmp(elsewhere[i].path, key->path) == 0)
            return true;
    for (size_t i = 0; i < sizeof color_keys / sizeof *color_keys; i++)
        if (strcmp(color_keys[i].path, key->path) == 0)
            return true;
    return false;
}

/* The first part of a path, as a heading: "solver.step.dt" is in "Solver", "gravity" in "World". */
static void group_of(const Key *key, char name[NAME_LENGTH])
{
    const size_t length = strcspn(key->path, ".[");
    if (!key->path[length]) {
        snprintf(name, NAME_LENGTH, "World");
        return;
    }
    snprintf(name, NAME_LENGTH, "%.*s", (int)length, key->path);
    name[0] = (char)toupper((unsigned char)name[0]);
}

/* What follows the first part, or its list, in words: "step dt". */
static void label_of(const Key *key, char label[NAME_LENGTH])
{
    const char *list = strstr(key->path, "[]"), *dot = strchr(list ? list : key->path, '.');
    char unit[32];
    legend_unit(key->type == KEY_VEC3 ? key->unit : "", unit);
    snprintf(label, NAME_LENGTH, "%.30s%s%.14s", dot ? dot + 1 : key->path, *unit ? ", " : "", unit);
    for (char *c = label; *c && *c != ','; c++)
        if (*c == '_' || *c == '.')
            *c = ' ';
}

/* "fluids[].color" as "fluids[1].color". */
static void path_of(const Key *key, int element, char path[PATH_LENGTH])
{
    const char *list = strstr(key->path, "[]");
    if (list)
        snprintf(path, PATH_LENGTH, "%.*s[%d]%s", (int)(list - key->path), key->path, element, list + 2);
    else
        snprintf(path, PATH_LENGTH, "%s", key->path);
}

/* What an element of the list is called: what its key `name` has, or "drains 1". */
static void name_of(const Key *list, const void *element, int index, char name[NAME_LENGTH])
{
    const char *dot = strrchr(list->path, '.');
    char path[PATH_LENGTH];
    snprintf(path, sizeof path, "%s[].name", list->path);
    const Key *key = scene_key_find(path);
    if (key)
        key_value_text(key, element, name, NAME_LENGTH);
    else
        snprintf(name, NAME_LENGTH, "%.30s %d", dot ? dot + 1 : list->path, index + 1);
}

static void draw_element(Ui *ui, const Key *list, int index, const Scene *scene, const Scene *start,
                         PanelEvents *events)
{
    int count;
    const Key *keys = scene_keys(&count);
    const char *element = (const char *)scene + key_list_at(list, index);
    char label[NAME_LENGTH], path[PATH_LENGTH];
    name_of(list, element, index, label);
    ui_text(ui, label);
    for (int i = 0; i < count; i++) {
        if (!(keys[i].flags & KEY_LIVE) || key_list(&keys[i]) != list)
            continue;
        label_of(&keys[i], label);
        path_of(&keys[i], index, path);
        panel_key(ui,
                  &(PanelKey){.key = &keys[i],
                              .base = element,
                              .start = (const char *)start + key_list_at(list, index),
                              .path = path,
                              .label = label},
                  events);
    }
}

static void draw_key(Ui *ui, const Key *key, const Scene *scene, const Scene *start, const double *range,
                     PanelEvents *events)
{
    char label[NAME_LENGTH];
    label_of(key, label);
    panel_key(
        ui,
        &(PanelKey){
            .key = key, .base = scene, .start = start, .path = key->path, .label = label, .range_now = range},
        events);
}

/* Of a recorded run the view's alone. */
static bool is_shown(const Key *key, bool recorded)
{
    return (key->flags & KEY_LIVE) && !is_elsewhere(key) &&
           (!recorded || strncmp(key->path, "view.", strlen("view.")) == 0);
}

void panel_scene(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events)
{
    const Scene *scene = data->scene;
    int count;
    const Key *keys = scene_keys(&count);
    const Key *last_list = NULL;
    char last[NAME_LENGTH] = "", group[NAME_LENGTH];
    bool open = false;
    for (int i = 0; i < count; i++) {
        const Key *list = key_list(&keys[i]);
        if (!is_shown(&keys[i], data->recorded))
            continue;
        group_of(&keys[i], group);
        if (strcmp(group, last) != 0)
            open = ui_section(ui, group, false);
        memcpy(last, group, sizeof last);
        if (open && list && list != last_list)
            for (int e = 0; e < key_list_count(list, scene); e++)
                draw_element(ui, list, e, scene, start, events);
        else if (open && !list)
            draw_key(ui, &keys[i], scene, start, NULL, events);
        last_list = list;
    }
}

void panel_colors(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events)
{
    char unit[32], text[80];
    const double *const ranges[] = {data->scalar_range, data->opacity_range, data->size_range};
    if (!ui_section(ui, "Colours", false))
        return;
    for (size_t i = 0; i < sizeof color_keys / sizeof *color_keys; i++)
        draw_key(ui, scene_key_find(color_keys[i].path), data->scene, start, ranges[color_keys[i].range],
                 events);
    legend_unit(scalar_unit(data->scene->view.color_by), unit);
    snprintf(text, sizeof text, "%.4g to %.4g%s%s", data->scalar_range[0], data->scalar_range[1],
             *unit ? " " : "", unit);
    ui_row(ui, "range now", text);
}
