/* A step of a file in GL buffers, with a scalar derived from the step, for exports of numbers.

   Needs a current OpenGL 4.5 core context, except for scalars stored in the step. */
#ifndef SLOSH_STEP_BUFFERS_H
#define SLOSH_STEP_BUFFERS_H

#include "app/output/snapshot_arrays.h"
#include "render/derived/derived.h"
#include "render/particles/upload.h"

/* Programs and buffers reused for each step. Zero-initialise before use. */
typedef struct StepBuffers {
    Derived derived;
    Upload *upload;
    size_t capacity; /* particles of `upload` */
} StepBuffers;

void step_buffers_destroy(StepBuffers *buffers); /* a zeroed struct needs no context */

/* The PARTICLE_* attributes that the scalar needs besides positions. */
unsigned step_attributes(Scalar scalar);

/* Makes buffers of the step with positions, inputs of the scalar, and the scalar; valid until the next call.
   Returns false if memory is short. */
bool step_buffers_make(StepBuffers *buffers, const SnapshotScene *scene, const SnapshotStep *step,
                       SnapshotVolume volume, Scalar scalar, ParticleBuffers *out, Error *error);

/* Writes the scalar of each particle, as in the views; scalars stored in the step need no context. */
bool step_buffers_scalar(StepBuffers *buffers, const SnapshotScene *scene, const SnapshotStep *step,
                         Scalar scalar, float *values, Error *error);

#endif
