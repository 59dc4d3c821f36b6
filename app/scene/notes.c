/* Notes for the user of a scene, with the place of a setting. */
#include "app/scene/scene_private.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool notes_have(const Notes *notes, const char *line)
{
    for (int i = 0; i < notes->count; i++)
        if (strcmp(notes->line[i], line) == 0)
            return true;
    return false;
}

void notes_add(Notes *notes, const char *format, ...)
{
    char line[NOTE_SIZE];
    va_list arguments;
    if (!notes)
        return;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    text_tame(line);
    if (notes_have(notes, line))
        return;
    if (notes->count < NOTES_MAX)
        memcpy(notes->line[notes->count++], line, sizeof line);
    else
        snprintf(notes->line[NOTES_MAX - 1], NOTE_SIZE,
                 "there is more to say of this scene; mend the above first");
}

void advise(const YamlTree *tree, const char *path, Notes *notes, const char *format, ...)
{
    char what[NOTE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    const YamlNode *node = tree ? tree_nearest(tree, path) : NULL;
    if (node && node->said)
        notes_add(notes, "%.100s%s: %s", node->said, strlen(node->said) > 100 ? "..." : "", what);
    else if (node && tree_at(tree, path))
        notes_add(notes, "%s:%d:%d: %s", tree->path, node->key_line, node->key_column, what);
    else
        notes_add(notes, "%s%s%s: %s", tree ? tree->path : "", tree ? ": " : "", path, what);
}
