/* Emitters, guides and drains; filled by sim/gpu/compute/flow.c. */
#ifndef SLOSH_FLOW_BLOCK_H
#define SLOSH_FLOW_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

BLOCK_STRUCT(Region)
{
    vec3 low;      /* low corner of a block, or centre of a ball, m */
    int ball;      /* 1: a ball */
    vec3 high;     /* of a block, m */
    float radius2; /* of a ball, squared, m2 */
}
BLOCK_END(Region);

BLOCK_STRUCT(Course)
{
    vec3 centre;
    float radius; /* m */
    vec3 direction;
    float depth; /* m */
    vec3 velocity;
    int fluid; /* fluid of the guide */
}
BLOCK_END(Course);

UNIFORM_BLOCK(FlowBlock, FLOW_BLOCK)
{
    int drain_total;
    int guide_total;
    uint gridded;         /* particles in the grid, copied on the GPU */
    uint candidate_total; /* points of a layer */
    uint layer_fluid;
    uint particle_most; /* room for particles */
    vec3 layer_velocity;
    Region drains[DRAINS_MOST];
    Course guides[GUIDES_MOST];
}
BLOCK_END(FlowBlock);

#endif
