#include "sim/base/base.h"

#include "sim/mesh.h"
#include "sim/state.h"

#include <math.h>
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

static bool make_room(Births *births, size_t capacity)
{
    if (capacity <= births->capacity)
        return true;
    Birth *of = realloc(births->of, capacity * sizeof *of);
    if (!of)
        return false;
    births->of = of;
    births->capacity = capacity;
    return true;
}

bool births_reserve(Births *births, size_t more)
{
    const size_t count = births->count + more;
    return count <= births->capacity || make_room(births, count + count / 2 + 16);
}

void births_add(Births *births, ParticleId first_id, float time)
{
    births->of[births->count++] = (Birth){first_id, time, 0};
}

void births_cut(Births *births, uint64_t end)
{
    while (births->count > 0 && births->of[births->count - 1].first_id >= end)
        births->count--;
}

bool births_copy(const Births *from, Births *to)
{
    if (!make_room(to, from->count))
        return false;
    if (from->count > 0)
        memcpy(to->of, from->of, from->count * sizeof *to->of);
    to->count = from->count;
    return true;
}

static int by_id(const void *a, const void *b)
{
    const ParticleId one = ((const Birth *)a)->first_id, other = ((const Birth *)b)->first_id;
    return (one > other) - (one < other);
}

/* True if equal, or both unknown (NaN). */
static bool is_same(float time, float other)
{
    return time == other || (isnan(time) && isnan(other));
}

bool births_gather(Births *births, const ParticleId *id, const float *time, size_t count)
{
    births->count = 0;
    if (!make_room(births, count))
        return false;
    Birth *of = births->of;
    for (size_t i = 0; i < count; i++)
        of[i] = (Birth){id[i], time[i], 0};
    if (count > 0)
        qsort(of, count, sizeof *of, by_id);
    for (size_t i = 0; i < count; i++)
        if (births->count == 0 || !is_same(of[births->count - 1].time, of[i].time))
            of[births->count++] = of[i];
    return true;
}

/* Number of entries that begin at the id or before. */
static size_t begun(const Births *births, ParticleId id)
{
    size_t low = 0, high = births->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (births->of[middle].first_id <= id)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

float births_time(const Births *births, ParticleId id)
{
    const size_t at = begun(births, id);
    return at > 0 ? births->of[at - 1].time : 0;
}

void births_keep(Births *births, const ParticleId *id, size_t count)
{
    bool *left = calloc(births->count + 1, sizeof *left);
    size_t kept = 0;
    if (!left)
        return;
    left[births->count] = true;
    for (size_t i = 0; i < count; i++)
        left[begun(births, id[i])] = true;
    for (size_t k = 0; k < births->count; k++)
        if (left[k + 1])
            births->of[kept++] = births->of[k];
    births->count = kept;
    free(left);
}

void births_free(Births *births)
{
    free(births->of);
    *births = (Births){0};
}
