#include "sim/world/resize.h"

#include "sim/world/sentinel.h"
#include "sim/world/world_state.h"
#include "sim/world/world_struct.h"

#include <math.h>
#include <string.h>

/* Cells that are too many change no bit: particles are found and summed by cells of one lattice. */
static bool cells_hold(const Constants *constants, const WorldDef *def)
{
    const CellGrid *cells = &constants->cells;
    const double h = (double)constants->support_radius;
    bool hold = true;
    for (int k = 0; k < def->dimensions; k++) {
        const double low = k == 1 ? 0 : -0.5 * def->box_size[k];
        hold &= def->periodic[k] || (low >= (cells->first[k] + 1) * h &&
                                     low + def->box_size[k] < (cells->first[k] + cells->size[k] - 1) * h);
    }
    return hold;
}

bool world_resizes(const World *world, const WorldDef *def)
{
    return world->def.solid_count == 0 && def->solid_count == 0 && cells_hold(&world->constants, def);
}

void world_bring_in(WorldState *state, const WorldDef *def, int axis)
{
    const ParticleColumns *p = &state->particles;
    float *const along[] = {p->x, p->y, p->z};
    const float slack = 1e-3F * (float)def->spacing;
    const float low = axis == 1 ? 0 : -0.5F * (float)def->box_size[axis],
                high = low + (float)def->box_size[axis];
    for (size_t i = 0; i < state->count; i++)
        along[axis][i] = fmaxf(low + slack, fminf(along[axis][i], high - slack));
}

static void place(World *world, const double size[3])
{
    WorldDef *def = &world->def;
    memcpy(def->box_size, size, sizeof def->box_size);
    walls_place(&world->constants.walls, def->dimensions, size, def->periodic, def->spacing);
    for (int k = 0; k < 3; k++)
        world->constants.drag.half_size[k] = world->constants.walls.half_size[k];
}

bool world_resize(World *world, const WorldDef *def, Error *error)
{
    WorldState state = {.count = 0};
    double before[3];
    memcpy(before, world->def.box_size, sizeof before);
    if (!world_save(world, &state, error))
        return false;
    for (int k = 0; k < def->dimensions; k++)
        if (def->box_size[k] < before[k])
            world_bring_in(&state, def, k);
    place(world, def->box_size);
    const bool loaded = world_load(world, &state, error);
    if (loaded)
        world_pose(world); /* it turns about half its height */
    else
        place(world, before);
    world_state_free(&state);
    return loaded && sentinel_mark(world, error);
}
