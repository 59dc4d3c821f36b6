#include "app/base/path.h"

#include "app/base/suggest.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define SCENES SLOSH_SOURCE_DIR "/scenes"

int scene_path_is_yaml(const struct dirent *entry)
{
    const char *dot = strrchr(entry->d_name, '.');
    return dot && dot != entry->d_name && strcmp(dot, ".yaml") == 0;
}

void scene_path_names(SceneNames *names)
{
    struct dirent **entries;
    const int count = scandir(SCENES, &entries, scene_path_is_yaml, alphasort);
    names->count = 0;
    for (int i = 0; i < count; i++) {
        const char *name = entries[i]->d_name;
        const size_t length = strlen(name) - strlen(".yaml");
        if (names->count < SCENE_NAMES_MAX && length < sizeof names->name[0])
            snprintf(names->name[names->count++], sizeof names->name[0], "%.*s", (int)length, name);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
}

/* Whether the path is there, and as a folder only if that is asked for. */
static bool try_path(char path[SCENE_PATH_SIZE], const char *folder, const char *name, const char *ending)
{
    struct stat status;
    const int length = snprintf(path, SCENE_PATH_SIZE, "%s%s%s", folder, name, ending);
    return length < SCENE_PATH_SIZE && stat(path, &status) == 0 && !S_ISDIR(status.st_mode);
}

static bool no_file(const char *name, Error *error)
{
    SceneNames names;
    Suggestion near = suggest_for(name);
    char hint[96] = "name a scene file";
    scene_path_names(&names);
    for (int i = 0; i < names.count; i++)
        suggest_offer(&near, names.name[i]);
    if (near.best)
        snprintf(hint, sizeof hint, "did you mean '%.60s'?", near.best);
    if (*name == '/')
        return error_set(error, "%.300s: no such file; %s", name, hint);
    return error_set(error, "%.300s: no such file, neither here nor in %s nor in %s; %s", name,
                     SLOSH_SOURCE_DIR, SCENES, hint);
}

bool scene_path_find(const char *name, char path[SCENE_PATH_SIZE], Error *error)
{
    if (!*name)
        return error_set(error, "the scene's name is empty; name a file such as scenes/box_slosh.yaml");
    if (try_path(path, "", name, ""))
        return true;
    if (*name != '/' &&
        (try_path(path, SLOSH_SOURCE_DIR "/", name, "") || try_path(path, SCENES "/", name, "") ||
         try_path(path, SCENES "/", name, ".yaml") || try_path(path, SLOSH_SOURCE_DIR "/", name, ".yaml")))
        return true;
    const int length = snprintf(path, SCENE_PATH_SIZE, "%s", name);
    return (length < SCENE_PATH_SIZE && access(path, F_OK) == 0) || no_file(name, error);
}

/* Which command takes the file that is no scene but another one of slosh's; NULL: it is none of these. */
static const char *taken_by(const char *bytes, size_t size)
{
    static const struct {
        const char *begin, *words;
    } kinds[] = {
        {"slosh recording ", "a recorded session, no scene; slosh replay and slosh render take it"},
        {"slosh device recording ", "a recording of motion devices, no scene; --device file:PATH takes it"},
        {"\x89HDF\r\n\x1a\n",
         "a file of snapshots, no scene; slosh play, slosh render and slosh export take it, and slosh run goes on with one by -o and "
         "--resume"},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (size >= strlen(kinds[i].begin) && memcmp(bytes, kinds[i].begin, strlen(kinds[i].begin)) == 0)
            return kinds[i].words;
    return NULL;
}

/* At most one byte more than is allowed, whatever the file claims to be. */
static char *read_bytes(FILE *file, const char *path, size_t *size, Error *error)
{
    char *bytes = malloc(SCENE_BYTES_MAX + 1);
    if (!bytes) {
        error_set(error, "%s: no memory to read it", path);
        return NULL;
    }
    *size = fread(bytes, 1, SCENE_BYTES_MAX + 1, file);
    const bool failed = ferror(file);
    const char *other = failed ? NULL : taken_by(bytes, *size);
    if (other)
        error_set(error, "%s: %s", path, other);
    else if (failed)
        error_set(error, "%s: cannot be read (%s)", path, strerror(errno));
    else if (*size > SCENE_BYTES_MAX)
        error_set(error, "%s: larger than 1 MiB; a scene file is a page of YAML", path);
    if (!failed && !other && *size <= SCENE_BYTES_MAX)
        return bytes;
    free(bytes);
    return NULL;
}

char *scene_file_read(const char *path, size_t *size, Error *error)
{
    struct stat status;
    if (stat(path, &status) == 0 && S_ISDIR(status.st_mode)) {
        error_set(error, "%s: a directory; name a scene file in it", path);
        return NULL;
    }
    FILE *file = fopen(path, "rb");
    if (!file) {
        error_set(error, "%s: cannot be opened (%s)", path, strerror(errno));
        return NULL;
    }
    char *bytes = read_bytes(file, path, size, error);
    fclose(file);
    return bytes;
}
