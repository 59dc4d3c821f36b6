/* Constants of mueller, shared by C and shaders; filled by mueller_set of sim/methods/mueller/mueller.c. */
#ifndef SLOSH_MUELLER_BLOCK_H
#define SLOSH_MUELLER_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

UNIFORM_BLOCK(MuellerBlock, METHOD_BLOCK)
{
    float boundary_fades; /* rate at which the boundary part of the number density fades, 1/s */
    float boundary_most;  /* its bound, over n0 */
}
BLOCK_END(MuellerBlock);

#endif
