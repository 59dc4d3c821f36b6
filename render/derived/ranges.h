/* The range of a scalar over all particles, computed on the GPU: for every backend and file by one
   definition. Waits for the GPU: five numbers come back.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_RANGES_H
#define SLOSH_RANGES_H

#include "sim/base/error.h"
#include "sim/gl/mailbox.h"
#include "sim/gl/particle_buffers.h"

#include <stdbool.h>

/* Zero-initialise it. */
typedef struct Ranges {
    unsigned count, find; /* programs */
    unsigned bins;        /* buffer, all 0 between two runs */
    Mailbox found;
} Ranges;

/* False when a shader does not compile or memory is short; ranges_destroy is needed in either case. */
bool ranges_create(Ranges *ranges, Error *error);
void ranges_destroy(Ranges *ranges);

/* Of the `count` floats there; what is not finite does not count. All 0, and not `any`, where nothing
   does. Of n values in
   order, from 0, the percentiles are number floor((n - 1) / 100) and its mirror: the ends themselves up to
   100 values. */
ScalarRange ranges_find(Ranges *ranges, const ParticleAttribute *values, size_t count);

#endif
