/* Sensors that are finer than the fluid. */
#include "app/scene/advise_parts.h"

void advise_probes(const Tree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *world = &scene->world;
    for (int k = 0; k < scene->probes.count; k++) {
        const ProbeDef *probe = &scene->probes.probe[k];
        const double size = probe_size(probe, world->spacing, world->support);
        char path[64];
        snprintf(path, sizeof path, "probes[%d].size", k);
        if (probe->size > 0 && probe->size < size)
            advise(tree, path, notes,
                   "%g m holds too few particles of this spacing; four spacings, %g m, are taken",
                   probe->size, size);
    }
}
