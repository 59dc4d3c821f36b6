#define _GNU_SOURCE /* asprintf */
#include "app/setting/differ.h"

#include "app/scene/keys.h"
#include "app/setting/exact.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH = DIFFER_PATH_SIZE };

/* Position of a walk through two scenes, like the walk of scene_print. */
typedef struct Walk {
    char parent[PATH], shown[PATH];
    const char *before; /* NULL: absent before; all is written */
    const char *now;
    Differ *out;
} Walk;

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

static bool is_absent(const Key *key, const char *base)
{
    return !base || !exact_is_there(key, base);
}

/* True if the elements in both scenes have the same kinds. */
static bool same_kinds(const Key *list, const Walk *walk, int elements)
{
    char parent[PATH];
    int count;
    const Key *keys = scene_keys(&count);
    bool same = true;
    snprintf(parent, sizeof parent, "%.120s[]", list->path);
    for (int i = 0; i < count; i++)
        for (int e = 0; e < elements && keys[i].type == KEY_VARIANT && key_name_in(&keys[i], parent); e++) {
            const size_t at = list->offset + (size_t)e * list->size;
            same &= is_absent(&keys[i], walk->before + at) == is_absent(&keys[i], walk->now + at);
        }
    return same;
}

static void add_whole(const Walk *walk, const Key *list, const char *shown, int dimensions)
{
    char *value = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&value, &size);
    if (file)
        exact_list(list, walk->now, dimensions, file);
    if (file && fclose(file) == 0 && value)
        add(walk, list, shown, value);
    else
        walk->out->settings.lacks = true;
    free(value);
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
    if (!like && (now != before || !same_kinds(list, walk, now))) {
        add_whole(walk, list, shown, dimensions);
        return;
    }
    if (now < before) { /* fewer views than before: all are written again */
        add(walk, list, shown, "[]");
        before = 0;
    }
    for (int e = 0; e < now; e++) {
        const int said = walk->out->settings.count;
        walk_element(list, walk, shown, e, before, dimensions);
        char whole[PATH];
        snprintf(whole, sizeof whole, "%.110s[%d]", shown, e);
        if (e >= before && walk->out->settings.count == said) /* an element without differences */
            add(walk, list, whole, "{}");
    }
}

static void walk_mapping(const Key *key, const Walk *walk, const char *shown, int dimensions)
{
    const bool was = !is_absent(key, walk->before), is = !is_absent(key, walk->now);
    Walk inner = {.before = was ? walk->before : NULL, .now = walk->now, .out = walk->out};
    if (was && !is)
        add(walk, key, shown, "");
    snprintf(inner.parent, PATH, "%s", key->path);
    snprintf(inner.shown, PATH, "%s", shown);
    if (is)
        walk_children(&inner, dimensions);
}

static void walk_key(const Key *key, const Walk *walk, const char *shown, int dimensions)
{
    char now[EXACT_SIZE], before[EXACT_SIZE];
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
    const bool depth = before->world.dimensions != now->world.dimensions;
    *out = (Differ){.depth = depth, .world = depth, .dead = depth};
    const Walk walk = {.before = (const char *)before, .now = (const char *)now, .out = out};
    walk_children(&walk, now->world.dimensions);
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
