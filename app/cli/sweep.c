#include "app/cli/cli_private.h"

#include <stdlib.h>
#include <string.h>

size_t sweeps_combinations(const Sweep sweeps[], int count)
{
    size_t combinations = 1;
    for (int i = 0; i < count; i++)
        combinations *= (size_t)sweeps[i].count;
    return combinations;
}

const char *sweeps_value(const Sweep sweeps[], int count, int which, size_t combination)
{
    for (int i = count - 1; i > which; i--)
        combination /= (size_t)sweeps[i].count;
    return sweeps[which].values[combination % (size_t)sweeps[which].count];
}

const char *sweep_typed(const Sweep *sweep)
{
    return sweep->typed ? sweep->typed : sweep->key;
}

void sweeps_name(const Sweep sweeps[], int count, size_t combination, const char *equals, char *name,
                 size_t size)
{
    size_t used = 0;
    snprintf(name, size, "%s", "");
    for (int i = 0; i < count && used < size; i++)
        used += (size_t)snprintf(name + used, size - used, "%s%s%s%s", i ? ", " : "", sweep_typed(&sweeps[i]),
                                 equals, sweeps_value(sweeps, count, i, combination));
}

bool sweep_set(const char *key, const char *value, const char *option, char said[SWEEP_SAID],
               SceneSettings *settings, Error *error)
{
    if (strcmp(key, "particles") == 0) {
        settings->particles = (size_t)strtod(value, NULL); /* 2e3, too: args.c has looked at it */
        return true;
    }
    snprintf(said, SWEEP_SAID, "%s %s=%s", option, key, value);
    return scene_settings_add(settings, said, said + strlen(option) + 1, error);
}
