/* Ownership of the slots in a ring of four, for a writer thread (solver) and a drawing thread that run at
   different rates.

   The writer always finds a free slot and never waits. Of the three other slots, one may hold the newest
   state, one may be drawn, and one may be in flight (the GPU may still read from the slot). The writer
   overwrites the newest state that was not drawn. */
#ifndef SLOSH_SLOTS_H
#define SLOSH_SLOTS_H

#include <pthread.h>
#include <stdbool.h>

enum { SLOTS = 4, SLOT_NONE = -1 };

typedef struct Slots {
    pthread_mutex_t lock;
    int written, newest, drawn, in_flight; /* a slot's number, or SLOT_NONE */
} Slots;

void slots_create(Slots *slots);
void slots_destroy(Slots *slots);

/* For the writer: `begin` returns a slot without readers; `end` makes this slot the newest. */
int slots_write_begin(Slots *slots);
void slots_write_end(Slots *slots);

/* For the drawing thread: true if a state waits that was not drawn yet. */
bool slots_fresh(Slots *slots);

/* For the drawing thread: draws the newest state, if any, and marks the slot drawn before as in flight.
   Call slots_landed for an earlier flight first. Returns the drawn slot, SLOT_NONE before the first state. */
int slots_draw(Slots *slots);

/* For the drawing thread: the GPU has finished reading the slot in flight. */
void slots_landed(Slots *slots);

#endif
