/* How near particles are to solids. */
#ifndef SLOSH_TEST_SOLIDS_H
#define SLOSH_TEST_SOLIDS_H

#include "fixture.h"

/* Distance of a particle from a solid's surface at the world's time. */
static inline double clearance(const SolidDef *solid, int dimensions, double time, const float x[3])
{
    BoxState pose;
    double d[3];
    solid_pose(solid, time, &pose);
    for (int k = 0; k < 3; k++)
        d[k] = x[k] - pose.position[k];
    quat_rotate_inverse(pose.orientation, d, d);
    return solid_distance(solid, dimensions, d);
}

/* The least over all particles and solids; fails the test when a particle has left the box. */
static inline double least_clearance(World *world, const WorldDef *def)
{
    WorldInfo info;
    world_info(world, &info);
    State s = fixture_read(world);
    double least = INFINITY;
    for (size_t i = 0; i < s.count; i++) {
        const float *x = s.position + 4 * i;
        assert_true(fabsf(x[0]) <= 0.5 * def->box_size[0] + 1e-6 && x[1] >= 0 &&
                    x[1] <= def->box_size[1] + 1e-6 && fabsf(x[2]) <= 0.5 * def->box_size[2] + 1e-6);
        for (int k = 0; k < def->solid_count; k++)
            least = fmin(least, clearance(&def->solids[k], def->dimensions, info.time, x));
    }
    fixture_free(&s);
    return least;
}

#endif
