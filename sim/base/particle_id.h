/* Identity of a particle: its index in the initial state, or the number of particles born before. Ids are
   never reused, so emitters may count beyond 2^32. GPUs have the low 32 bits only: GPU backends reject
   particles beyond (world_flow, world_load), and views identify particles by these bits. */
#ifndef SLOSH_PARTICLE_ID_H
#define SLOSH_PARTICLE_ID_H

#include <stdint.h>

typedef uint64_t ParticleId;

/* Upper bounds of ids: so that doubles count ids exactly (WorldNumbers); for GPUs. */
#define PARTICLE_IDS     (UINT64_C(1) << 53)
#define PARTICLE_IDS_GPU (UINT64_C(1) << 31)

#endif
