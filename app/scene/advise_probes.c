/* Warns of sensors finer than the fluid, and of forces that a backend does not sum. */
#include "app/scene/advise_parts.h"
#include "sim/world/backend.h"

static void advise_force(const Tree *tree, int index, const WorldDef *world, Notes *notes)
{
    const Backend *backend = backend_find(world->backend);
    char path[64];
    snprintf(path, sizeof path, "probes[%d].force", index);
    if (backend && !backend->feel)
        advise(tree, path, notes,
               "backend %s sums no forces, so that it has no number; use backend cpu or compute",
               world->backend);
}

void advise_probes(const Tree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *world = &scene->world;
    for (int k = 0; k < scene->probes.count; k++) {
        const ProbeDef *probe = &scene->probes.probe[k];
        const double size = probe_size(probe, world->spacing, world->support);
        char path[64];
        snprintf(path, sizeof path, "probes[%d].size", k);
        if (probe->kind == PROBE_FORCE)
            advise_force(tree, k, world, notes);
        else if (probe->size > 0 && probe->size < size)
            advise(tree, path, notes,
                   "%g m holds too few particles of this spacing; four spacings, %g m, are taken",
                   probe->size, size);
    }
}
