/* Particles that come and leave in a step, counted on the GPU: flow_count.comp writes, sim/gpu/compute/flow.c
   reads after the step. */
#ifndef SLOSH_FLOW_COUNTS_BLOCK_H
#define SLOSH_FLOW_COUNTS_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

STORAGE_BLOCK(FlowCounts, FLOW_COUNTS_BUFFER)
{
    uint there;              /* particles after the last layer or drain */
    uint born;               /* id of the next particle */
    uint flowed[FLOWS_MOST]; /* particles of each layer and each drain of the step, in order */
}
BLOCK_END(FlowCounts);

#endif
