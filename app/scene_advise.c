#include "app/scene_advise.h"

#include <stdarg.h>
#include <stddef.h>
#include <string.h>

/* One check a row; each asks the scene and adds its lines. */
typedef void Advice(const Tree *tree, const Scene *scene, Notes *notes);

static Advice *const advices[] = {NULL};

/* Whether `node`, the nearest to `path`, stands at it. */
static bool stands_at(const Node *node, const char *path)
{
    const char *dot = strrchr(path, '.');
    return node->key && strcmp(node->key, dot ? dot + 1 : path) == 0;
}

void advise(const Tree *tree, const char *path, Notes *notes, const char *format, ...)
{
    char what[NOTE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    const Node *node = tree ? tree_near(tree, path) : NULL;
    if (node && node->said)
        notes_add(notes, "%s: %s", node->said, what);
    else if (node && stands_at(node, path))
        notes_add(notes, "%s:%d:%d: %s", tree->path, node->key_line, node->key_column, what);
    else
        notes_add(notes, "%s%s%s: %s", tree ? tree->path : "", tree ? ": " : "", path, what);
}

void scene_advise(const Tree *tree, const Scene *scene, Notes *notes)
{
    for (Advice *const *advice = advices; *advice; advice++)
        (*advice)(tree, scene, notes);
}
