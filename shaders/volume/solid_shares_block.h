/* Where the shares of solids are in a volume; filled by render/views/volume/solid_shares.c. */
#ifndef SLOSH_SOLID_SHARES_BLOCK_H
#define SLOSH_SOLID_SHARES_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/volume/volume_bindings.h"

BLOCK_STRUCT(PlacedShare)
{
    mat4 from_cells; /* from the volume's cells to nodes of the solid's block */
    ivec3 nodes;
    int first; /* the block's first value in the buffer */
}
BLOCK_END(PlacedShare);

#define SOLID_SHARES_MAX 16

UNIFORM_BLOCK(SolidSharesBlock, SOLID_SHARES_BLOCK)
{
    PlacedShare shares[SOLID_SHARES_MAX];
    ivec3 shared_first; /* the cells that solids reach */
    int share_count;
    ivec3 shared_cells;
    float least_free; /* least part of the kernel left free */
}
BLOCK_END(SolidSharesBlock);

#endif
