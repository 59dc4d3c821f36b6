/* The candidates for neighbours of a cell's particles, for pairs_lists.c and the two ways in which it fills
   and searches them. */
#ifndef SLOSH_LISTS_BLOCK_H
#define SLOSH_LISTS_BLOCK_H

#include "sim/cpu/pair_loop.h"

enum { BLOCK_MOST = 2048 /* 32 kB: as many as fluid has around a cell at the widest support */ };

/* Candidates: places and indices. */
typedef struct Block {
    int count;
    float x[BLOCK_MOST + LANES], y[BLOCK_MOST + LANES], z[BLOCK_MOST + LANES];
    int32_t j[BLOCK_MOST + LANES];
} Block;

/* The box around some particles: its middle and half of its size, m. */
typedef struct Around {
    float middle[3], half[3];
} Around;

static void around(const PairArgs *args, size_t begin, size_t end, Around *box)
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

/* How near to that box is near enough: a little more than h, since places in the box are rounded. */
SIMD_INLINE float block_reach2(const PairArgs *args)
{
    const float h = args->constants->support_radius;
    return h * h * 1.0001f;
}

/* The lists of a group as they were found, one behind the other, each filled up to whole LANES: where each
   begins and how many entries it has. */
typedef struct Found {
    uint32_t first[LANES], count[LANES], used;
    bool coincident;
} Found;

/* The list that is being written. */
typedef struct Writer {
    int32_t *at;
    int coincident; /* the particle itself is one */
} Writer;

#endif
