/* Widget of a live key. */
#include "app/scene/scene.h"
#include "app/window/panel/panel_private.h"
#include "render/frame/passes.h"
#include "render/frame/view.h"
#include "sim/base/base.h"
#include "sim/base/key.h"
#include "sim/flow/flow.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIGITS = 9, COLOR_DIGITS = 4 };

/* The next value to be filled in; in a full list the last one counts. */
static SettingValue *emit(const PanelKey *row, PanelEvents *events)
{
    if (events->value_count < PANEL_VALUES_MAX)
        events->value_count++;
    SettingValue *value = &events->values[events->value_count - 1];
    *value = (SettingValue){.key = row->key, .element = row->element};
    return value;
}

/* The number with a count of digits, for readable files. */
static double rounded(double number, int digits)
{
    char text[40];
    snprintf(text, sizeof text, "%.*g", digits, number);
    return strtod(text, NULL);
}

/* Makes the help text of a key: meaning, range, unit and path. */
static void help_of(const PanelKey *row, char *text, size_t size)
{
    char range[160];
    const bool numbers = row->key->type == KEY_NUMBER || row->key->type == KEY_CURVE ||
                         row->key->type == KEY_INTEGER || row->key->type == KEY_VEC3;
    key_range_text(row->key, range, sizeof range);
    key_help_text(row->key, text, size);
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "\n%s: %s%s%s%s", row->path, range, *row->key->unit ? " " : "",
             row->key->unit, numbers ? "\nCtrl + click to type a number" : "");
}

/* Returns the slider's range: the key's full range if small; else from a tenth to ten times the start
   value. Always includes the present value. */
static UiScale scale_of(const Key *key, double start, double now, const char *unit)
{
    const bool open = key->flags & KEY_OPEN_LOW;
    UiScale scale = {.least = open ? nextafter(key->min, key->max) : key->min,
                     .most = key->max,
                     .whole = key->type == KEY_INTEGER,
                     .unit = unit,
                     .zero = key->zero};
    const double small = 10;
    scale.low = key->min;
    scale.high = key->max;
    if (key->max - key->min <= small && start > 0 && !open)
        return scale;
    if (start > 0 && (key->min <= 0 || key->max / key->min > 100)) {
        scale.low = fmax(start / 10, key->min);
        scale.high = fmin(start * 10, key->max);
        scale.logarithmic = !scale.whole;
    } else if (start == 0 && key->min == 0) {
        scale.high = fmin(1, key->max);
    }
    if (now > 0 || !scale.logarithmic)
        scale.low = fmin(scale.low, now);
    scale.high = fmax(scale.high, now);
    if (scale.whole)
        scale.low = ceil(scale.low);
    return scale;
}

static void draw_number(Ui *ui, const PanelKey *row, const UiField *field, PanelEvents *events)
{
    const Key *key = row->key;
    const size_t at = key->offset;
    const bool whole = key->type == KEY_INTEGER;
    const char *now = row->base, *start = row->start;
    double value = whole ? *(const int *)(now + at) : *(const double *)(now + at);
    char unit[32];
    legend_unit(key->unit, unit);
    const UiScale scale =
        scale_of(key, whole ? *(const int *)(start + at) : *(const double *)(start + at), value, unit);
    if (!ui_sliders(ui, field, &value, 1, &scale))
        return;
    if (whole)
        emit(row, events)->whole = (int)value;
    else
        emit(row, events)->number[0] = rounded(value, DIGITS);
}

/* Draws three sliders of equal range around 0. */
static void draw_vector(Ui *ui, const PanelKey *row, const UiField *field, PanelEvents *events)
{
    const Key *key = row->key;
    const double *now = (const double *)((const char *)row->base + key->offset);
    const double *start = (const double *)((const char *)row->start + key->offset);
    double value[3], reach = 0;
    for (int k = 0; k < 3; k++) {
        value[k] = now[k];
        reach = fmax(reach, fmax(2 * fabs(start[k]), fabs(now[k])));
    }
    if (reach == 0)
        reach = fmin(1, key->max);
    reach = fmin(reach, key->max);
    const UiScale scale = {.low = -reach, .high = reach, .least = key->min, .most = key->max, .unit = ""};
    if (!ui_sliders(ui, field, value, 3, &scale))
        return;
    SettingValue *set = emit(row, events);
    for (int k = 0; k < 3; k++)
        set->number[k] = rounded(value[k], DIGITS);
}

