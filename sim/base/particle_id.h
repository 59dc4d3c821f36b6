/* Who a particle is: its place in the initial state, or behind all that were born before it. Ids are not
   given again, so that emitters may count on beyond 2^32. GPUs have the last 32 bits of them: their backends
   take no particle beyond (world_flow, world_load), and views tell particles apart by these. */
#ifndef SLOSH_PARTICLE_ID_H
#define SLOSH_PARTICLE_ID_H

#include <stdint.h>

typedef uint64_t ParticleId;

/* Before these: all ids, so that numbers in double count them (WorldNumbers); those that a GPU may have. */
#define PARTICLE_IDS     (UINT64_C(1) << 53)
#define PARTICLE_IDS_GPU (UINT64_C(1) << 31)

#endif
