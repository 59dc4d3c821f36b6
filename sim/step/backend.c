/* List of the backends and queries over the list. */
#include "sim/step/backend.h"

#include <assert.h>
#include <stdint.h>
#include <string.h>

static const Backend *backends[BACKENDS_MAX + 1] = {&backend_cpu};

static int backend_index(const Backend *backend)
{
    int at = 0;
    while (backends[at] && backends[at] != backend)
        at++;
    return at;
}

void backend_add(const Backend *backend)
{
    const int at = backend_index(backend);
    assert(at < BACKENDS_MAX && backend->def_size <= BACKEND_DEF_SIZE);
    backends[at] = backend;
}

const Backend *const *backend_list(void)
{
    return backends;
}

const Backend *backend_find(const char *name)
{
    for (int i = 0; backends[i]; i++)
        if (strcmp(backends[i]->name, name) == 0)
            return backends[i];
    return NULL;
}

int *world_threads(const WorldDef *def)
{
    return backend_find("cpu")->threads(def);
}

void *backend_def(const WorldDef *def, const Backend *backend)
{
    const int at = backend_index(backend);
    return backends[at] ? (void *)(uintptr_t)&def->of_backend[at] : NULL;
}

void backends_default(WorldDef *def)
{
    for (int i = 0; backends[i]; i++)
        if (backends[i]->def)
            memcpy(&def->of_backend[i], backends[i]->def, backends[i]->def_size);
}
