#include "render/trails/trail_ring.h"

#include <math.h>
#include <stdlib.h>

bool trail_ring_create(TrailRing *ring, double length, double every, int points)
{
    const int room = points + 1;
    *ring = (TrailRing){.room = room, .length = length, .every = every};
    ring->column = calloc((size_t)room, sizeof *ring->column);
    return ring->column != NULL;
}

void trail_ring_destroy(TrailRing *ring)
{
    free(ring->column);
    *ring = (TrailRing){0};
}

void trail_ring_clear(TrailRing *ring)
{
    ring->begin = ring->end;
    ring->gap = 0;
    ring->drops++;
}

TrailColumn *trail_ring_at(const TrailRing *ring, uint64_t number)
{
    return &ring->column[number % (uint64_t)ring->room];
}

bool trail_ring_joins(const TrailRing *ring, uint64_t number)
{
    return number > ring->begin && !trail_ring_at(ring, number)->broken;
}

static double newest(const TrailRing *ring)
{
    return trail_ring_at(ring, ring->end - 1)->time;
}

/* Almost equal times are of the same state, or of a substitute. */
static void drop_newer(TrailRing *ring, double time)
{
    const uint64_t end = ring->end;
    while (ring->end > ring->begin && newest(ring) >= time - 1e-9 * fmax(fabs(time), ring->every))
        ring->end--;
    ring->drops += ring->end < end;
}

static void drop_old(TrailRing *ring)
{
    while (ring->end - ring->begin >= (uint64_t)ring->room)
        ring->begin++;
    while (ring->begin + 1 < ring->end &&
           trail_ring_at(ring, ring->begin + 1)->time < ring->now - ring->length)
        ring->begin++;
}

/* The motion during a gap is unknown if the gap is longer than a trail, or suddenly long: a jump in time,
   or a window that stood still. A film that plays fast has such gaps all the time, which are no jumps. */
static bool is_jump(const TrailRing *ring, double gap)
{
    return gap > ring->length || (ring->gap > 0 && gap > 8 * ring->gap && gap > ring->length / 4);
}

void trail_ring_take(TrailRing *ring, double time, Scalar scalar)
{
    const double gap = time - ring->now;
    drop_newer(ring, time);
    const bool first = ring->end == ring->begin, back = gap <= 0;
    const bool broken = first || (!back && is_jump(ring, gap));
    ring->now = time;
    ring->gap = back || first ? 0 : gap;
    ring->head = ring->end;
    *trail_ring_at(ring, ring->head) = (TrailColumn){time, scalar, broken};
    if (broken || time - newest(ring) >= 0.999 * ring->every)
        ring->end++;
    drop_old(ring);
}
