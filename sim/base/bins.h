/* Bins in a row, and items of which each reaches into some that lie side by side: the items of each bin, in
   their own order, so that what threads do bin by bin has the same bits for any number of them. */
#ifndef SLOSH_BINS_H
#define SLOSH_BINS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Kept from time to time so that each needs no new memory; zero-initialise it. */
typedef struct Bins {
    size_t begin_capacity, member_capacity;
    size_t *begin;    /* bins + 1: of each bin in `member` */
    uint32_t *member; /* items, ascending in each bin */
} Bins;

/* The bins that an item reaches into: first <= b < end, none where first is end. */
typedef struct BinSpan {
    size_t first, end;
} BinSpan;

typedef BinSpan (*BinsReached)(const void *context, size_t item);

/* Sorts `items` items, fewer than 2^32, into `count` bins. False when memory is short. */
bool bins_fill(Bins *bins, size_t count, size_t items, BinsReached reached, const void *context);
void bins_free(Bins *bins); /* a zeroed one is allowed */

#endif
