/* Whether a scene fits the memory of the ranks, before anything of it is made. */
#ifndef SLOSH_DIST_MEMORY_H
#define SLOSH_DIST_MEMORY_H

#include "app/scene/scene.h"

typedef struct DistMemory {
    double particles; /* of all ranks, those of solids and what emitters may add included */
    double needed;    /* bytes: what a rank needs about, its part of the particles and ghosts */
    double allowed;   /* bytes: what the rank may have that may have least */
    char machine[64]; /* where that one runs */
} DistMemory;

/* What a rank may have: its part of its machine's memory (of the cgroup's, where that is less), or the limit
   that the shell or the batch system set (ulimit -v, -d). `physical`: bytes of this machine, which has
   `here` ranks. Collective; the same on all ranks. */
DistMemory memory_look(const Scene *scene, double physical, int here);

/* False with how much is missing, and what helps. */
bool memory_fits(const DistMemory *memory, int ranks, Error *error);

#endif
