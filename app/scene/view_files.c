#include "app/scene/view_files.h"

#include "app/scene/check_parts.h"
#include "app/scene/tables.h"
#include "app/volume/volume_kept.h"
#include "app/yaml/yaml.h"
#include "render/frame/view.h"

#include <stdio.h>

/* Context of reading a scene. */
typedef struct Reading {
    Check check;
    const SceneSettings *settings;
    Notes *notes;
} Reading;

/* Reads one file; `view` is the path of the view's keys. */
static bool read_file_of(const Reading *reading, const char *view, const ViewFile *file)
{
    char key[128], path[1200];
    Error why;
    snprintf(key, sizeof key, "%.60s.%.63s", view, file->key);
    if (file->wrong)
        return FAIL(&reading->check, key, "%s", file->wrong);
    const char *scene = reading->check.tree->path;
    const bool recorded = reading->settings->recorded;
    const bool found = recorded
                           ? scene_recorded_path(scene, reading->settings->folder, file->name, path, &why)
                           : scene_beside_path(scene, file->name, path, &why) &&
                                 scene_file_is_there(scene, file->name, path, &why);
    *file->data = found ? volume_kept(path, &why) : NULL;
    if (!*file->data && recorded)
        notes_add(reading->notes, "%s: %.300s; what is of it is left out", key, why.message);
    return *file->data || recorded || FAIL(&reading->check, key, "%s", why.message);
}

static bool read_view(const Reading *reading, const char *view, const ViewDef *def)
{
    const ViewKind *kind;
    for (int i = 0; (kind = view_at(i)); i++) {
        ViewFile files[VIEW_FILES_MAX];
        const int count = kind->files ? kind->files(def, files) : 0;
        for (int k = 0; k < count; k++)
            if (!read_file_of(reading, view, &files[k]))
                return false;
    }
    return true;
}

bool scene_read_view_files(const Tree *tree, const SceneSettings *settings, Scene *scene, Notes *notes,
                           Error *error)
{
    const Reading reading = {{tree, scene, error}, settings, notes};
    for (int i = 0; i < scene->view_count; i++) {
        char view[32];
        snprintf(view, sizeof view, "views[%d]", i);
        if (!read_view(&reading, view, &scene->views[i]))
            return false;
    }
    return read_view(&reading, "view", &scene->view);
}
