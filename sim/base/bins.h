/* Bins in a row, and items that each reach into a span of adjacent bins. Lists the items of each bin in
   item order, so that work done bin by bin by threads has the same bits for any number of threads. */
#ifndef SLOSH_BINS_H
#define SLOSH_BINS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Reused, so that later fills need no new memory; zero-initialise. */
typedef struct Bins {
    size_t begin_capacity, member_capacity;
    size_t *begin;    /* bins + 1 entries: begin of each bin in `member` */
    uint32_t *member; /* items, ascending in each bin */
} Bins;

/* Bins reached by an item: first <= b < end; none if first is end. */
typedef struct BinSpan {
    size_t first, end;
} BinSpan;

typedef BinSpan (*BinsReached)(const void *context, size_t item);

/* Sorts `items` items, fewer than 2^32, into `count` bins. Returns false if memory is short. */
bool bins_fill(Bins *bins, size_t count, size_t items, BinsReached reached, const void *context);
void bins_free(Bins *bins); /* a zeroed struct is allowed */

#endif
