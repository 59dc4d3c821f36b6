/* Hands the particles to shaders/common/particles.glsl. */
#ifndef SLOSH_PARTICLE_BIND_H
#define SLOSH_PARTICLE_BIND_H

#include "sim/gl/particle_buffers.h"

/* Binds positions, the scalar and the fluid (those that are there) and sets the strides of `program`. */
void particle_bind(unsigned program, const ParticleBuffers *particles, Scalar scalar);

/* What particles are coloured by: their scalar, or their fluid (uint) where that is SCALAR_FLUID. */
const ParticleAttribute *particle_shown(const ParticleBuffers *particles, Scalar color_by);

/* Binds one attribute of that many particles for a compute shader, in which no buffer may stand in two
   blocks; where it is not there `stand_in`, a buffer of 16 bytes. Returns its stride in words, of the
   stand-in 0. */
unsigned particle_bind_one(unsigned binding, const ParticleAttribute *attribute, size_t count,
                           unsigned stand_in);

/* The ids, as numbers that the scalar `id` has, for shaders/common/particle_ids.glsl. */
void particle_bind_ids(unsigned program, const ParticleBuffers *particles);

/* The largest point that is worth drawing instead of a quad, pixels; 0 where none is: points are cheaper on a
   software driver only, and not all hardware draws them to the bit. */
float point_limit(void);

/* Indices of two triangles a particle over the vertices 4 i .. 4 i + 3, for glDrawElements. They are indexed
   quads rather than instances: on the software driver an instance costs microseconds. */
typedef struct QuadIndices {
    unsigned vertex_array, buffer;
    size_t capacity; /* particles */
} QuadIndices;

void quad_indices_create(QuadIndices *indices);
void quad_indices_destroy(QuadIndices *indices);
void quad_indices_draw(QuadIndices *indices, size_t count);

/* As many of at most `count` particles as a buffer with a DrawElementsIndirectCommand says. */
void quad_indices_draw_indirect(QuadIndices *indices, size_t count, unsigned commands, size_t offset);

#endif
