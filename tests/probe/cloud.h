/* Particles set by hand, for the tests of probes. */
#ifndef SLOSH_TESTS_PROBE_CLOUD_H
#define SLOSH_TESTS_PROBE_CLOUD_H

#include "tests/sim/fixture.h"

#include "app/run/measure/measure.h"

enum { CLOUD_MOST = 60000 };

static float cloud_position[4 * CLOUD_MOST], cloud_velocity[4 * CLOUD_MOST], cloud_density[CLOUD_MOST],
    cloud_pressure[CLOUD_MOST];
static uint32_t cloud_fluid[CLOUD_MOST];

static inline Cloud cloud_of(const WorldDef *def)
{
    return (Cloud){0,
                   def->spacing,
                   def->support * def->spacing,
                   cloud_position,
                   cloud_velocity,
                   cloud_density,
                   cloud_pressure,
                   cloud_fluid};
}

static inline void cloud_add(Cloud *cloud, double x, double y, double z, double pressure)
{
    const size_t i = cloud->count++;
    assert_true(i < CLOUD_MOST);
    memcpy(cloud->position + 4 * i, (float[]){(float)x, (float)y, (float)z, 0}, 4 * sizeof(float));
    memcpy(cloud->velocity + 4 * i, (float[]){(float)y, (float)-x, (float)z, 0}, 4 * sizeof(float));
    cloud->density[i] = 1000;
    cloud->pressure[i] = (float)pressure;
}

/* A box 1 m wide, high and deep. */
static inline WorldDef cloud_box(int dimensions, double spacing)
{
    WorldDef def = world_def_default();
    def.dimensions = dimensions;
    def.spacing = spacing;
    for (int k = 0; k < 3; k++)
        def.box_size[k] = 1;
    return def;
}

/* The lattice of fluid at rest up to a height, its pressure hydrostatic. */
static inline Cloud cloud_at_rest(const WorldDef *def, double height)
{
    Cloud cloud = cloud_of(def);
    const double s = def->spacing;
    const int n = (int)round(1 / s), deep = def->dimensions == 3 ? n : 1;
    for (int a = 0; a < n; a++)
        for (int b = 0; (b + 0.75) * s < height; b++)
            for (int c = 0; c < deep; c++)
                cloud_add(&cloud, (a + 0.5) * s - 0.5, (b + 0.5) * s, deep > 1 ? (c + 0.5) * s - 0.5 : 0,
                          9810 * (height - (b + 0.5) * s));
    return cloud;
}

static inline void near(double value, double right, double tolerance)
{
    if (!(fabs(value - right) <= tolerance))
        fail_msg("%.9g, not %.9g", value, right);
}

#endif
