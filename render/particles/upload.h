/* States of the CPU backend on the way to the GPU: a ring of four slots between the solver's thread and
   the thread with the OpenGL context. */
#ifndef RENDER_PARTICLES_UPLOAD_H
#define RENDER_PARTICLES_UPLOAD_H

#include "sim/gpu/particle_buffers.h"
#include "slosh/error.h"
#include "slosh/world.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

/* Ownership of the slots in a ring of four, for a writer thread (solver) and a drawing thread that run at
   different rates.

   The writer always finds a free slot and never waits. Of the three other slots, one may hold the newest
   state, one may be drawn, and one may be in flight (the GPU may still read from the slot). The writer
   overwrites the newest state that was not drawn. */

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
bool slots_have_new(Slots *slots);

/* For the drawing thread: draws the newest state, if any, and marks the slot drawn before as in flight.
   Call slots_release_in_flight for an earlier flight first. Returns the drawn slot, SLOT_NONE before the
   first state. */
int slots_draw(Slots *slots);

/* For the drawing thread: the GPU has finished reading the slot in flight. */
void slots_release_in_flight(Slots *slots);

/* Carries states of the CPU backend to the GPU: a ring of persistently mapped slots, one state per slot
   (Slots).

   One thread writes states, needs no GL context and never waits. The thread with the context takes the
   newest state and draws from its slot for any time. The slot is written again only after a fence behind
   the last drawing from that slot. */

typedef struct Upload Upload;

/* For at most `capacity` particles; `attributes` is a sum of PARTICLE_* (sim/gpu/particle_buffers.h).
   Returns NULL if memory is short. */
Upload *upload_create(size_t capacity, unsigned attributes, Error *error);
void upload_destroy(Upload *upload); /* NULL is allowed */

/* The attributes to upload for the states of a world if pictures read `attributes`: birth times come as
   the world's table instead. */
unsigned upload_attributes(unsigned attributes);

/* True: each state taken is copied once into the GPU's own memory, so that the passes do not each read
   over the bus. Default: true, except on a software renderer, which has one memory. Call before the first
   state is taken. Returns false if memory is short. */
bool upload_set_copies(Upload *upload, bool copies, Error *error);

/* Writes the world's state. Returns false if the world has more particles than the capacity, or if memory
   is short. */
bool upload_write(Upload *upload, World *world, Error *error);

/* As upload_write, from plain arrays, for a fluid without a world. `state` gives count, spacing, box and
   time; the attributes in `state` are not read. Each array that the upload carries must be present. */
bool upload_write_arrays(Upload *upload, const ParticleArrays *arrays, const ParticleBuffers *state,
                         Error *error);

/* True if a state waits that upload_take has not returned yet. */
bool upload_has_new(Upload *upload);

/* `out`: the newest state, or the previous state again if there is none newer; valid until the next call.
   Returns false before the first state. Needs the context; waits if the GPU is more than one state behind. */
bool upload_take(Upload *upload, ParticleBuffers *out);

#endif
