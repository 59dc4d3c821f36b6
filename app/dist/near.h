/* Gathers the particles read by probes, of all ranks, on the first rank. */
#ifndef SLOSH_DIST_NEAR_H
#define SLOSH_DIST_NEAR_H

#include "app/run/measure/probe.h"
#include "sim/base/particle_id.h"
#include "sim/world/world.h"

/* Zero-initialise before use. */
typedef struct Near {
    Cloud cloud;    /* on the first rank: in the order of a single process, so that sums have the same bits */
    Cloud own;      /* the rank's own particles */
    void *out, *in; /* records sent to, and received on, the first rank */
    ParticleId *id;
    uint32_t *cell;
    size_t own_room, out_room, in_room, cloud_room; /* capacity, particles */
} Near;

/* Collective; ends all ranks if memory is short. */
void near_read(Near *near, const Probes *probes, World *world);

void near_free(Near *near);

#endif
