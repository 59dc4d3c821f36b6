/* Carries states of the CPU backend to the GPU: a ring of persistently mapped slots, one state per slot
   (render/particles/slots.h).

   One thread writes states, needs no GL context and never waits. The thread with the context takes the
   newest state and draws from its slot for any time. The slot is written again only after a fence behind
   the last drawing from that slot. */
#ifndef SLOSH_UPLOAD_H
#define SLOSH_UPLOAD_H

#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"
#include "sim/world/world.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct Upload Upload;

/* For at most `capacity` particles; `attributes` is a sum of PARTICLE_* (sim/gl/particle_buffers.h).
   Returns NULL if memory is short. */
Upload *upload_create(size_t capacity, unsigned attributes, Error *error);
void upload_destroy(Upload *upload); /* NULL is allowed */

/* The attributes to upload for the states of a world if pictures read `attributes`: birth times come as
   the world's table instead. */
unsigned upload_of_worlds(unsigned attributes);

/* True: each state taken is copied once into the GPU's own memory, so that the passes do not each read
   over the bus. Default: true, except on a software renderer, which has one memory. Call before the first
   state is taken. Returns false if memory is short. */
bool upload_set_copies(Upload *upload, bool copies, Error *error);

/* Writes the world's state. Returns false if the world has more particles than the capacity, or if memory
   is short. */
bool upload_write(Upload *upload, World *world, Error *error);

/* As upload_write, from plain arrays, for a fluid without a world. `state` gives count, spacing, box and
   time; the attributes in `state` are not read. Each array that the upload carries must be present. */
bool upload_arrays(Upload *upload, const ParticleArrays *arrays, const ParticleBuffers *state, Error *error);

/* True if a state waits that upload_take has not returned yet. */
bool upload_fresh(Upload *upload);

/* `out`: the newest state, or the previous state again if there is none newer; valid until the next call.
   Returns false before the first state. Needs the context; waits if the GPU is more than one state behind. */
bool upload_take(Upload *upload, ParticleBuffers *out);

#endif
