#define _GNU_SOURCE /* asprintf */
#include "app/setting/differ.h"

#include "app/scene/keys.h"
#include "app/yaml/print.h"
#include "sim/base/color.h"
#include "sim/base/time_table.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH = DIFFER_PATH_SIZE, VALUE = TIME_TABLE_ROWS * 48 };

/* Where a walk through two scenes stands: as that of scene_print. */
typedef struct Walk {
    char parent[PATH], shown[PATH];
    const char *before; /* NULL: it has none of this; all is said */
    const char *now;
    Differ *out;
} Walk;

/* ---- values ---- */

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

/* As key_value_text, but it is read as the same value. A plane scene's box has no depth of its own. */
static void exact_text(const Key *key, const char *base, int dimensions, char *text, size_t size)
{
    const void *field = base + key->offset;
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

/* ---- the walk ---- */

static void walk_children(const Walk *walk, int dimensions);

static void add(const Walk *walk, const Key *key, const char *shown, const char *value)
{
    static const char *const of_machine[] = {"solver.threads", "solver.simd"};
    char *setting = NULL;
    if (asprintf(&setting, "%s=%s", shown, value) < 0)
        setting = NULL;
    if (setting)
        setting_list_add(&walk->out->settings, setting);
    walk->out->settings.lacks |= !setting;
    free(setting);
    const bool idle = key->flags & KEY_IDLE;
    bool machine = false;
    for (size_t i = 0; i < sizeof of_machine / sizeof *of_machine; i++)
        machine |= strcmp(key->path, of_machine[i]) == 0;
    walk->out->world |= !idle && !machine;
    walk->out->dead |= !(key->flags & KEY_LIVE) && (!idle || machine);
}

static void built_anew(const Walk *walk, const Key *key, const char *shown)
{
    walk->out->dead |= !(key->flags & KEY_IDLE);
    walk->out->world |= !(key->flags & KEY_IDLE);
    if (!*walk->out->built)
        snprintf(walk->out->built, PATH, "%s", shown);
}

static void walk_element(const Key *list, const Walk *walk, const char *shown, int e, int before,
                         int dimensions)
{
    const KeyLike *like = key_like(list);
    const size_t at = list->offset + (size_t)e * list->size - (like ? like->at : 0);
    Walk inner = {.now = walk->now + at, .out = walk->out, .before = walk->before};
    if (e < before)
        inner.before = walk->before + at;
    snprintf(inner.parent, PATH, "%.120s%s", like ? like->mapping : list->path, like ? "" : "[]");
    snprintf(inner.shown, PATH, "%.110s[%d]", shown, e);
    walk_children(&inner, dimensions);
}

static void walk_list(const Key *list, const Walk *walk, const char *shown, int dimensions)
{
    const KeyLike *like = key_like(list);
    const int now = *(const int *)(walk->now + list->aux);
    int before = walk->before ? *(const int *)(walk->before + list->aux) : 0;
    if (now == 0 && before > 0 && list->min == 0) {
        add(walk, list, shown, "[]");
        return;
    }
    if (now != before && !like) {
        built_anew(walk, list, shown);
        return;
    }
    if (now < before) { /* of views: all are said anew */
        add(walk, list, shown, "[]");
        before = 0;
    }
    for (int e = 0; e < now; e++) {
        const int said = walk->out->settings.count;
        walk_element(list, walk, shown, e, before, dimensions);
        char whole[PATH];
        snprintf(whole, sizeof whole, "%.110s[%d]", shown, e);
        if (e >= before && walk->out->settings.count == said) /* one that differs in nothing */
            add(walk, list, whole, "{}");
    }
}

static bool is_absent(const Key *key, const char *base)
{
    if (!base)
        return true;
    if (key->type == KEY_VARIANT)
        return *(const int *)(base + key->aux) != key->variant;
    return key->aux != KEY_NOWHERE && *(const bool *)(base + key->aux);
}

static void walk_mapping(const Key *key, const Walk *walk, const char *shown, int dimensions)
{
    const bool was = !is_absent(key, walk->before), is = !is_absent(key, walk->now);
    Walk inner = {.before = was ? walk->before : NULL, .now = walk->now, .out = walk->out};
    if (was != is && key->type == KEY_VARIANT) {
        built_anew(walk, key, shown);
        return;
    }
    if (was && !is)
        add(walk, key, shown, "");
    snprintf(inner.parent, PATH, "%s", key->path);
    snprintf(inner.shown, PATH, "%s", shown);
    if (is)
        walk_children(&inner, dimensions);
}

static void walk_key(const Key *key, const Walk *walk, const char *shown, int dimensions)
{
    char now[VALUE], before[VALUE];
    if (key->type == KEY_LIST) {
        walk_list(key, walk, shown, dimensions);
    } else if (key->type == KEY_MAPPING || key->type == KEY_VARIANT) {
        walk_mapping(key, walk, shown, dimensions);
    } else {
        exact_text(key, walk->now, dimensions, now, sizeof now);
        if (walk->before)
            exact_text(key, walk->before, dimensions, before, sizeof before);
        if ((!walk->before || strcmp(now, before) != 0) && (*now || walk->before))
            add(walk, key, shown, now);
    }
}

static void walk_children(const Walk *walk, int dimensions)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        const char *name = key_name_in(&keys[i], walk->parent);
        char shown[PATH];
        if (!name)
            continue;
        snprintf(shown, sizeof shown, "%.80s%s%.40s", walk->shown, *walk->shown ? "." : "", name);
        walk_key(&keys[i], walk, shown, dimensions);
    }
}

void scene_differ(const Scene *before, const Scene *now, Differ *out)
{
    *out = (Differ){.world = false};
    const Walk walk = {.before = (const char *)before, .now = (const char *)now, .out = out};
    walk_children(&walk, now->world.dimensions);
    if (before->world.dimensions != now->world.dimensions)
        built_anew(&walk, scene_key_find("box.size"), "box.size");
}

void differ_words(const SettingList *settings, char *text, size_t size)
{
    enum { SAID = 4 };
    size_t used = 0;
    *text = 0;
    for (int i = 0; i < settings->count && i < SAID && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%.*s",
                                 i == 0                     ? ""
                                 : i + 1 == settings->count ? " and "
                                                            : ", ",
                                 (int)strcspn(settings->set[i], "="), settings->set[i]);
    if (settings->count > SAID && used < size)
        snprintf(text + used, size - used, " and %d more", settings->count - SAID);
}
