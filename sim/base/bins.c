#include "sim/base/bins.h"

#include "sim/base/grow.h"

#include <stdlib.h>
#include <string.h>

void bins_free(Bins *bins)
{
    free(bins->begin);
    free(bins->member);
    *bins = (Bins){0};
}

/* Counting sort: `begin` first counts the members of each bin, then holds the next free entry per bin. */
bool bins_fill(Bins *bins, size_t count, size_t items, BinsReached reached, const void *context)
{
    size_t total = 0;
    if (!array_grow((void **)&bins->begin, &bins->begin_capacity, count + 1, sizeof *bins->begin))
        return false;
    memset(bins->begin, 0, (count + 1) * sizeof *bins->begin);
    for (size_t i = 0; i < items; i++) {
        const BinSpan span = reached(context, i);
        for (size_t b = span.first; b < span.end; b++)
            bins->begin[b]++;
    }
    for (size_t b = 0; b <= count; b++) {
        const size_t here = bins->begin[b];
        bins->begin[b] = total;
        total += here;
    }
    if (!array_grow((void **)&bins->member, &bins->member_capacity, total, sizeof *bins->member))
        return false;
    for (size_t i = 0; i < items; i++) {
        const BinSpan span = reached(context, i);
        for (size_t b = span.first; b < span.end; b++)
            bins->member[bins->begin[b]++] = (uint32_t)i;
    }
    memmove(bins->begin + 1, bins->begin, count * sizeof *bins->begin);
    bins->begin[0] = 0;
    return true;
}
