#include "sim/gl/particle_buffers.h"

#include "sim/world/world_struct.h"

#include <string.h>

void particle_buffers_describe(const WorldInfo *info, ParticleBuffers *out)
{
    *out = (ParticleBuffers){.count = info->count,
                             .spacing = info->spacing,
                             .support_radius = info->support_radius,
                             .box = info->box,
                             .time = info->time,
                             .step = info->step};
    memcpy(out->floating, info->floating, sizeof out->floating);
    memcpy(out->box_size, info->box_size, sizeof out->box_size);
    memcpy(out->gravity, info->gravity, sizeof out->gravity);
}

bool world_shares(const World *world)
{
    return world->backend->share != NULL;
}

void world_share(World *world, unsigned attributes, ParticleBuffers *out)
{
    WorldInfo info;
    world_info(world, &info);
    particle_buffers_describe(&info, out);
    world->backend->share(world->state, attributes, out);
    out->births = &world->births;
}

bool world_births(const World *world, Births *to)
{
    return births_copy(&world->births, to);
}
