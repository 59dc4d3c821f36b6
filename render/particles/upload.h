/* The CPU backend's way to the GPU: a ring of persistently mapped slots, one state each
   (render/particles/slots.h).

   One thread writes states; it needs no GL context and never waits. The thread of the context takes the
   newest one and draws from it for as long as it likes; a slot is written again only after a fence behind the
   last drawing that read it. */
#ifndef SLOSH_UPLOAD_H
#define SLOSH_UPLOAD_H

#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"
#include "sim/world/world.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct Upload Upload;

/* For at most `capacity` particles; `attributes` is a sum of PARTICLE_* (sim/gl/particle_buffers.h). NULL
 * when memory is short. */
Upload *upload_create(size_t capacity, unsigned attributes, Error *error);
void upload_destroy(Upload *upload); /* NULL is allowed */

/* What it carries for the states of worlds where pictures read these: births come as the world's table. */
unsigned upload_of_worlds(unsigned attributes);

/* Whether each state that is taken is copied once into the GPU's own memory, from which all passes of its
   pictures read it, and not each over the bus. At first: yes, but on a software renderer, which has one
   memory. To be said before the first state is taken. False when memory is short. */
bool upload_set_copies(Upload *upload, bool copies, Error *error);

/* Writes the world's state. False when the world has more particles than the capacity. */
bool upload_write(Upload *upload, World *world, Error *error);

/* The same from plain arrays, for a fluid without a world. `state` gives count, spacing, box, time; its
   attributes are not read. Arrays that the upload carries must be there. */
bool upload_arrays(Upload *upload, const ParticleArrays *arrays, const ParticleBuffers *state, Error *error);

/* Whether a state waits that upload_take has not handed out yet. */
bool upload_fresh(Upload *upload);

/* The newest state, or the one that was newest the last time; it stays as it is until the next call. False
   before the first state. Needs the context; waits when the GPU is more than one state behind. */
bool upload_take(Upload *upload, ParticleBuffers *out);

#endif
