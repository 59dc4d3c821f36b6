/* Neighbour candidates of a cell's particles, for pairs_lists.c and its two ways to fill and search a
   block. */
#ifndef SLOSH_LISTS_BLOCK_H
#define SLOSH_LISTS_BLOCK_H

#include "sim/cpu/pair_loop.h"

enum { BLOCK_MOST = 2048 /* 32 kB: the fluid around a cell at the widest support */ };

/* Candidates: positions and entries of lists. LANES positions past the last are infinite. */
typedef struct CandidateBlock {
    _Alignas(32) float x[BLOCK_MOST + LANES], y[BLOCK_MOST + LANES], z[BLOCK_MOST + LANES];
    int32_t j[BLOCK_MOST + LANES];
    int count, own; /* `own`: the first of the listed particles */
} CandidateBlock;

/* The bounding box of some particles: centre and half size, m. */
typedef struct BlockBounds {
    float middle[3], half[3];
} BlockBounds;

static void block_bounds(const PairArgs *args, size_t begin, size_t end, BlockBounds *box)
{
    const float *const column[3] = {args->x, args->y, args->z};
    for (int k = 0; k < 3; k++) {
        const float *x = column[k];
        float low = x[begin], high = low;
        for (size_t i = begin + 1; i < end; i++) {
            low = x[i] < low ? x[i] : low;
            high = x[i] > high ? x[i] : high;
        }
        box->middle[k] = 0.5f * (low + high);
        box->half[k] = 0.5f * (high - low);
    }
}

/* Squared distance to the box for candidates: slightly more than h^2, since positions in the box are
   rounded. */
SIMD_INLINE float block_reach2(const PairArgs *args)
{
    const float h = args->constants->support_radius;
    return h * h * 1.0001f;
}

/* A group's lists before interleaving, in sequence, each filled up to whole LANES: begin and number of
   entries. */
typedef struct FoundNeighbours {
    uint32_t first[LANES], count[LANES], used;
    bool coincident, solid;
} FoundNeighbours;

/* The list under construction. */
typedef struct ListWriter {
    int32_t *at;
    bool coincident;
} ListWriter;

#endif
