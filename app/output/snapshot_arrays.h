/* Converts a step of a file to the arrays of views. */
#ifndef SLOSH_SNAPSHOT_ARRAYS_H
#define SLOSH_SNAPSHOT_ARRAYS_H

#include "app/output/snapshot.h"
#include "sim/world/reading.h"

/* Definition of a particle's volume. */
typedef enum SnapshotVolume {
    SNAPSHOT_VOLUME,      /* 1 / number density, as in a world (snapshot_volume) */
    SNAPSHOT_MASS_DENSITY /* mass / density; different only if density is not proportional to number density
                           */
} SnapshotVolume;

/* X(field of a step, PARTICLE_* attributes with this field as their only source) */
#define SNAPSHOT_SOURCES(X)                                                                                  \
    X("velocity_0", PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_SPEED))                                       \
    X("velocity_1", PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_SPEED))                                       \
    X("velocity_2", PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_SPEED))                                       \
    X("density", PARTICLE_SCALAR(SCALAR_DENSITY))                                                            \
    X("pressure", PARTICLE_SCALAR(SCALAR_PRESSURE))                                                          \
    X("compression", PARTICLE_SCALAR(SCALAR_COMPRESSION))                                                    \
    X("fluid", PARTICLE_FLUID | PARTICLE_SCALAR(SCALAR_FLUID))                                               \
    X("id", PARTICLE_ID | PARTICLE_SCALAR(SCALAR_ID))

/* The PARTICLE_* attributes available from the step. */
unsigned snapshot_attributes(const SnapshotStep *step);

/* Fills the arrays of `to` that are not NULL, with room for step->count particles each. Without densities a
   particle has the volume of fluid at rest; with a density not more than 0, or an unknown fluid, the volume
   is 0. */
void snapshot_arrays(const SnapshotScene *scene, const SnapshotStep *step, SnapshotVolume volume,
                     const ParticleArrays *to);

#endif
