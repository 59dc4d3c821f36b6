#include "app/shelf/scene_list.h"

#include "app/scene/yaml/yaml.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Returns the end of a sentence within `length` bytes: after a full stop followed by a space, or `length`. */
static size_t sentence_end(const char *text, size_t length)
{
    for (size_t i = 0; i + 1 < length; i++)
        if (text[i] == '.' && text[i + 1] == ' ')
            return i + 1;
    return length;
}

void scene_idea(const char *text, size_t size, char idea[256])
{
    size_t used = 0;
    const char *end = text + size;
    while (text < end && *text == '#' && used < 255) {
        const char *line = text + 1;
        const char *stop = memchr(text, '\n', (size_t)(end - text));
        text = stop ? stop + 1 : end;
        while (line < end && *line == ' ')
            line++;
        const size_t length = stop && stop > line ? (size_t)(stop - line) : stop ? 0 : (size_t)(end - line);
        if (length == 0)
            break;
        used += (size_t)snprintf(idea + used, 256 - used, "%s%.*s", used ? " " : "", (int)length, line);
        used = used < 255 ? used : 255;
    }
    idea[sentence_end(idea, used)] = 0;
    text_tame(idea); /* of a comment, which YAML does not look at */
}

static void read_words(SceneRow *row)
{
    Error none;
    size_t size;
    char *text = scene_file_read(row->path, &size, &none);
    YamlTree tree = {.path = row->path};
    snprintf(row->title, sizeof row->title, "%s", row->name);
    text_tame(row->title);
    *row->idea = 0;
    if (!text)
        return;
    scene_idea(text, size, row->idea);
    const YamlNode *title =
        tree_read(&tree, row->path, text, size, &none) ? node_child(tree.root, "title") : NULL;
    if (title && title->kind == NODE_SCALAR && title->text)
        snprintf(row->title, sizeof row->title, "%s", title->text);
    tree_free(&tree);
    free(text);
}

/* Returns false if the path is too long. */
static bool fill_row(SceneRow *row, const char *folder, const char *file)
{
    const int length = snprintf(row->path, sizeof row->path, "%s/%s", folder, file);
    snprintf(row->name, sizeof row->name, "%.*s", (int)(strlen(file) - strlen(".yaml")), file);
    if (length >= (int)sizeof row->path)
        return false;
    read_words(row);
    return true;
}

static bool read_folder(const char *folder, SceneList *list, Error *error)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, scene_path_is_yaml, alphasort);
    if (count < 0)
        return error_set(error, "%.300s: %s", folder, strerror(errno));
    list->rows = calloc((size_t)count + 1, sizeof *list->rows);
    for (int i = 0; i < count; i++) {
        if (list->rows && fill_row(&list->rows[list->count], folder, entries[i]->d_name))
            list->count++;
        free(entries[i]);
    }
    free(entries);
    return list->count > 0 || error_set(error,
                                        list->rows ? "%.300s: no scene (*.yaml) is there"
                                                   : "%.300s: no memory for the list of scenes",
                                        folder);
}

static bool read_own(SceneList *list, Error *error)
{
    SceneNames names;
    scene_path_names(&names);
    list->rows = calloc((size_t)names.count + 1, sizeof *list->rows);
    if (!list->rows)
        return error_set(error, "no memory for the list of scenes");
    for (int i = 0; i < names.count; i++) {
        SceneRow *row = &list->rows[list->count];
        if (!scene_path_find(names.name[i], row->path, error))
            continue;
        snprintf(row->name, sizeof row->name, "%s", names.name[i]);
        read_words(row);
        list->count++;
    }
    return list->count > 0 || error_set(error, "the scenes that come with slosh are not there");
}

bool scene_list_read(const char *folder, SceneList *list, Error *error)
{
    *list = (SceneList){.count = 0};
    if (folder ? read_folder(folder, list, error) : read_own(list, error))
        return true;
    scene_list_free(list);
    return false;
}

void scene_list_free(SceneList *list)
{
    free(list->rows);
    *list = (SceneList){.count = 0};
}