enum { CHOICES_MAX = 64 };
_Static_assert(SCALAR_COUNT + 1 <= CHOICES_MAX, "the longest list of names");

static void draw_choice(Ui *ui, const PanelKey *row, const UiField *field, PanelEvents *events)
{
    const Key *key = row->key;
    const char *value = (const char *)row->base + key->offset;
    int chosen = key->flags & KEY_INDEX ? *(const int *)value : 0;
    while (!(key->flags & KEY_INDEX) && key_choice(key, chosen + 1) &&
           strcmp(key_choice(key, chosen), value) != 0)
        chosen++;
    const char *names[CHOICES_MAX + 1] = {NULL};
    for (int i = 0; i < CHOICES_MAX && key_choice(key, i); i++)
        names[i] = key_choice(key, i);
    if (!ui_choice(ui, field, &chosen, names))
        return;
    SettingValue *set = emit(row, events);
    if (key->flags & KEY_INDEX)
        set->whole = chosen;
    else
        snprintf(set->name, sizeof set->name, "%s", key_choice(key, chosen));
}

static void draw_color(Ui *ui, const PanelKey *row, const UiField *field, PanelEvents *events)
{
    const char *value = (const char *)row->base + row->key->offset;
    const bool single = row->key->flags & KEY_SINGLE;
    float srgb[3];
    for (int k = 0; k < 3; k++)
        srgb[k] = (float)linear_to_srgb(single ? ((const float *)value)[k] : ((const double *)value)[k]);
    if (!ui_color(ui, field, srgb))
        return;
    SettingValue *set = emit(row, events);
    for (int k = 0; k < 3; k++) {
        const double linear = srgb_to_linear(rounded((double)srgb[k], COLOR_DIGITS));
        if (single)
            set->single[k] = (float)linear;
        else
            set->number[k] = linear;
    }
}

/* Ends of NULL: automatic, the ends stay. */
static void emit_range(const PanelKey *row, PanelEvents *events, const double *ends, bool symmetric)
{
    SettingValue *set = emit(row, events);
    for (int k = 0; k < 2; k++)
        set->range.ends[k] = ends ? rounded(ends[k], DIGITS)
                                  : ((const double *)((const char *)row->base + row->key->offset))[k];
    set->range.automatic[0] = !ends;
    set->range.automatic[1] = symmetric;
}

/* Draws automatic on or off; if off, both ends. */
static void draw_range(Ui *ui, const PanelKey *row, const UiField *field, PanelEvents *events)
{
    const Key *key = row->key;
    static const double unknown[2] = {0, 1};
    const double *now = (const double *)((const char *)row->base + key->offset),
                 *seen = row->range_now ? row->range_now : unknown;
    const bool *is = (const bool *)row->base + key->aux;
    bool automatic = is[0], symmetric = is[1];
    char id[64], id_symmetric[64];
    snprintf(id, sizeof id, "%.40s.auto", row->path);
    const UiField follow = {.id = id, .label = "automatic range", .help = field->help};
    if (ui_checkbox(ui, &follow, &automatic)) {
        const double ends[2] = {seen[0], seen[1] > seen[0] ? seen[1] : seen[0] + 1};
        emit_range(row, events, automatic ? NULL : ends, false);
        return;
    }
    snprintf(id_symmetric, sizeof id_symmetric, "%.40s.symmetric", row->path);
    const UiField about_0 = {.id = id_symmetric, .label = "symmetric about 0", .help = field->help};
    if (automatic && ui_checkbox(ui, &about_0, &symmetric))
        emit_range(row, events, NULL, symmetric);
    if (automatic)
        return;
    double ends[2] = {now[0], now[1]};
    const double width = now[1] - now[0];
    const UiScale scale = {.low = fmin(now[0], seen[0]) - width / 2,
                           .high = fmax(now[1], seen[1]) + width / 2,
                           .least = key->min,
                           .most = key->max,
                           .unit = ""};
    if (ui_sliders(ui, field, ends, 2, &scale) && ends[0] < ends[1])
        emit_range(row, events, ends, false);
}

/* Rounds the numbers, so that eight points fit into a setting's text. */
static void emit_points(const PanelKey *row, PanelEvents *events, const ControlPoints *points)
{
    static const double STEPS = 1000;
    ControlPoints *set = &emit(row, events)->points;
    *set = *points;
    for (int k = 0; k < points->count; k++) {
        set->x[k] = round(STEPS * points->x[k]) / STEPS;
        set->y[k] = round(STEPS * points->y[k]) / STEPS;
    }
}

