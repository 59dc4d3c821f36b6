#include "app/scene/advise_parts.h"

#include "app/scene/keys.h"
#include "render/frame/view.h"
#include "sim/world/method.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 256 };

static Advice *const advices[] = {advise_fills, advise_step,     advise_places, advise_method, advise_sound,
                                  advise_borne, advise_cohesion, advise_slip,   advise_probes, advise_solids,
                                  NULL};

void advise(const Tree *tree, const char *path, Notes *notes, const char *format, ...)
{
    char what[NOTE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    const Node *node = tree ? tree_near(tree, path) : NULL;
    if (node && node->said)
        notes_add(notes, "%.100s%s: %s", node->said, strlen(node->said) > 100 ? "..." : "", what);
    else if (node && tree_at(tree, path))
        notes_add(notes, "%s:%d:%d: %s", tree->path, node->key_line, node->key_column, what);
    else
        notes_add(notes, "%s%s%s: %s", tree ? tree->path : "", tree ? ": " : "", path, what);
}

enum { NEED_SIZE = 128 };

/* True for solver.sound_speed if the scene's method has no sound; `need` gets the methods that read it. */
static bool lacks_sound(const Scene *scene, const char *path, char need[NEED_SIZE])
{
    const Method *own = method_find(scene->world.method);
    int used = 0;
    if (strcmp(path, "solver.sound_speed") != 0 || !own->incompressible ||
        (own->asks_sound && own->asks_sound(&scene->world)))
        return false;
    for (const Method *const *method = method_list(); *method && used < NEED_SIZE; method++)
        if (!(*method)->incompressible)
            used += snprintf(need + used, (size_t)(NEED_SIZE - used), "%s%s",
                             used > 0 ? " or " : "solver.method: ", (*method)->name);
    return true;
}

/* Flag of ViewKind.curves for a key of opacities or sizes; 0 for other keys. */
static unsigned curve_of(const char *path)
{
    return strncmp(path, "view.opacity.", strlen("view.opacity.")) == 0 ? VIEW_OPACITY
           : strncmp(path, "view.size.", strlen("view.size.")) == 0     ? VIEW_SIZE
                                                                        : 0;
}

static void views_that_draw(unsigned curve, char need[NEED_SIZE])
{
    int length = 0;
    for (int i = 0; view_at(i) && length < NEED_SIZE; i++)
        if (view_at(i)->curves & curve)
            length += snprintf(need + length, (size_t)(NEED_SIZE - length), "%s%s",
                               length > 0 ? " or " : "view.kind: ", view_at(i)->name);
}

/* True if the view does not use sizes or opacities of particles, as set by the key. */
static bool lacks_view(const Scene *scene, const char *path, bool said, char need[NEED_SIZE])
{
    const unsigned curve = curve_of(path);
    const ViewKind *kind = view_find(scene->view.kind);
    if (!curve || !said)
        return false;
    if (!kind || !(kind->curves & curve)) {
        views_that_draw(curve, need);
        return true;
    }
    if (!kind->curves_where || key_owner_used(kind->curves_where, scene, said))
        return false;
    key_owner_need(kind->curves_where, need, NEED_SIZE);
    return true;
}

static bool lacks_in_views(const Scene *scene, const char *path, bool said, char need[NEED_SIZE]);

/* True if the key at `path` has no effect; `need` gets the missing condition. */
static bool lacks(const Scene *scene, const char *path, bool said, char need[NEED_SIZE])
{
    const Key *key = scene_key_find(path);
    const KeyOwner *owner = key ? key_owner(key) : NULL;
    if (key && key_list_like(path))
        return lacks_in_views(scene, path, said, need);
    if (lacks_sound(scene, path, need) || lacks_view(scene, path, said, need))
        return true;
    if (!owner || key_owner_used(owner, scene, said))
        return false;
    key_owner_need(owner, need, NEED_SIZE);
    return true;
}

/* Treats an entry of views as the scene's only view. */
static bool lacks_in_views(const Scene *scene, const char *path, bool said, char need[NEED_SIZE])
{
    const int index = (int)strtol(strchr(path, '[') + 1, NULL, 10);
    char own[PATH_SIZE], text[NEED_SIZE];
    Scene one = *scene;
    one.view = *scene_view(scene, index);
    snprintf(own, sizeof own, "view%.200s", strchr(path, ']') + 1);
    if (!lacks(&one, own, said, text))
        return false;
    const char *view = strstr(text, "view.");
    if (view)
        snprintf(need, NEED_SIZE, "%.*sviews[%d]%.100s", (int)(view - text), text, index,
                 view + strlen("view"));
    else
        snprintf(need, NEED_SIZE, "%s", text);
    return true;
}

#define NO_EFFECT "%s has no effect; it needs %s"

void scene_unused(const Scene *scene, const char *path, Notes *notes)
{
    char need[NEED_SIZE];
    if (lacks(scene, path, true, need))
        notes_add(notes, NO_EFFECT, path, need);
}

/* Visits each key with a value; paths are as people write them. */
static void walk(const Tree *tree, const Node *node, const char *path, const Scene *scene, Notes *notes)
{
    int index = 0;
    for (const Node *child = node->first; child; child = child->next, index++) {
        char below[PATH_SIZE];
        if (child->key)
            snprintf(below, sizeof below, "%.180s%s%.60s", path, *path ? "." : "", child->key);
        else
            snprintf(below, sizeof below, "%.180s[%d]", path, index);
        const Key *key = scene_key_find(below);
        char need[NEED_SIZE];
        if (!key || key->type == KEY_MAPPING || key->type == KEY_LIST || key->type == KEY_VARIANT)
            walk(tree, child, below, scene, notes);
        else if (lacks(scene, below, child->said != NULL, need))
            advise(tree, below, notes, NO_EFFECT, below, need);
    }
}

void scene_advise_unused(const Tree *tree, const Scene *scene, Notes *notes)
{
    walk(tree, tree->root, "", scene, notes);
    if (notes)
        notes->lasting = notes->count;
}

void scene_advise(const Tree *tree, const Scene *scene, Notes *notes)
{
    for (Advice *const *advice = advices; *advice; advice++)
        (*advice)(tree, scene, notes);
}
