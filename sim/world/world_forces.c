/* What box and solids feel: asked for once, then read. */
#include "sim/world/world_struct.h"

bool world_feel(World *world, Error *error)
{
    world->felt = world->felt_before = (Forces){0};
    if (!world->backend->feel)
        return error_set(error, "backend %s sums no forces; use backend cpu", world->backend->name);
    return world->backend->feel(world->state, &world->felt, error);
}

void world_forces(World *world, Forces *forces)
{
    *forces = world->felt;
    forces_mean(forces);
    world->felt = world->felt_before = (Forces){0};
}
