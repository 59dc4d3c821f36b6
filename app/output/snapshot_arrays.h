/* A step of a file as views have a state. */
#ifndef SLOSH_SNAPSHOT_ARRAYS_H
#define SLOSH_SNAPSHOT_ARRAYS_H

#include "app/output/snapshot.h"
#include "sim/world/reading.h"

/* What the volume of a particle is. */
typedef enum SnapshotVolume {
    SNAPSHOT_VOLUME,      /* 1 / number density, as a world's own (snapshot_volume) */
    SNAPSHOT_MASS_DENSITY /* mass / density; the same but where density is not in proportion to number density
                           */
} SnapshotVolume;

/* X(field of a step, what it is the only source of: PARTICLE_*) */
#define SNAPSHOT_SOURCES(X)                                                                                  \
    X("velocity_0", PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_SPEED))                                       \
    X("velocity_1", PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_SPEED))                                       \
    X("velocity_2", PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_SPEED))                                       \
    X("density", PARTICLE_SCALAR(SCALAR_DENSITY))                                                            \
    X("pressure", PARTICLE_SCALAR(SCALAR_PRESSURE))                                                          \
    X("compression", PARTICLE_SCALAR(SCALAR_COMPRESSION))                                                    \
    X("fluid", PARTICLE_FLUID | PARTICLE_SCALAR(SCALAR_FLUID))                                               \
    X("id", PARTICLE_ID | PARTICLE_SCALAR(SCALAR_ID))

/* PARTICLE_*: what can be had of it. */
unsigned snapshot_attributes(const SnapshotStep *step);

/* Fills those of `to` that are not NULL, with room for step->count particles each. Without densities a
   particle has the volume of fluid at rest; with a density that is not more than 0, or a fluid that the file
   does not know, none. */
void snapshot_arrays(const SnapshotScene *scene, const SnapshotStep *step, SnapshotVolume volume,
                     const ParticleArrays *to);

#endif
