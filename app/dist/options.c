#include "app/dist/options.h"

#include <string.h>

/* Returns the value of `--NAME VALUE` or `--NAME=VALUE` at argv[*at], and moves *at to its last word;
   NULL: another option. A missing value is "". */
static const char *value_of(const char *name, char *argv[], int *at)
{
    const size_t size = strlen(name);
    if (strncmp(argv[*at], name, size) != 0)
        return NULL;
    if (argv[*at][size] == '=')
        return argv[*at] + size + 1;
    if (argv[*at][size])
        return NULL;
    return argv[*at + 1] ? argv[++*at] : "";
}

static bool on_off(const char *name, const char *value, bool *out, Error *error)
{
    *out = strcmp(value, "on") == 0;
    return *out || strcmp(value, "off") == 0 ||
           error_set(error, "slosh-dist: %s takes on or off, not '%s'", name, value);
}

bool dist_options(int *argc, char *argv[], DistOptions *options, Error *error)
{
    int kept = 0;
    *options = (DistOptions){.balance = true};
    for (int k = 0; k < *argc; k++) {
        const char *value = k > 0 ? value_of("--balance", argv, &k) : NULL;
        if (!value)
            argv[kept++] = argv[k];
        else if (!on_off("--balance", value, &options->balance, error))
            return false;
    }
    argv[kept] = NULL;
    *argc = kept;
    return true;
}