/* Draws the preset, if the points match one, and the curve. */
static void draw_points(Ui *ui, const PanelKey *row, const UiField *field, PanelEvents *events)
{
    const ControlPreset *presets = row->key->names;
    ControlPoints points = *(const ControlPoints *)(const void *)((const char *)row->base + row->key->offset);
    const char *names[CHOICES_MAX + 1] = {NULL};
    int count = 0;
    while (count + 1 < CHOICES_MAX && presets[count].name) {
        names[count] = presets[count].name;
        count++;
    }
    int chosen = 0;
    while (chosen < count && !control_points_equal(&points, &presets[chosen].points))
        chosen++;
    names[count] = chosen == count ? "by hand" : NULL;
    char id[64];
    snprintf(id, sizeof id, "%.40s.preset", row->path);
    const UiField preset = {.id = id, .label = field->label, .help = field->help};
    const UiField curve = {.id = field->id, .label = "", .help = field->help};
    if (ui_choice(ui, &preset, &chosen, names) && chosen < count)
        emit(row, events)->points = presets[chosen].points;
    else if (ui_curve(ui, &curve, &points, row->key->max))
        emit_points(row, events, &points);
}

static void panel_key(Ui *ui, const PanelKey *row, PanelEvents *events)
{
    char help[512];
    help_of(row, help, sizeof help);
    const UiField field = {.id = row->path, .label = row->label, .help = help};
    bool on;
    switch (row->key->type) {
    case KEY_NUMBER:
    case KEY_CURVE:
    case KEY_INTEGER:
        draw_number(ui, row, &field, events);
        break;
    case KEY_BOOLEAN:
        on = *((const bool *)row->base + row->key->offset);
        if (ui_checkbox(ui, &field, &on))
            emit(row, events)->on = on;
        break;
    case KEY_CHOICE:
        draw_choice(ui, row, &field, events);
        break;
    case KEY_VEC3:
        draw_vector(ui, row, &field, events);
        break;
    case KEY_COLOR:
        draw_color(ui, row, &field, events);
        break;
    case KEY_RANGE:
        draw_range(ui, row, &field, events);
        break;
    case KEY_POINTS:
        draw_points(ui, row, &field, events);
        break;
    case KEY_TEXT:
    case KEY_SETTINGS:
    case KEY_AXES:
    case KEY_NAMES:
    case KEY_MAPPING:
    case KEY_VARIANT:
    case KEY_LIST:
        break;
    }
}

/* The scene's live keys, from the table of keys. */

enum { NAME_LENGTH = 48, PATH_LENGTH = 64 };

/* Keys belonging to a scalar, and the range in use while automatic. */
static const struct {
    const char *path, *label;
    enum { COLOR_RANGE, OPACITY_RANGE, SIZE_RANGE } range;
} color_keys[] = {
    {"view.color_by", "color by", COLOR_RANGE},
    {"view.colormap", "colormap", COLOR_RANGE},
    {"view.color_curve", "color curve", COLOR_RANGE},
    {"view.range", "color range", COLOR_RANGE},
    {"view.opacity.by", "opacity by", OPACITY_RANGE},
    {"view.opacity.curve", "opacity curve", OPACITY_RANGE},
    {"view.opacity.range", "opacity range", OPACITY_RANGE},
    {"view.size.by", "size by", SIZE_RANGE},
    {"view.size.curve", "size curve", SIZE_RANGE},
    {"view.size.range", "size range", SIZE_RANGE},
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
static const char RENDER_GROUP[] = "Film";
static const char *const of_render[] = {"view.camera_turn", "view.carries_scene"};

/* Live keys to play with, and keys that say what the picture is. */
static const char PLAY_GROUP[] = "Play", VIEW_GROUP[] = "View", MORE_GROUP[] = "More of the view";
static const char *const of_play[] = {"gravity", "fluids[].viscosity"};
static const char *const of_view[] = {"view.kind", "view.quality"};
static const char RADIUS[] = "view.radius"; /* of the picture where particles have a size, else of shadows */
static const char *const of_each_view[] = {"look", "shading"}; /* of the view's own keys */

#define IS_AMONG(paths, path) is_among(paths, sizeof(paths) / sizeof *(paths), path)

static bool is_among(const char *const paths[], size_t count, const char *path)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(paths[i], path) == 0)
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

