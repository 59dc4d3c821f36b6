/* Checks if a scene fits the memory of the ranks, before making any of it. */
#ifndef SLOSH_DIST_MEMORY_H
#define SLOSH_DIST_MEMORY_H

#include "app/scene/scene.h"

typedef struct DistMemory {
    double particles; /* of all ranks, including solids and future emissions */
    double needed;    /* bytes: approximate need of a rank, for its particles and ghosts */
    double allowed;   /* bytes: least allowance of any rank */
    char machine[64]; /* machine of that rank */
} DistMemory;

/* Finds the memory allowed to a rank: its share of the machine's memory (or of the cgroup's, if less), or
   the limit of the shell or batch system (ulimit -v, -d). `physical`: bytes of this machine, with `here`
   ranks. Collective; equal on all ranks. */
DistMemory memory_look(const Scene *scene, double physical, int here);

/* Returns false with the missing amount and advice. */
bool memory_fits(const DistMemory *memory, int ranks, Error *error);

#endif
