/* The times of the trails' points. All trails have points at the same times: one ring of columns is
   enough, and a step back in time removes columns.

   Columns before the present state are fixed, at least `every` apart. The present state is in the next
   column, the head, which the next state replaces unless the head has become fixed. */
#ifndef SLOSH_TRAIL_RING_H
#define SLOSH_TRAIL_RING_H

#include "sim/base/scalar.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct TrailColumn {
    double time;   /* s */
    Scalar scalar; /* scalar of the column's values */
    bool broken;   /* no line leads here from the previous column: the states between are unknown */
} TrailColumn;

typedef struct TrailRing {
    TrailColumn *column; /* array of `room`: number k is at k % room */
    int room;
    double length, every; /* s */
    uint64_t begin, end;  /* numbers of the fixed columns: begin .. end - 1 */
    uint64_t head;        /* number of the present state's column: `end`, or end - 1 if fixed */
    uint64_t drops;       /* number of removals of columns at the end */
    double gap;           /* time between the last two states, s; 0: unknown */
    double now;           /* the present state's time, s */
} TrailRing;

/* For trails of `length`. Returns false if memory is short. */
bool trail_ring_create(TrailRing *ring, double length, double every, int points);
void trail_ring_destroy(TrailRing *ring); /* a zeroed struct is allowed */

/* Sets the present state's time; the state's column is now ring->head. Removes columns that are not older
   (after a step back), and columns older than the length. */
void trail_ring_take(TrailRing *ring, double time, Scalar scalar);

/* Forgets all columns. */
void trail_ring_clear(TrailRing *ring);

TrailColumn *trail_ring_at(const TrailRing *ring, uint64_t number);

/* True if a line leads from the previous column to column `number`; both must exist. */
bool trail_ring_joins(const TrailRing *ring, uint64_t number);

#endif