static bool says_the_picture(const Key *key, const Scene *scene)
{
    const char *part;
    const size_t own = part_of_view(key, &part);
    const ViewKind *shown = view_find(scene->view.kind);
    return IS_AMONG(of_view, key->path) || (own > 0 && IS_AMONG(of_each_view, part + own + 1)) ||
           (strcmp(key->path, RADIUS) == 0 && shown && (shown->curves & VIEW_SIZE));
}

/* Hundreds of keys for each open section of each picture: without a format. */
static void heading_put(char name[NAME_LENGTH], const char *text, size_t length)
{
    const size_t fits = length < NAME_LENGTH ? length : NAME_LENGTH - 1;
    memcpy(name, text, fits);
    name[fits] = 0;
    name[0] = (char)toupper((unsigned char)name[0]);
}

/* Fills in the heading of a key: "solver.step.dt" is in "Solver". The shown view's own keys are in "View" or
   "More of the view", an overlay's under the overlay's name. */
static void group_of(const Key *key, const Scene *scene, char name[NAME_LENGTH])
{
    const char *part;
    const size_t length = strcspn(key->path, ".["), own = part_of_view(key, &part);
    const bool of_a_view =
        strncmp(key->path, "view.", strlen("view.")) == 0 && (own == 0 || is_a_view(part, own));
    if (IS_AMONG(of_render, key->path))
        heading_put(name, RENDER_GROUP, strlen(RENDER_GROUP));
    else if (IS_AMONG(of_play, key->path))
        heading_put(name, PLAY_GROUP, strlen(PLAY_GROUP));
    else if (of_a_view && says_the_picture(key, scene))
        heading_put(name, VIEW_GROUP, strlen(VIEW_GROUP));
    else if (of_a_view)
        heading_put(name, MORE_GROUP, strlen(MORE_GROUP));
    else if (!key->path[length])
        heading_put(name, "World", strlen("World"));
    else if (own > 0 && !is_a_view(part, own))
        heading_put(name, part, own);
    else
        heading_put(name, key->path, length);
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
    if (!(key->flags & KEY_LIVE))
        return false;
    group_of(key, data->scene, own);
    return strcmp(own, group) == 0 && is_shown(key, data);
}

/* The element's keys of a heading. */
static void draw_element(Ui *ui, const Key *list, int index, const char *group, const PanelData *data,
                         const Scene *start, PanelEvents *events)
{
    int count;
    const Scene *scene = data->scene;
    const Key *keys = scene_keys(&count);
    const char *element = (const char *)scene + key_list_at(list, index);
    char label[NAME_LENGTH], path[PATH_LENGTH];
    name_of(list, element, index, label);
    ui_text(ui, label);
    for (int i = 0; i < count; i++) {
        if (key_list(&keys[i]) != list || !is_in(&keys[i], group, data))
            continue;
        path_of(&keys[i], index, path);
        if (!scene_key_works(scene, path))
            continue;
        label_of(&keys[i], label);
        panel_key(ui,
                  &(PanelKey){.key = &keys[i],
                              .element = index,
                              .base = element,
                              .start = (const char *)start + key_list_at(list, index),
                              .path = path,
                              .label = label},
                  events);
    }
}

/* `words`: label; NULL: of the path. */
static void draw_key(Ui *ui, const Key *key, const char *words, const Scene *scene, const Scene *start,
                     const double *range, PanelEvents *events)
{
    char label[NAME_LENGTH];
    if (words)
        snprintf(label, sizeof label, "%s", words);
    else
        label_of(key, label);
    panel_key(
        ui,
        &(PanelKey){
            .key = key, .base = scene, .start = start, .path = key->path, .label = label, .range_now = range},
        events);
}

static void draw_group(Ui *ui, const char *group, const PanelData *data, const Scene *start,
                       PanelEvents *events)
{
    int count;
    const Key *keys = scene_keys(&count);
    const Key *last_list = NULL;
    for (int i = 0; i < count; i++) {
        if (!is_in(&keys[i], group, data))
            continue;
        const Key *list = key_list(&keys[i]);
        if (list && list != last_list)
            for (int e = 0; e < key_list_count(list, data->scene); e++)
                draw_element(ui, list, e, group, data, start, events);
        else if (!list && scene_key_works(data->scene, keys[i].path))
            draw_key(ui, &keys[i], NULL, data->scene, start, NULL, events);
        last_list = list;
    }
}

