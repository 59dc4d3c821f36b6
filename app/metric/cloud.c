#include "app/metric/cloud.h"

#include <stdlib.h>

static bool cloud_make(Cloud *cloud, size_t count)
{
    if (cloud->position && cloud->count == count)
        return true;
    cloud_free(cloud);
    cloud->position = malloc(count * 4 * sizeof(float) + 1);
    cloud->velocity = malloc(count * 4 * sizeof(float) + 1);
    cloud->density = malloc(count * sizeof(float) + 1);
    cloud->pressure = malloc(count * sizeof(float) + 1);
    cloud->fluid = malloc(count * sizeof(uint32_t) + 1);
    cloud->count = count;
    return cloud->position && cloud->velocity && cloud->density && cloud->pressure && cloud->fluid;
}

bool cloud_read(Cloud *cloud, World *world)
{
    WorldInfo info;
    world_info(world, &info);
    if (!cloud_make(cloud, info.count))
        return false;
    cloud->spacing = info.spacing;
    cloud->support_radius = info.support_radius;
    ParticleArrays out = {.position = cloud->position, .velocity = cloud->velocity, .fluid = cloud->fluid};
    out.scalar[SCALAR_DENSITY] = cloud->density;
    out.scalar[SCALAR_PRESSURE] = cloud->pressure;
    return world_read(world, &out);
}

void cloud_free(Cloud *cloud)
{
    free(cloud->position);
    free(cloud->velocity);
    free(cloud->density);
    free(cloud->pressure);
    free(cloud->fluid);
    *cloud = (Cloud){.count = 0};
}
