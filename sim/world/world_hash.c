#include "sim/world/world_struct.h"

#include "sim/base/hash.h"

#include <stdlib.h>

typedef struct Who {
    ParticleId id;
    size_t place;
} Who;

static int ascending(const void *a, const void *b)
{
    const ParticleId x = ((const Who *)a)->id, y = ((const Who *)b)->id;
    return (x > y) - (x < y);
}

uint64_t world_hash(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    const size_t n = info.count;
    ParticleArrays out = {
        .position = malloc((n + 1) * 4 * sizeof(float)),
        .velocity = malloc((n + 1) * 4 * sizeof(float)),
        .whole_id = malloc((n + 1) * sizeof(ParticleId)),
    };
    Who *order = malloc((n + 1) * sizeof *order);
    uint64_t hash = 0;
    if (out.position && out.velocity && out.whole_id && order && world_read(world, &out)) {
        for (size_t i = 0; i < n; i++)
            order[i] = (Who){out.whole_id[i], i};
        qsort(order, n, sizeof *order, ascending);
        hash = HASH_NONE;
        for (size_t k = 0; k < n; k++) {
            const size_t i = order[k].place;
            hash = hash_add(hash, &out.position[4 * i], 3 * sizeof(float));
            hash = hash_add(hash, &out.velocity[4 * i], 3 * sizeof(float));
        }
        for (int k = 0; k < world->def.solid_count; k++)
            if (solid_floats(&world->def.solids[k]))
                hash = hash_add(hash, &info.floating[k], sizeof info.floating[k]);
    }
    free(out.position);
    free(out.velocity);
    free(out.whole_id);
    free(order);
    return hash;
}