void panel_view(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events)
{
    if (ui_section(ui, VIEW_GROUP, true))
        draw_group(ui, VIEW_GROUP, data, start, events);
    if (ui_section(ui, MORE_GROUP, false))
        draw_group(ui, MORE_GROUP, data, start, events);
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
    groups_add(&groups, PLAY_GROUP);
    groups_add(&groups, VIEW_GROUP);
    groups_add(&groups, MORE_GROUP);
    for (int i = 0; i < count; i++) {
        if (!is_shown(&keys[i], data))
            continue;
        group_of(&keys[i], data->scene, group);
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
        if (scene_key_works(data->scene, color_keys[i].path))
            draw_key(ui, scene_key_find(color_keys[i].path), color_keys[i].label, data->scene, start,
                     ranges[color_keys[i].range], events);
    legend_unit(scalar_unit(view_color_by(&data->scene->view)), unit);
    snprintf(text, sizeof text, "%.4g to %.4g%s%s", data->scalar_range[0], data->scalar_range[1],
             *unit ? " " : "", unit);
    ui_row(ui, "range now", text);
}

/* A switch for each term of the scene's model. */

/* True if the term is on in the scene. */
static bool is_on(const Scene *scene, const SceneTerm *term)
{
    SceneTerm now[TERMS_MAX];
    const int count = scene_terms(scene, now);
    for (int i = 0; i < count; i++)
        if (strcmp(now[i].path, term->path) == 0)
            return true;
    return false;
}

/* True if the term can be switched: its value must be short enough to be set again; a table is not. */
static bool can_switch(const SceneTerm *term)
{
    return term->key->flags & KEY_LIVE && strlen(term->value) < TERM_SIZE - 1 &&
           strlen(term->path) + strlen("=") + strlen(term->value) < SETTING_TEXT_SIZE;
}

/* Makes a label: "solver.artificial_viscosity", 0.05 becomes "solver artificial viscosity 0.05", which
   wraps. */
static void term_label(const SceneTerm *term, char label[2 * TERM_SIZE])
{
    snprintf(label, 2 * TERM_SIZE, "%s", term->path);
    for (char *c = label; *c; c++)
        if (*c == '_' || *c == '.')
            *c = ' ';
    const size_t used = strlen(label);
    snprintf(label + used, 2 * TERM_SIZE - used, " %s", term->value);
}

static void draw_switch(Ui *ui, const SceneTerm *term, bool on, PanelEvents *events)
{
    char id[TERM_SIZE + 8], label[2 * TERM_SIZE], help[512];
    snprintf(id, sizeof id, "term %s", term->path);
    term_label(term, label);
    key_help_text(term->key, help, sizeof help);
    const UiField field = {.id = id, .label = label, .help = help};
    if (ui_checkbox(ui, &field, &on))
        snprintf(events->term, sizeof events->term, "%s=%s", term->path, on ? term->value : term->key->off);
}

/* Shows a term fixed at the world's creation, and how to do without. */
static void draw_fixed(Ui *ui, const SceneTerm *term)
{
    char text[4 * TERM_SIZE], label[2 * TERM_SIZE];
    term_label(term, label);
    snprintf(text, sizeof text, "%.60s: needs a new start to go, with --set %.60s=%.20s", label, term->path,
             term->key->off);
    ui_faint(ui, text);
}

void panel_terms(Ui *ui, const Scene *scene, const Scene *start, PanelEvents *events)
{
    SceneTerm terms[TERMS_MAX];
    const int count = scene_terms(start, terms);
    if (count == 0 || !ui_section(ui, "Terms", false))
        return;
    for (int i = 0; i < count; i++)
        if (can_switch(&terms[i]))
            draw_switch(ui, &terms[i], is_on(scene, &terms[i]), events);
        else
            draw_fixed(ui, &terms[i]);
}

/* Settings needing a restart of the scene: number of particles, and presets. */

/* Shows the requested number while the slider is held, else the scene's. */
static void draw_particles(Ui *ui, const PanelData *data, PanelEvents *events)
{
    static const double LESS = 16, MORE = 16;
    const double now = (double)data->particles_at_start;
    const UiScale scale = {.low = fmax(1, floor(now / LESS)),
                           .high = fmax(now * MORE, data->particles_wished),
                           .least = 1,
                           .most = 1e8,
                           .whole = true,
                           .logarithmic = true,
                           .unit = ""};
    const UiField field = {
        "again.particles", "particles",
        "about so many at the start; the scene begins anew when you let go. The camera and what you set stay"};
    double value = data->particles_wished > 0 ? data->particles_wished : now;
    if (now > 0 && ui_sliders(ui, &field, &value, 1, &scale))
        events->particles = value;
}

static void draw_fluids(Ui *ui, const Scene *scene, int *fluid)
{
    const WorldDef *def = &scene->world;
    const char *names[FLUIDS_MAX + 1] = {NULL};
    const UiField field = {"again.fluid", "preset of", "which of the fluids becomes water, oil and so on"};
    *fluid = *fluid < def->fluid_count ? *fluid : 0;
    for (int i = 0; i < def->fluid_count; i++)
        names[i] = def->fluids[i].name;
    if (def->fluid_count > 1)
        ui_choice(ui, &field, fluid, names);
}

static void draw_recipe(Ui *ui, const Preset *recipe, int fluid, PanelEvents *events)
{
    char id[64], help[400];
    snprintf(id, sizeof id, "again.%s", recipe->name);
    snprintf(help, sizeof help, "%s\n%s", recipe->help, recipe->source);
    if (!ui_button(ui, &(UiField){id, recipe->name, help}, false))
        return;
    if (recipe->kind == PRESET_FLUID)
        snprintf(events->restart, sizeof events->restart, "preset=%s:%d", recipe->name, fluid);
    else
        snprintf(events->restart, sizeof events->restart, "preset=%s", recipe->name);
}

void panel_play(Ui *ui, const PanelData *data, const Scene *start, int *fluid, PanelEvents *events)
{
    if (!ui_section(ui, PLAY_GROUP, true))
        return;
    draw_group(ui, PLAY_GROUP, data, start, events);
    draw_particles(ui, data, events);
    ui_faint(ui, "begin anew with");
    draw_fluids(ui, data->scene, fluid);
    for (const Preset *recipe = preset_list; recipe->name; recipe++)
        draw_recipe(ui, recipe, *fluid, events);
    ui_gap(ui);
}

/* Emitters and drains: each is open or shut. */

static void draw_gate(Ui *ui, const PanelData *data, int gate, const char *label, PanelEvents *events)
{
    char id[GATE_NAME_SIZE];
    bool open = !gate_is_closed(events->gated ? events->closed_gates : data->closed_gates, gate);
    gate_name(gate, id);
    const UiField field = {id, label, "open, or shut from the next step on"};
    if (!ui_checkbox(ui, &field, &open))
        return;
    events->closed_gates = (events->gated ? events->closed_gates : data->closed_gates) ^ 1ULL << gate;
    events->gated = true;
}

void panel_flow(Ui *ui, const PanelData *data, PanelEvents *events)
{
    const WorldDef *def = &data->scene->world;
    char label[NAME_SIZE + 32];
    if ((!flow_emits(def) && def->drain_count == 0) || !ui_section(ui, "Flow", true))
        return;
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++) {
            snprintf(label, sizeof label, "%s, emitter %d", def->fluids[f].name, i + 1);
            draw_gate(ui, data, gate_of_emitter(f, i), label, events);
        }
    for (int k = 0; k < def->drain_count; k++) {
        snprintf(label, sizeof label, "drain %d", k + 1);
        draw_gate(ui, data, gate_of_drain(k), label, events);
    }
}

/* Box size: the requested size; walls move at limited speed. */

void panel_box(Ui *ui, const PanelData *data, PanelEvents *events)
{
    const WorldDef *def = &data->scene->world;
    const double least = 6 * def->spacing;
    const UiField field = {
        "box.size", "size",
        "width, height and depth; walls come in slowly, so that the fluid keeps calm\nCtrl + click to type a number"};
    const UiScale scale = {
        .low = least, .high = 2 * data->box_most, .least = least, .most = 1000, .unit = "m"};
    double size[3];
    if (!ui_section(ui, "Box", false))
        return;
    memcpy(size, data->box_wanted, sizeof size);
    if (!ui_sliders(ui, &field, size, def->dimensions, &scale))
        return;
    memcpy(events->size, size, sizeof events->size);
    events->sized = true;
}
