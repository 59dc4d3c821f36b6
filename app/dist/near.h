/* The particles that probes read, of all ranks, at the first one. */
#ifndef SLOSH_DIST_NEAR_H
#define SLOSH_DIST_NEAR_H

#include "app/probe/probe.h"
#include "sim/base/particle_id.h"
#include "sim/world/world.h"

/* Zero-initialise it. */
typedef struct Near {
    Cloud cloud;    /* at the first rank: in the order of one process, so that sums have its bits */
    Cloud own;      /* this rank's particles */
    void *out, *in; /* records that go to the first rank, and that come */
    ParticleId *id;
    uint32_t *cell;
    size_t own_room, out_room, in_room, cloud_room; /* of particles */
} Near;

/* Collective; ends all ranks without memory. */
void near_read(Near *near, const Probes *probes, World *world);

void near_free(Near *near);

#endif
