/* Plotted quantities of a running world: asked for first, answered when ready. Also forces on box and
   solids, requested once. */
#include "sim/body/bodies.h"
#include "sim/world/world_struct.h"

static bool gather(World *world)
{
    double gravity[3];
    quat_rotate_inverse(world->box.orientation, world->def.gravity, gravity);
    return world->backend->gauge(world->state, gravity);
}

void world_gauge_ask(World *world)
{
    if (world->gauge_asked)
        return;
    world->gauge_asked = gather(world);
    world->gauge_time = world_time_at(world, (double)world->step);
}

bool world_gauge_now(World *world, WorldGauge *gauge)
{
    *gauge = (WorldGauge){.time = world->gauge_time};
    if (world->gauge_asked && !world->gauge_kept) {
        world->gauge = *gauge;
        world->gauge_asked = world->gauge_kept = world->backend->gauged(world->state, &world->gauge, true);
    }
    return gather(world) && world->backend->gauged(world->state, gauge, true);
}

bool world_gauge(World *world, WorldGauge *gauge)
{
    *gauge = (WorldGauge){.time = world->gauge_time};
    if (world->gauge_kept)
        *gauge = world->gauge;
    else if (!world->gauge_asked || !world->backend->gauged(world->state, gauge, false))
        return false;
    world->gauge_kept = false;
    world->gauge_asked = false;
    gauge->total_known = true;
    for (int f = 0; f < world->def.fluid_count; f++)
        if (world->def.tension_model != TENSION_NONE && world->def.fluids[f].surface_tension > 0)
            gauge->total_known = false;
    return true;
}

bool world_sum_forces(World *world, Error *error)
{
    Forces *to = world->backend->felt ? &world->felt : &world->pushed;
    if (!world->backend->feel)
        return error_set(error, "backend %s sums no forces; use backend cpu or compute",
                         world->backend->name);
    if (world->bodies) /* floating bodies have summed forces since the start */
        bodies_tell(world->bodies, to);
    world->sums_forces = world->bodies || world->backend->feel(world->state, to, error);
    return world->sums_forces;
}

bool world_feel(World *world, Error *error)
{
    world->felt = world->felt_before = (Forces){0};
    world->feels = world_sum_forces(world, error);
    return world->feels;
}

void world_forces(World *world, Forces *forces)
{
    const Backend *backend = world->backend;
    *forces = (Forces){0};
    /* For asynchronous steps: the next step takes these forces back. */
    if (backend->felt && (!world_sound(world) || !backend->felt(world->state)))
        return;
    *forces = world->felt;
    forces_mean(forces);
    world->felt = world->felt_before = (Forces){0};
}
