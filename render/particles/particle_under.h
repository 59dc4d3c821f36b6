/* The particle that a user points at. */
#ifndef SLOSH_PARTICLE_UNDER_H
#define SLOSH_PARTICLE_UNDER_H

#include "render/frame/handle.h"
#include "sim/gl/particle_buffers.h"

/* The first particle whose ball of that radius (m) the ray meets; where it meets none, the nearest to the ray
   of those less than three radii from it. False: none, or the state has no ids. Reads all places back and
   waits for the GPU: for a click, not for a picture. Needs the context. */
bool particle_under(const ParticleBuffers *particles, const SightRay *ray, double radius, uint32_t *id);

/* The same particle's place, box's frame, m; no ids are needed. */
bool particle_place_under(const ParticleBuffers *particles, const SightRay *ray, double radius, double at[3]);

#endif
