#include "app/output/snapshot_arrays.h"

#include <math.h>

unsigned snapshot_attributes(const SnapshotStep *step)
{
    unsigned has = 0, lacks = 0;
#define X(name, source)                                                                                      \
    has |= (source);                                                                                         \
    lacks |= snapshot_step_lacks(step, name) ? (source) : 0;
    SNAPSHOT_SOURCES(X)
#undef X
    for (int s = SCALAR_OWN; s < SCALAR_STATE_COUNT; s++)
        has |= snapshot_step_own_scalar(step, (Scalar)s) ? PARTICLE_SCALAR(s) : 0;
    return (has & ~lacks) | PARTICLE_FLUID; /* default: all particles are of the first fluid */
}

static double volume_of(const SnapshotScene *scene, const SnapshotStep *step, SnapshotVolume volume, size_t i)
{
    const int of = step->fluid[i];
    if (of < 0 || (size_t)of >= scene->fluid_count || !(step->density[i] > 0))
        return 0;
    return volume == SNAPSHOT_VOLUME
               ? snapshot_volume(scene, step, i)
               : scene->density[of] * pow(scene->spacing, scene->dimensions) / step->density[i];
}

static void fill_places(const SnapshotScene *scene, const SnapshotStep *step, SnapshotVolume volume,
                        float *position)
{
    const double at_rest = pow(scene->spacing, scene->dimensions);
    const bool dense = !snapshot_step_lacks(step, "density");
    for (size_t i = 0; i < step->count; i++) {
        for (size_t k = 0; k < 3; k++)
            position[4 * i + k] = step->position[k][i];
        position[4 * i + 3] = (float)(dense ? volume_of(scene, step, volume, i) : at_rest);
    }
}

static void fill_velocities(const SnapshotStep *step, float *velocity)
{
    for (size_t i = 0; i < step->count; i++) {
        for (size_t k = 0; k < 3; k++)
            velocity[4 * i + k] = step->velocity[k][i];
        velocity[4 * i + 3] = 0;
    }
}

static float scalar_of(const SnapshotStep *step, Scalar scalar, size_t i)
{
    const float *const *v = (const float *const *)step->velocity;
    switch (scalar) {
    case SCALAR_SPEED: /* the same bits as sim/world/particles.c */
        return sqrtf(v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i]);
    case SCALAR_DENSITY:
        return step->density[i];
    case SCALAR_PRESSURE:
        return step->pressure[i];
    case SCALAR_COMPRESSION:
        return step->compression[i];
    case SCALAR_FLUID:
        return (float)step->fluid[i];
    case SCALAR_ID:
        return (float)(uint32_t)step->id[i];
    default:
        return NAN;
    }
}

static void fill_own(const SnapshotStep *step, Scalar scalar, float *to)
{
    const float *own = snapshot_step_own_scalar(step, scalar);
    for (size_t i = 0; i < step->count; i++)
        to[i] = own ? own[i] : NAN;
}

void snapshot_arrays(const SnapshotScene *scene, const SnapshotStep *step, SnapshotVolume volume,
                     const ParticleArrays *to)
{
    if (to->position)
        fill_places(scene, step, volume, to->position);
    if (to->velocity)
        fill_velocities(step, to->velocity);
    for (size_t i = 0; to->fluid && i < step->count; i++)
        to->fluid[i] = (uint32_t)step->fluid[i];
    for (size_t i = 0; to->id && i < step->count; i++)
        to->id[i] = (uint32_t)step->id[i];
    for (size_t s = 0; s < SCALAR_OWN; s++)
        for (size_t i = 0; to->scalar[s] && i < step->count; i++)
            to->scalar[s][i] = scalar_of(step, (Scalar)s, i);
    for (int s = SCALAR_OWN; s < SCALAR_STATE_COUNT; s++)
        if (to->scalar[s])
            fill_own(step, (Scalar)s, to->scalar[s]);
}
