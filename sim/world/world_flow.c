#include "sim/world/world_struct.h"

static const uint64_t IDS = 0x7fffffff;

static void let_in(World *world, int fluid, const Emit *emit, double begin, double end)
{
    const WorldDef *def = &world->def;
    long first;
    const long layers = emit_layers(emit, def->spacing, begin, end, &first);
    for (long k = first; k < first + layers; k++) {
        const uint64_t born = world->initial + world->emitted;
        EmitLayer layer = {.position = world->layer, .fluid = fluid, .first_id = (uint32_t)born};
        if (k == first)
            world->backend->grid(world->state); /* who is where now */
        emit_place(emit, def->dimensions, def->spacing, k, end, &layer);
        for (size_t i = 0; i < layer.count; i++)
            periodic_wrap(&world->constants.periodic, layer.position + 3 * i);
        size_t most = world->capacity - world->count;
        if (born + layer.count > IDS)
            most = 0;
        const size_t more = world->backend->emit(world->state, &layer, most);
        world->emitted += more;
        world->count += more;
    }
}

void world_flow(World *world)
{
    const WorldDef *def = &world->def;
    const double begin = world_time_at(world, (double)world->step);
    const double end = world_time_at(world, (double)world->step + 1);
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++)
            let_in(world, f, &def->fluids[f].emits[i], begin, end);
    if (def->drain_count > 0) {
        const size_t less = world->backend->drain(world->state, def->drains, def->drain_count);
        world->drained += less;
        world->count -= less;
    }
}
