/* Findings of the kicks so far, read by sim/gpu/compute/read.c. A pass that writes the block (WRITES_WATCH)
   also reads there, without a second block of the same buffer. */
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
    uint greatest_speed2; /* bits of floats, which have the order of non-negative floats */
    uint greatest_acceleration2;
    uint greatest_density_ratio;
    uint guarded;      /* number of times a guard held a particle */
    uint went_too_far; /* 1: a particle moved too far */
}
BLOCK_END(WatchBlock);

#endif
