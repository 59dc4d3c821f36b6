/* Binds the particles for shaders/common/particles.glsl. */
#ifndef SLOSH_PARTICLE_BIND_H
#define SLOSH_PARTICLE_BIND_H

#include "sim/gl/particle_buffers.h"

/* Binds positions, the scalar and the fluid (if present) and sets the strides of `program`. */
void particle_bind(unsigned program, const ParticleBuffers *particles, Scalar scalar);

/* The attribute that colours the particles: the scalar, or the fluid (uint) for SCALAR_FLUID. */
const ParticleAttribute *particle_shown(const ParticleBuffers *particles, Scalar color_by);

/* Binds one attribute of `count` particles for a compute shader, where one buffer must not be bound to two
   blocks. A missing attribute is replaced by `stand_in`, a buffer of 16 bytes. Returns the stride in
   words; 0 for `stand_in`. */
unsigned particle_bind_one(unsigned binding, const ParticleAttribute *attribute, size_t count,
                           unsigned stand_in);

/* Binds the ids, as the numbers of the scalar `id`, for shaders/common/particle_ids.glsl. */
void particle_bind_ids(unsigned program, const ParticleBuffers *particles);

/* The largest size of a sprite drawn as a GL point instead of a quad, pixels. 0: draw no points. Points
   are cheaper on a software driver only, and not all hardware draws points to the same bits. */
float point_limit(void);

/* Indices of two triangles per particle over the vertices 4 i .. 4 i + 3, for glDrawElements. Indexed
   quads, not instances: on the software driver an instance costs microseconds. */
typedef struct QuadIndices {
    unsigned vertex_array, buffer;
    size_t capacity; /* particles */
} QuadIndices;

void quad_indices_create(QuadIndices *indices);
void quad_indices_destroy(QuadIndices *indices);
void quad_indices_draw(QuadIndices *indices, size_t count);

/* Draws the number of particles in a buffer with a DrawElementsIndirectCommand, at most `count`. */
void quad_indices_draw_indirect(QuadIndices *indices, size_t count, unsigned commands, size_t offset);

#endif
