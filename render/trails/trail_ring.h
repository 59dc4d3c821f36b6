/* When the points of trails were taken: all trails have theirs at the same times, so that one ring of columns
   serves them all, and going back in time takes columns away.

   The columns behind the present state are fixed, at least `every` apart. The present state is in the column
   behind them, the head, which the next state replaces unless it has become fixed. */
#ifndef SLOSH_TRAIL_RING_H
#define SLOSH_TRAIL_RING_H

#include "sim/base/scalar.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct TrailColumn {
    double time;   /* s */
    Scalar scalar; /* whose values the column has */
    bool broken;   /* no line leads here from the column before: nobody has seen what was between */
} TrailColumn;

typedef struct TrailRing {
    TrailColumn *column; /* `room` of them: number k stands at k % room */
    int room;
    double length, every; /* s */
    uint64_t begin, end;  /* the fixed columns' numbers: begin .. end - 1 */
    uint64_t head;  /* number of the column with the present state: end, or end - 1 where that one is fixed */
    uint64_t drops; /* how often columns were taken away at the end */
    double gap;     /* between the last two states, s; 0: not known */
    double now;     /* the present state's time, s */
} TrailRing;

/* For trails of that length. False when memory is short. */
bool trail_ring_create(TrailRing *ring, double length, double every, int points);
void trail_ring_destroy(TrailRing *ring); /* a zeroed one is allowed */

/* The present state is that of `time`, whose place is the column ring->head from now on. What is not older
   goes, as after a step back; what is older than the length too. */
void trail_ring_take(TrailRing *ring, double time, Scalar scalar);

/* Forgets all columns. */
void trail_ring_clear(TrailRing *ring);

TrailColumn *trail_ring_at(const TrailRing *ring, uint64_t number);

/* Whether a line leads from the column before to this one; both are there. */
bool trail_ring_joins(const TrailRing *ring, uint64_t number);

#endif
