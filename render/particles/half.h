/* The particles on one side of a plane: those beyond it have no place (NaN), and views leave them out. The
   rest of the state is shared. */
#ifndef SLOSH_HALF_H
#define SLOSH_HALF_H

#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

/* Zero-initialise it. */
typedef struct ParticleHalf {
    unsigned program, positions; /* a buffer of its own: vec4 a particle, as ParticleBuffers.position */
    size_t capacity;             /* particles */
} ParticleHalf;

/* False when the shader does not compile; particle_half_destroy is needed in either case. */
bool particle_half_create(ParticleHalf *half, Error *error);
void particle_half_destroy(ParticleHalf *half);

/* `out`: the particles of which normal . x <= most, in the box's frame; up to the next run. */
void particle_half_run(ParticleHalf *half, const ParticleBuffers *particles, const double normal[3],
                       double most, ParticleBuffers *out);

#endif
