#include "app/setting/exact.h"

#include "app/scene/keys.h"
#include "app/yaml/print.h"
#include "sim/base/color.h"
#include "sim/base/time_table.h"

#include <stdlib.h>
#include <string.h>

_Static_assert(EXACT_SIZE >= TIME_TABLE_ROWS * 48, "a curve has no room");

static int exact_number(double value, char *text, size_t size)
{
    char digits[40];
    snprintf(digits, sizeof digits, "%.9g", value);
    if (strtod(digits, NULL) != value)
        snprintf(digits, sizeof digits, "%.17g", value);
    return snprintf(text, size, "%s", digits);
}

static void exact_numbers(const double *values, int count, char *text, size_t size)
{
    int used = snprintf(text, size, "[");
    for (int k = 0; k < count; k++) {
        used += exact_number(values[k], text + used, size - (size_t)used);
        used += snprintf(text + used, size - (size_t)used, k + 1 < count ? ", " : "]");
    }
}

static void exact_color(const Key *key, const void *field, char *text, size_t size)
{
    double color[3];
    for (int k = 0; k < 3; k++)
        color[k] =
            linear_to_srgb(key->flags & KEY_SINGLE ? ((const float *)field)[k] : ((const double *)field)[k]);
    snprintf(text, size, "[%.9g, %.9g, %.9g]", color[0], color[1], color[2]);
}

static void quoted(const char *words, char *text, size_t size)
{
    const Node node = {.kind = NODE_SCALAR, .text = words};
    FILE *file = fmemopen(text, size, "w");
    *text = 0;
    if (!file)
        return;
    node_print(&node, file);
    fclose(file);
}

/* The box of a two-dimensional scene has no depth of its own. */
void exact_text(const Key *key, const void *base, int dimensions, char *text, size_t size)
{
    const void *field = (const char *)base + key->offset;
    const bool plane = dimensions == 2 && strcmp(key->path, "box.size") == 0;
    key_value_text(key, base, text, size);
    if (key->offset == KEY_NOWHERE)
        return;
    if (key->type == KEY_NUMBER || (key->type == KEY_CURVE && *text != '['))
        exact_number(*(const double *)field, text, size);
    else if (key->type == KEY_VEC3 || (key->type == KEY_RANGE && *text == '['))
        exact_numbers(field, key->type == KEY_RANGE || plane ? 2 : 3, text, size);
    else if (key->type == KEY_COLOR)
        exact_color(key, field, text, size);
    else if (key->type == KEY_TEXT && *text)
        quoted(field, text, size);
}

/* ---- lists ---- */

/* Position of a walk through an element. */
typedef struct Within {
    const char *base, *like; /* the element; a default element */
    int dimensions;
    FILE *file;
    int said; /* count of keys written in the present mapping */
} Within;

static void say_children(Within *within, const char *parent);

static void say_name(Within *within, const char *name)
{
    fprintf(within->file, "%s%s: ", within->said++ > 0 ? ", " : "", name);
}

static void say_mapping(Within *within, const Key *key, const char *name)
{
    char *words = NULL;
    size_t size = 0;
    Within inner = *within;
    inner.said = 0;
    inner.file = open_memstream(&words, &size);
    if (!inner.file)
        return;
    say_children(&inner, key->path);
    if (fclose(inner.file) == 0 && (inner.said > 0 || key->type == KEY_VARIANT)) {
        say_name(within, name);
        fprintf(within->file, "{%s}", words);
    }
    free(words);
}

static void say_value(Within *within, const Key *key, const char *name)
{
    char text[EXACT_SIZE], usual[EXACT_SIZE];
    exact_text(key, within->base, within->dimensions, text, sizeof text);
    exact_text(key, within->like, within->dimensions, usual, sizeof usual);
    if (!*text || (!(key->flags & KEY_REQUIRED) && strcmp(text, usual) == 0))
        return;
    say_name(within, name);
    fputs(text, within->file);
}

bool exact_is_there(const Key *key, const char *base)
{
    if (key->type == KEY_VARIANT)
        return *(const int *)(const void *)(base + key->aux) == key->variant;
    return key->aux == KEY_NOWHERE || !*(const bool *)(base + key->aux);
}

static void say_children(Within *within, const char *parent)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        const Key *key = &keys[i];
        const char *name = key_name_in(key, parent);
        if (!name)
            continue;
        if (key->type == KEY_LIST) {
            if (*(const int *)(const void *)(within->base + key->aux) == 0)
                continue;
            say_name(within, name);
            exact_list(key, within->base, within->dimensions, within->file);
        } else if (key->type != KEY_MAPPING && key->type != KEY_VARIANT) {
            say_value(within, key, name);
        } else if (exact_is_there(key, within->base)) {
            say_mapping(within, key, name);
        }
    }
}

void exact_list(const Key *list, const void *base, int dimensions, FILE *file)
{
    const int count = *(const int *)(const void *)((const char *)base + list->aux);
    char parent[128];
    snprintf(parent, sizeof parent, "%.120s[]", list->path);
    fputc('[', file);
    for (int e = 0; e < count; e++) {
        char *usual = calloc(1, list->size);
        Within within = {.base = (const char *)base + list->offset + (size_t)e * list->size,
                         .like = usual,
                         .dimensions = dimensions,
                         .file = file};
        if (usual && list->init)
            list->init(usual, e);
        fputs(e > 0 ? ", {" : "{", file);
        if (usual)
            say_children(&within, parent);
        fputc('}', file);
        free(usual);
    }
    fputc(']', file);
}
