/* Widget of a live key. */
#include "app/panel/panel_parts.h"
#include "app/scene/keys.h"
#include "render/frame/legend.h"
#include "sim/base/color.h"
#include "sim/base/control_points.h"
#include "sim/base/key_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void emit(const PanelKey *row, PanelEvents *events, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void emit(const PanelKey *row, PanelEvents *events, const char *format, ...)
{
    if (events->setting_count == PANEL_SETTINGS_MAX)
        return;
    char *setting = events->settings[events->setting_count++];
    const int used = snprintf(setting, PANEL_SETTING_SIZE, "%.40s=", row->path);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(setting + used, PANEL_SETTING_SIZE - (size_t)used, format, arguments);
    va_end(arguments);
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
                     .unit = unit};
    scale.low = key->min;
    scale.high = key->max;
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
    if (ui_sliders(ui, field, &value, 1, &scale))
        emit(row, events, "%.9g", value);
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
    if (ui_sliders(ui, field, value, 3, &scale))
        emit(row, events, "[%.9g, %.9g, %.9g]", value[0], value[1], value[2]);
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
    if (ui_choice(ui, field, &chosen, names))
        emit(row, events, "%s", key_choice(key, chosen));
}

static void draw_color(Ui *ui, const PanelKey *row, const UiField *field, PanelEvents *events)
{
    const char *value = (const char *)row->base + row->key->offset;
    const bool single = row->key->flags & KEY_SINGLE;
    float srgb[3];
    for (int k = 0; k < 3; k++)
        srgb[k] = (float)linear_to_srgb(single ? ((const float *)value)[k] : ((const double *)value)[k]);
    if (ui_color(ui, field, srgb))
        emit(row, events, "[%.4g, %.4g, %.4g]", (double)srgb[0], (double)srgb[1], (double)srgb[2]);
}

/* Draws automatic on or off; if off, both ends. */
static void draw_range(Ui *ui, const PanelKey *row, const UiField *field, PanelEvents *events)
{
    const Key *key = row->key;
    const double *now = (const double *)((const char *)row->base + key->offset), *seen = row->range_now;
    const bool *is = (const bool *)row->base + key->aux;
    bool automatic = is[0], symmetric = is[1];
    char id[64], id_symmetric[64];
    snprintf(id, sizeof id, "%.40s.auto", row->path);
    const UiField follow = {.id = id, .label = "automatic range", .help = field->help};
    if (ui_checkbox(ui, &follow, &automatic)) {
        if (automatic)
            emit(row, events, "auto");
        else
            emit(row, events, "[%.9g, %.9g]", seen[0], seen[1] > seen[0] ? seen[1] : seen[0] + 1);
        return;
    }
    snprintf(id_symmetric, sizeof id_symmetric, "%.40s.symmetric", row->path);
    const UiField about_0 = {.id = id_symmetric, .label = "symmetric about 0", .help = field->help};
    if (automatic && ui_checkbox(ui, &about_0, &symmetric))
        emit(row, events, symmetric ? "symmetric" : "auto");
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
        emit(row, events, "[%.9g, %.9g]", ends[0], ends[1]);
}

/* Rounds the numbers, so that eight points fit into a setting. */
static void emit_points(const PanelKey *row, PanelEvents *events, const ControlPoints *points)
{
    char text[PANEL_SETTING_SIZE] = "[";
    size_t used = 1;
    for (int k = 0; k < points->count && used < sizeof text; k++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s[%.3f, %.3f]", k > 0 ? ", " : "",
                                 points->x[k], points->y[k]);
    emit(row, events, "%s]", text);
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
        emit(row, events, "%s", presets[chosen].name);
    else if (ui_curve(ui, &curve, &points, row->key->max))
        emit_points(row, events, &points);
}

void panel_key(Ui *ui, const PanelKey *row, PanelEvents *events)
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
            emit(row, events, "%s", on ? "true" : "false");
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
