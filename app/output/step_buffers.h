/* A step of a file in GL buffers, with a scalar that is derived from it: what exports of numbers read.

   Needs a current OpenGL 4.5 core context, but for what a step itself has. */
#ifndef SLOSH_STEP_BUFFERS_H
#define SLOSH_STEP_BUFFERS_H

#include "app/output/snapshot_arrays.h"
#include "render/derived/derived.h"
#include "render/particles/upload.h"

/* What one step leaves to the next: programs and buffers. Zero-initialise it. */
typedef struct StepBuffers {
    Derived derived;
    Upload *upload;
    size_t capacity; /* particles of `upload` */
} StepBuffers;

void step_buffers_destroy(StepBuffers *buffers); /* a zeroed one needs no context */

/* What of a step the scalar needs besides places: PARTICLE_*. */
unsigned step_attributes(Scalar scalar);

/* The step with its places, what the scalar is made of, and the scalar; up to the next call. False when
   memory is short. */
bool step_buffers_make(StepBuffers *buffers, const SnapshotScene *scene, const SnapshotStep *step,
                       SnapshotVolume volume, Scalar scalar, ParticleBuffers *out, Error *error);

/* The scalar of each particle, as views have it; of a step's own ones without a context. */
bool step_buffers_scalar(StepBuffers *buffers, const SnapshotScene *scene, const SnapshotStep *step,
                         Scalar scalar, float *values, Error *error);

#endif
