/* What the kicks have found so far; sim/gl/compute/watch.c reads it. A pass that writes there (WRITES_WATCH)
   reads there, too: it has no second block of the same buffer. */
#ifndef SLOSH_WATCH_BLOCK_H
#define SLOSH_WATCH_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

#ifdef WRITES_WATCH
STORAGE_BLOCK(WatchBlock, WATCH_BUFFER)
#else
UNIFORM_BLOCK(WatchBlock, WATCH_BLOCK)
#endif
{
    uint greatest_speed2; /* bits of floats, which are in their order where they are not negative */
    uint greatest_acceleration2;
    uint greatest_density_ratio;
    uint guarded;      /* how often a guard held a particle */
    uint went_too_far; /* 1: a particle did */
}
BLOCK_END(WatchBlock);

#endif
