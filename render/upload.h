/* The CPU backend's way to the GPU: a ring of persistently mapped slots, one state each.

   A state is written into a slot that no drawing reads any more: when the next state is written, a fence goes
   behind all drawing that was asked for meanwhile, and the slot is taken again only after its fence. Four
   slots, so that one being written, the newest, the one drawn and one in flight never meet. */
#ifndef SLOSH_UPLOAD_H
#define SLOSH_UPLOAD_H

#include "sim/error.h"
#include "sim/gl/particle_buffers.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>

enum { UPLOAD_SLOTS = 4 };

/* Which attributes are carried; positions always are. */
enum {
    UPLOAD_VELOCITY = 1U << SCALAR_COUNT,
    UPLOAD_FLUID = 1U << (SCALAR_COUNT + 1),
    UPLOAD_ID = 1U << (SCALAR_COUNT + 2)
};
#define UPLOAD_SCALAR(scalar) (1U << (scalar))

typedef struct Upload Upload;

/* For at most `capacity` particles; `attributes` is a sum of the bits above. NULL when memory is short. */
Upload *upload_create(size_t capacity, unsigned attributes, Error *error);
void upload_destroy(Upload *upload); /* NULL is allowed */

/* What a picture coloured by that scalar needs. */
unsigned upload_attributes_for(Scalar color_by);

/* Writes the world's state. `out` stays readable until UPLOAD_SLOTS - 1 states later,
   but is to be drawn from only until the next state is written: that is when its fence is made. False when
   the world has more particles than the capacity. */
bool upload_write(Upload *upload, World *world, ParticleBuffers *out, Error *error);

/* The same from plain arrays, for a fluid without a world. `state` gives count, spacing, box, time; its
   attributes and ranges are not read. Arrays that the upload carries must be there. */
bool upload_arrays(Upload *upload, const ParticleArrays *arrays, const ParticleBuffers *state,
                   ParticleBuffers *out, Error *error);

/* The slot of the newest state, 0 .. UPLOAD_SLOTS - 1, or -1. */
int upload_newest(const Upload *upload);

#endif
