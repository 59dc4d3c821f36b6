/* The particles on one side of a plane. Particles beyond the plane get the position NaN, and views leave
   them out. The rest of the state is shared. */
#ifndef SLOSH_HALF_H
#define SLOSH_HALF_H

#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

/* Zero-initialise. */
typedef struct ParticleHalf {
    unsigned program, positions; /* buffer owned here: a vec4 per particle, as ParticleBuffers.position */
    size_t capacity;             /* particles */
} ParticleHalf;

/* Returns false if the shader does not compile; call particle_half_destroy in either case. */
bool particle_half_create(ParticleHalf *half, Error *error);
void particle_half_destroy(ParticleHalf *half);

/* `out`: the state with only the particles where normal . x <= most, in the box's frame. Valid until the
   next run. */
void particle_half_run(ParticleHalf *half, const ParticleBuffers *particles, const double normal[3],
                       double most, ParticleBuffers *out);

#endif
