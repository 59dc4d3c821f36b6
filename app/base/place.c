#include "app/base/place.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The folder of the program. */
static bool program_folder(char folder[PLACE_SIZE])
{
    const ssize_t length = readlink("/proc/self/exe", folder, PLACE_SIZE - 1);
    if (length <= 0)
        return false;
    folder[length] = 0;
    char *slash = strrchr(folder, '/');
    if (slash)
        *slash = 0;
    return slash != NULL;
}

/* The absolute path of `name` relative to the program; false if missing. */
static bool beside_program(const char *name, char path[PLACE_SIZE])
{
    char folder[PLACE_SIZE], joined[2 * PLACE_SIZE], whole[PATH_MAX];
    if (!program_folder(folder))
        return false;
    snprintf(joined, sizeof joined, "%s/%s", *name == '/' ? "" : folder, name);
    return realpath(joined, whole) && snprintf(path, PLACE_SIZE, "%s", whole) < PLACE_SIZE;
}

const char *place_sources(void)
{
    static const char build[] = SLOSH_BINARY_DIR;
    const size_t length = strlen(build);
    char folder[PLACE_SIZE];
    const bool within = program_folder(folder) && strncmp(folder, build, length) == 0 &&
                        (folder[length] == 0 || folder[length] == '/');
    return within ? SLOSH_SOURCE_DIR : NULL;
}

bool place_shipped(char folder[PLACE_SIZE])
{
    if (beside_program(SLOSH_SHARED "/scenes", folder)) {
        *strrchr(folder, '/') = 0;
        return true;
    }
    const char *sources = place_sources();
    return sources && snprintf(folder, PLACE_SIZE, "%s", sources) < PLACE_SIZE;
}

bool place_own(char folder[PLACE_SIZE])
{
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    int length = -1;
    if (config && *config == '/') /* XDG base directory specification: relative paths are ignored */
        length = snprintf(folder, PLACE_SIZE, "%s/slosh", config);
    else if (home && *home)
        length = snprintf(folder, PLACE_SIZE, "%s/.config/slosh", home);
    return length > 0 && length < PLACE_SIZE;
}

bool place_rule(char path[PLACE_SIZE])
{
    return beside_program(SLOSH_RULES "/70-slosh.rules", path);
}
