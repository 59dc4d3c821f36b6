#include "app/base/path.h"

#include "app/base/picture_text.h"
#include "app/base/place.h"
#include "app/base/suggest.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int scene_path_is_yaml(const struct dirent *entry)
{
    const char *dot = strrchr(entry->d_name, '.');
    return dot && dot != entry->d_name && strcmp(dot, ".yaml") == 0;
}

/* Adds the scene names of a folder. */
static void add_names(SceneNames *names, const char *folder)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, scene_path_is_yaml, alphasort);
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

void scene_path_names(SceneNames *names)
{
    char folder[PLACE_SIZE], scenes[PLACE_SIZE + 8];
    names->count = 0;
    if (!place_shipped(folder))
        return;
    snprintf(scenes, sizeof scenes, "%s/scenes", folder);
    add_names(names, scenes);
}

/* True if the path exists and is not a folder. */
static bool try_path(char path[SCENE_PATH_SIZE], const char *folder, const char *name, const char *ending)
{
    struct stat status;
    const int length = snprintf(path, SCENE_PATH_SIZE, "%s%s%s", folder, name, ending);
    return length < SCENE_PATH_SIZE && stat(path, &status) == 0 && !S_ISDIR(status.st_mode);
}

/* Collects all possible names: scenes of slosh, the user's scenes, scenes in the present folder. */
static void all_names(SceneNames *names)
{
    char folder[PLACE_SIZE], scenes[PLACE_SIZE + 8];
    scene_path_names(names);
    if (place_own(folder)) {
        snprintf(scenes, sizeof scenes, "%s/scenes", folder);
        add_names(names, scenes);
        add_names(names, folder);
    }
    add_names(names, ".");
}

static bool no_file(const char *name, Error *error)
{
    SceneNames names;
    Suggestion near = suggest_for(name);
    char hint[96] = "name a scene file", shipped[PLACE_SIZE], own[PLACE_SIZE];
    all_names(&names);
    for (int i = 0; i < names.count; i++)
        suggest_offer(&near, names.name[i]);
    if (near.best)
        snprintf(hint, sizeof hint, "did you mean '%.60s'?", near.best);
    if (*name == '/')
        return error_set(error, "%.300s: no such file; %s", name, hint);
    const bool has_shipped = place_shipped(shipped), has_own = place_own(own);
    return error_set(error, "%.300s: no such file, neither here%s%.300s%s%s%.300s; %s", name,
                     has_shipped ? " nor in " : "", has_shipped ? shipped : "", has_shipped ? "/scenes" : "",
                     has_own ? " nor in " : "", has_own ? own : "", hint);
}

/* Looks in a folder and in its folder scenes/. */
static bool try_folder(char path[SCENE_PATH_SIZE], const char *folder, const char *name)
{
    char beside[PLACE_SIZE + 2], among[PLACE_SIZE + 16];
    snprintf(beside, sizeof beside, "%s/", folder);
    snprintf(among, sizeof among, "%s/scenes/", folder);
    return try_path(path, beside, name, "") || try_path(path, among, name, "") ||
           try_path(path, among, name, ".yaml") || try_path(path, beside, name, ".yaml");
}

bool scene_path_find(const char *name, char path[SCENE_PATH_SIZE], Error *error)
{
    if (!*name)
        return error_set(error, "the scene's name is empty; name a file such as scenes/box_slosh.yaml");
    if (try_path(path, "", name, ""))
        return true;
    char folder[PLACE_SIZE];
    if (*name != '/' &&
        ((place_shipped(folder) && try_folder(path, folder, name)) ||
         (place_own(folder) && try_folder(path, folder, name)) || try_path(path, "", name, ".yaml")))
        return true;
    const int length = snprintf(path, SCENE_PATH_SIZE, "%s", name);
    return (length < SCENE_PATH_SIZE && access(path, F_OK) == 0) || no_file(name, error);
}

/* Names the command that takes a different file of slosh; NULL: unknown file. */
static const char *taken_by(const char *bytes, size_t size)
{
    static const struct {
        const char *begin, *words;
    } kinds[] = {
        {"slosh recording ",
         "a recorded session, no scene; the window, slosh replay and slosh render take it"},
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

/* The scene embedded in a picture. */
static char *read_picture(const char *path, size_t *size, Error *error)
{
    PictureText text;
    if (!picture_text_read(path, &text, error))
        return NULL;
    *size = text.size;
    return text.scene;
}

/* Reads at most one byte more than the limit, whatever the file size claims; of a picture, the embedded
   scene. */
static char *read_bytes(FILE *file, const char *path, size_t *size, Error *error)
{
    char *bytes = malloc(SCENE_BYTES_MAX + 1);
    if (!bytes) {
        error_set(error, "%s: no memory to read it", path);
        return NULL;
    }
    *size = fread(bytes, 1, SCENE_BYTES_MAX + 1, file);
    const bool failed = ferror(file);
    if (!failed && picture_text_is_png(bytes, *size)) {
        free(bytes);
        return read_picture(path, size, error);
    }
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
