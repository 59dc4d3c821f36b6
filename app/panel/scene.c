/* The scene's live keys, from the table of keys. */
#include "app/panel/panel_parts.h"
#include "app/scene/keys.h"
#include "render/frame/legend.h"
#include "render/frame/view.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { NAME_LENGTH = 48, PATH_LENGTH = 64 };

/* Keys belonging to a scalar, and the range in use while automatic. */
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

/* Live keys without a widget. */
static const struct {
    const char *path, *why;
} elsewhere[] = {
    {"view.camera.from", "the mouse moves the camera"},
    {"view.camera.to", "the mouse moves the camera"},
    {"view.camera.fov", "the mouse moves the camera"},
};

/* Live keys under a heading of their own: for pictures made for others. */
static const char FILM_GROUP[] = "Film";
static const char *const of_film[] = {"view.camera_turn", "view.carries_scene"};

static bool is_of_film(const Key *key)
{
    for (size_t i = 0; i < sizeof of_film / sizeof *of_film; i++)
        if (strcmp(of_film[i], key->path) == 0)
            return true;
    return false;
}

static bool is_elsewhere(const Key *key)
{
    if (key->type == KEY_TEXT) /* texts have no widget: set them in scenes or by --set */
        return true;
    for (size_t i = 0; i < sizeof elsewhere / sizeof *elsewhere; i++)
        if (strcmp(elsewhere[i].path, key->path) == 0)
            return true;
    for (size_t i = 0; i < sizeof color_keys / sizeof *color_keys; i++)
        if (strcmp(color_keys[i].path, key->path) == 0)
            return true;
    return false;
}

/* Returns the length of NAME in a key such as view.NAME.level; 0: a key of every view. */
static size_t part_of_view(const Key *key, const char **part)
{
    static const char VIEW[] = "view.";
    *part = key->path + strlen(VIEW);
    return strncmp(key->path, VIEW, strlen(VIEW)) == 0 && strchr(*part, '.') ? strcspn(*part, ".") : 0;
}

static bool is_a_view(const char *name, size_t length)
{
    for (int i = 0; view_at(i); i++)
        if (strlen(view_at(i)->name) == length && strncmp(view_at(i)->name, name, length) == 0)
            return true;
    return false;
}

/* True if the key belongs to a view that is not shown. */
static bool is_of_another_view(const Key *key, const Scene *scene)
{
    const char *part;
    const size_t length = part_of_view(key, &part);
    const char *shown = scene->view.kind;
    return length > 0 && is_a_view(part, length) &&
           !(strlen(shown) == length && strncmp(shown, part, length) == 0);
}

/* Fills in the heading of a key: "solver.step.dt" is in "Solver", "gravity" in "World", the shown view's
   own keys in "View", an overlay's under the overlay's name. */
static void group_of(const Key *key, char name[NAME_LENGTH])
{
    const char *part;
    const size_t length = strcspn(key->path, ".["), own = part_of_view(key, &part);
    if (is_of_film(key))
        snprintf(name, NAME_LENGTH, "%s", FILM_GROUP);
    else if (!key->path[length])
        snprintf(name, NAME_LENGTH, "World");
    else if (own > 0 && !is_a_view(part, own))
        snprintf(name, NAME_LENGTH, "%.*s", (int)own, part);
    else
        snprintf(name, NAME_LENGTH, "%.*s", (int)length, key->path);
    name[0] = (char)toupper((unsigned char)name[0]);
}

/* Makes the label: the path after the heading's part, or after the list, in words: "step dt". */
static void label_of(const Key *key, char label[NAME_LENGTH])
{
    const char *part;
    const size_t own = part_of_view(key, &part);
    const char *list = strstr(key->path, "[]"), *dot = strchr(list ? list : own ? part : key->path, '.');
    char unit[32];
    legend_unit(key->type == KEY_VEC3 ? key->unit : "", unit);
    snprintf(label, NAME_LENGTH, "%.30s%s%.14s", dot ? dot + 1 : key->path, *unit ? ", " : "", unit);
    for (char *c = label; *c && *c != ','; c++)
        if (*c == '_' || *c == '.')
            *c = ' ';
}

/* Turns "fluids[].color" into "fluids[1].color". */
static void path_of(const Key *key, int element, char path[PATH_LENGTH])
{
    const char *list = strstr(key->path, "[]");
    if (list)
        snprintf(path, PATH_LENGTH, "%.*s[%d]%s", (int)(list - key->path), key->path, element, list + 2);
    else
        snprintf(path, PATH_LENGTH, "%s", key->path);
}

/* Fills in the name of a list element: the value of its key `name`, or "drains 1". */
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

/* True if the key is shown: for a recorded run only view keys; of the views' own keys only the shown
   view's. */
static bool is_shown(const Key *key, const PanelData *data)
{
    return (key->flags & KEY_LIVE) && !is_elsewhere(key) && !is_of_another_view(key, data->scene) &&
           (!data->recorded || strncmp(key->path, "view.", strlen("view.")) == 0);
}

static bool is_in(const Key *key, const char *group, const PanelData *data)
{
    char own[NAME_LENGTH];
    group_of(key, own);
    return strcmp(own, group) == 0 && is_shown(key, data);
}

static void draw_group(Ui *ui, const char *group, const PanelData *data, const Scene *start,
                       PanelEvents *events)
{
    int count;
    const Key *keys = scene_keys(&count);
    const Key *last_list = NULL;
    for (int i = 0; i < count; i++) {
        const Key *list = key_list(&keys[i]);
        if (!is_in(&keys[i], group, data))
            continue;
        if (list && list != last_list)
            for (int e = 0; e < key_list_count(list, data->scene); e++)
                draw_element(ui, list, e, data->scene, start, events);
        else if (!list)
            draw_key(ui, &keys[i], data->scene, start, NULL, events);
        last_list = list;
    }
}

static const char VIEW_GROUP[] = "View";

void panel_view(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events)
{
    if (ui_section(ui, VIEW_GROUP, true))
        draw_group(ui, VIEW_GROUP, data, start, events);
}

/* The headings already drawn. */
typedef struct Groups {
    int count;
    char name[24][NAME_LENGTH];
} Groups;

/* Returns true if the heading is new; false also if the table is full: the last headings are then left
   out. */
static bool groups_add(Groups *groups, const char *name)
{
    for (int i = 0; i < groups->count; i++)
        if (strcmp(groups->name[i], name) == 0)
            return false;
    if (groups->count == (int)(sizeof groups->name / sizeof *groups->name))
        return false;
    snprintf(groups->name[groups->count++], NAME_LENGTH, "%s", name);
    return true;
}

void panel_scene(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events)
{
    int count;
    const Key *keys = scene_keys(&count);
    Groups groups = {.count = 0};
    char group[NAME_LENGTH];
    groups_add(&groups, VIEW_GROUP);
    for (int i = 0; i < count; i++) {
        if (!is_shown(&keys[i], data))
            continue;
        group_of(&keys[i], group);
        if (groups_add(&groups, group) && ui_section(ui, group, false))
            draw_group(ui, group, data, start, events);
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
    legend_unit(scalar_unit(view_color_by(&data->scene->view)), unit);
    snprintf(text, sizeof text, "%.4g to %.4g%s%s", data->scalar_range[0], data->scalar_range[1],
             *unit ? " " : "", unit);
    ui_row(ui, "range now", text);
}
