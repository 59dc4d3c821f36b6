#include "app/beside/beside.h"

#include "app/scene/scene_files.h"
#include "render/renderer.h"
#include "sim/gl/particle_buffers.h"
#include "sim/matter/flow.h"
#include "sim/matter/seed.h"
#include "sim/world/column.h"
#include "sim/world/world.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

bool beside_is(const ViewDef *view)
{
    return *view->file || *view->set;
}

bool beside_same(const ViewDef *a, const ViewDef *b)
{
    return strcmp(a->file, b->file) == 0 && strcmp(a->set, b->set) == 0;
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

void beside_words(const ViewDef *view, char words[BESIDE_WORDS])
{
    size_t used = 0;
    snprintf(words, BESIDE_WORDS, "%.150s", name_of(view->file));
    for (const char *line = view->set; *line && used < BESIDE_WORDS;) {
        const int length = (int)strcspn(line, "\n"), path = (int)strcspn(line, "=");
        used += (size_t)snprintf(words + used, BESIDE_WORDS - used, "%s%.*s %.*s", used ? ", " : "", path,
                                 line, length - path - 1, line + path + 1);
        line += length + (line[length] != 0);
    }
}

bool beside_settings(const SceneSettings *base, const ViewDef *view, int entry, BesideSettings *out,
                     Error *error)
{
    SceneSettings *settings = &out->settings;
    *settings = base ? *base : (SceneSettings){.count = 0};
    snprintf(out->set, sizeof out->set, "%s", view->set);
    settings->beside = view->set;
    char *rest = out->set;
    for (char *line = strtok_r(out->set, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        const int at = settings->count;
        if (at == SCENE_SETTINGS_MAX)
            return error_set(error, "more than %d settings; write them into the scene file",
                             SCENE_SETTINGS_MAX);
        snprintf(out->said[at], sizeof out->said[at], "views[%d].set %.150s", entry, line);
        settings->set[at] = line;
        settings->said[at] = out->said[at];
        settings->count++;
    }
    return true;
}

/* Scalars depending on the method's columns; births come from ids. */
enum { OWN_SCALARS = (PARTICLE_SCALAR(SCALAR_STATE_COUNT) - 1) & ~PARTICLE_SCALAR(SCALAR_BORN) };

unsigned beside_simulated_attributes(const WorldDef *def)
{
    WorldDef could = *def;
    could.acceleration = true;
    return renderer_attributes(NULL) & (columns_scalars(&could) | ~(unsigned)OWN_SCALARS);
}

size_t beside_simulated_room(const WorldDef *def)
{
    WorldDef could = *def;
    could.pours = true;
    return flow_capacity(&could, seed_count(def, def->spacing));
}

bool beside_simulated_has(const WorldDef *def, const ViewDef *view, Error *error)
{
    const unsigned reads = renderer_attributes(view) & OWN_SCALARS;
    WorldDef could = *def;
    could.acceleration = true;
    const unsigned beside = reads & ~columns_scalars(&could); /* accelerations */
    could.acceleration = world_can(&could, error);
    const unsigned lacks = reads & ~columns_scalars(&could);
    if (lacks && !beside)
        return false; /* the error of world_can */
    return lacks == 0 || error_set(error, "method %s keeps no such scalar", could.method);
}

static bool blame(int entry, Error *error)
{
    const Error why = *error;
    return error_set(error, "views[%d].file: %s", entry, why.message);
}

/* True if only the name relative to the working directory exists, as in --set; scene files mean a name
   beside the scene. */
static bool is_elsewhere(const char *path, const char *name)
{
    return strcmp(path, name) != 0 && access(path, F_OK) != 0 && access(name, F_OK) == 0;
}

bool beside_open_file(const char *scene, const ViewDef *view, int entry, Recorded *out, Notes *notes,
                      Error *error)
{
    char path[1200];
    Notes own = {.count = 0};
    if (!scene_relative_path(scene, view->file, path, error))
        return blame(entry, error);
    if (is_elsewhere(path, view->file))
        return error_set(error,
                         "views[%d].file: %.300s is not there: it is found from the scene's folder, not from "
                         "the present one, where there is a %.300s; write its whole path",
                         entry, path, view->file);
    if (!recorded_is_file(path))
        return error_set(error,
                         "views[%d].file: %.300s is no recorded run; name one of `slosh run`, *.h5part",
                         entry, path);
    if (!recorded_open(path, NULL, out, &own, error))
        return blame(entry, error);
    for (int i = 0; i < own.count; i++)
        notes_add(notes, "%s", own.line[i]);
    if (recorded_has(out, view, error))
        return true;
    recorded_close(out);
    return blame(entry, error);
}
