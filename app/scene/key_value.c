/* The value of a key as text, as in a scene file. */
#include "app/scene/scene_private.h"
#include "sim/base/base.h"
#include "sim/base/key.h"
#include "sim/def.h"

#include <stdlib.h>
#include <string.h>

static void print_triple(char *text, size_t size, const char *format, const double v[3])
{
    char part[3][32];
    for (int k = 0; k < 3; k++)
        snprintf(part[k], sizeof part[k], format, v[k]);
    snprintf(text, size, "[%s, %s, %s]", part[0], part[1], part[2]);
}

static void color_text(const Key *key, const char *field, char *text, size_t size)
{
    double color[3];
    for (int k = 0; k < 3; k++)
        color[k] =
            linear_to_srgb(key->flags & KEY_SINGLE ? ((const float *)field)[k] : ((const double *)field)[k]);
    print_triple(text, size, "%.3g", color);
}

static void rows_text(const double *x, const double *y, int count, char *text, size_t size)
{
    int used = snprintf(text, size, "[");
    for (int k = 0; k < count && used >= 0 && (size_t)used < size; k++)
        used += snprintf(text + used, size - (size_t)used, "%s[%.9g, %.9g]%s", k ? ", " : "", x[k], y[k],
                         k + 1 < count ? "" : "]");
}

/* Prints one number, or the rows. */
static void curve_text(const TimeTable *table, double number, char *text, size_t size)
{
    if (table->rows > 0)
        rows_text(table->time, table->value, (int)table->rows, text, size);
    else
        snprintf(text, size, "%.9g", number);
}

/* Prints a preset's name, or the points. */
static void points_text(const Key *key, const ControlPoints *points, char *text, size_t size)
{
    for (const ControlPreset *preset = key->names; preset->name; preset++)
        if (control_points_equal(points, &preset->points)) {
            snprintf(text, size, "%s", preset->name);
            return;
        }
    rows_text(points->x, points->y, points->count, text, size);
}

static void axes_text(const bool axes[3], char *text, size_t size)
{
    const char *names = "xyz";
    int used = snprintf(text, size, "[");
    for (int k = 0; k < 3; k++)
        if (axes[k])
            used += snprintf(text + used, size - (size_t)used, "%s%c", used > 1 ? ", " : "", names[k]);
    snprintf(text + used, size - (size_t)used, "]");
}

static void names_text(const Key *key, const int *places, int count, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "[");
    for (int k = 0; k < count && used < size; k++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", k ? ", " : "", key_choice(key, places[k]));
    if (used < size)
        snprintf(text + used, size - used, "]");
}

/* Prints {"path": value, "path": value}: a path with an index needs quotes. */
static void settings_text(const char *lines, char *text, size_t size)
{
    FILE *file = *lines ? fmemopen(text, size, "w") : NULL;
    if (!file)
        return;
    for (const char *at = lines; *at;) {
        const int length = (int)strcspn(at, "\n"), path = (int)strcspn(at, "=");
        fprintf(file, "%s\"%.*s\": %.*s", at == lines ? "{" : ", ", path, at, length - path - 1,
                at + path + 1);
        at += length + (at[length] != 0);
    }
    fputc('}', file);
    fclose(file);
}

const char *key_text(const Key *key, const void *field)
{
    return key->flags & KEY_POINTER ? text_or_empty(*(const char *const *)field) : field;
}

void key_value_text(const Key *key, const void *base, char *text, size_t size)
{
    *text = 0;
    if (key->type == KEY_CHOICE && key->offset == KEY_NOWHERE)
        snprintf(text, size, "%s", key_choice(key, 0));
    if (key->offset == KEY_NOWHERE)
        return;
    const char *field = (const char *)base + key->offset;
    switch (key->type) {
    case KEY_NUMBER:
        snprintf(text, size, "%.9g", *(const double *)field);
        break;
    case KEY_CURVE:
        curve_text((const TimeTable *)((const char *)base + key->aux), *(const double *)field, text, size);
        break;
    case KEY_INTEGER:
        snprintf(text, size, "%d", *(const int *)field);
        break;
    case KEY_BOOLEAN:
        snprintf(text, size, "%s", *(const bool *)field ? "true" : "false");
        break;
    case KEY_TEXT:
        snprintf(text, size, "%s", key_text(key, field));
        break;
    case KEY_CHOICE:
        snprintf(text, size, "%s", key->flags & KEY_INDEX ? key_choice(key, *(const int *)field) : field);
        break;
    case KEY_VEC3:
        print_triple(text, size, "%.9g", (const double *)field);
        break;
    case KEY_AXES:
        axes_text((const bool *)field, text, size);
        break;
    case KEY_NAMES:
        names_text(key, (const int *)(const void *)field,
                   *(const int *)(const void *)((const char *)base + key->aux), text, size);
        break;
    case KEY_COLOR:
        color_text(key, field, text, size);
        break;
    case KEY_RANGE:
        if (*((const bool *)base + key->aux))
            snprintf(text, size, *((const bool *)base + key->aux + 1) ? "symmetric" : "auto");
        else
            snprintf(text, size, "[%.9g, %.9g]", ((const double *)field)[0], ((const double *)field)[1]);
        break;
    case KEY_POINTS:
        points_text(key, (const ControlPoints *)(const void *)field, text, size);
        break;
    case KEY_SETTINGS:
        settings_text(key_text(key, field), text, size);
        break;
    case KEY_MAPPING:
    case KEY_VARIANT:
    case KEY_LIST:
        break;
    }
}
