/* The particle under the mouse. */
#ifndef SLOSH_PARTICLE_UNDER_H
#define SLOSH_PARTICLE_UNDER_H

#include "render/frame/handle.h"
#include "sim/gl/particle_buffers.h"

/* Finds the first particle whose ball of `radius` (m) meets the ray; without a hit, the particle nearest
   to the ray within three radii. Returns false if there is no such particle or the state has no ids. Reads
   all positions back and waits for the GPU: for clicks, not for each picture. Needs the context. */
bool particle_under(const ParticleBuffers *particles, const SightRay *ray, double radius, uint32_t *id);

/* As particle_under, but gives the particle's position (box's frame, m); no ids are needed. */
bool particle_place_under(const ParticleBuffers *particles, const SightRay *ray, double radius, double at[3]);

#endif
