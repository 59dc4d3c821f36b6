/* Who may touch which slot of a ring of four, when a solver and a view run at their own pace.

   The writer always finds a free slot and never waits: of the others one at most is the newest state, one is
   drawn, one is in flight (a GPU may still read it). What is overwritten is the newest state that nobody
   took. One thread writes, one thread draws. */
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

/* For the writer: `begin` gives a slot that nobody reads; with `end` this slot is the newest. */
int slots_write_begin(Slots *slots);
void slots_write_end(Slots *slots);

/* The drawing thread: whether a state waits that was not drawn yet. */
bool slots_fresh(Slots *slots);

/* The drawing thread: makes the newest state, if there is one, the drawn one, and what was drawn before the
   one in flight. slots_landed must have ended an earlier flight. Returns the drawn slot, SLOT_NONE before the
   first. */
int slots_draw(Slots *slots);

/* The drawing thread: the GPU reads the slot in flight no more. */
void slots_landed(Slots *slots);

#endif
