#include "app/scene_path.h"

#include "app/scene.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool try_path(char path[SCENE_PATH_SIZE], const char *folder, const char *name, const char *ending)
{
    const int length = snprintf(path, SCENE_PATH_SIZE, "%s%s%s", folder, name, ending);
    return length < SCENE_PATH_SIZE && access(path, F_OK) == 0;
}

bool scene_path_find(const char *name, char path[SCENE_PATH_SIZE], Error *error)
{
    if (!*name)
        return error_set(error, "the scene's name is empty; name a file such as scenes/box_slosh.yaml");
    if (try_path(path, "", name, ""))
        return true;
    if (*name != '/' && (try_path(path, SLOSH_SOURCE_DIR "/", name, "") ||
                         try_path(path, SLOSH_SOURCE_DIR "/scenes/", name, "") ||
                         try_path(path, SLOSH_SOURCE_DIR "/scenes/", name, ".yaml") ||
                         try_path(path, SLOSH_SOURCE_DIR "/", name, ".yaml")))
        return true;
    if (*name == '/')
        return error_set(error, "%.300s: no such file; name a scene file", name);
    return error_set(error,
                     "%.300s: no such file, neither here nor in %s nor in %s/scenes; name a scene file", name,
                     SLOSH_SOURCE_DIR, SLOSH_SOURCE_DIR);
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
    if (failed)
        error_set(error, "%s: cannot be read (%s)", path, strerror(errno));
    else if (*size > SCENE_BYTES_MAX)
        error_set(error, "%s: larger than 1 MiB; a scene file is a page of YAML", path);
    if (!failed && *size <= SCENE_BYTES_MAX)
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
