/* Neighbour lists without lane compression: the compiler vectorizes the squared distances, then entries are
   kept one by one. For pairs_lists.c. */
#ifndef SLOSH_LISTS_PLAIN_H
#define SLOSH_LISTS_PLAIN_H

#include "sim/cpu/lists_block.h"

/* Distance of x to the box along an axis; 0 inside. */
SIMD_INLINE float outside(const BlockBounds *box, int axis, float x)
{
    const float d = fabsf(x - box->middle[axis]) - box->half[axis];
    return d > 0 ? d : 0;
}

/* Adds the particles of [begin, end) in the box or within slightly more than h of the box: the margin
   covers rounding of positions. */
static void block_add(const PairArgs *args, const BlockBounds *around_box, uint32_t begin, uint32_t end,
                      CandidateBlock *block)
{
    const BlockBounds box = *around_box;
    const float reach2 = block_reach2(args);
    const float *const x = args->x + begin, *const y = args->y + begin, *const z = args->z + begin;
    const int count = (int)(end - begin);
    float square[BLOCK_MOST + LANES];
    for (int k = 0; k < count; k++) {
        const float dx = outside(&box, 0, x[k]), dy = outside(&box, 1, y[k]), dz = outside(&box, 2, z[k]);
        square[k] = dx * dx + dy * dy + dz * dz;
    }
    int used = block->count;
    for (int k = 0; k < count; k++) { /* no branch: its outcome would be random */
        block->x[used] = x[k];
        block->y[used] = y[k];
        block->z[used] = z[k];
        block->j[used] = (int32_t)list_entry(begin + (uint32_t)k);
        used += square[k] < reach2;
    }
    block->count = used;
}

/* Appends the neighbours at `at` among the candidates. */
SIMD_INLINE void offer(const PairArgs *args, const float at[3], const CandidateBlock *block, ListWriter *out)
{
    const float h = args->constants->support_radius, least = 1e-6f * h;
    float square[BLOCK_MOST + LANES];
    int coincident = 0;
    for (int k = 0; k < block->count; k++) {
        const float dx = at[0] - block->x[k], dy = at[1] - block->y[k], dz = at[2] - block->z[k];
        square[k] = dx * dx + dy * dy + dz * dz;
        coincident += square[k] < least * least;
    }
    out->coincident |= coincident > 0;
    int32_t *to = out->at;
    for (int k = 0; k < block->count; k++) {
        *to = block->j[k];
        to += square[k] < h * h;
    }
    out->at = to;
}

/* Interleaves the lists: `rows` rows of LANES entries, `none` past a list's end. */
static void interleave(const uint32_t *index, const FoundNeighbours *found, uint32_t rows, uint32_t none,
                       uint32_t *to)
{
    for (int lane = 0; lane < LANES; lane++) {
        const uint32_t *from = index + found->first[lane], count = found->count[lane];
        for (uint32_t k = 0; k < rows; k++)
            to[k * LANES + (uint32_t)lane] = k < count ? from[k] : none;
    }
}

#endif
