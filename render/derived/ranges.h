/* The range of a scalar over all particles, computed on the GPU: for every backend and file by one
   definition. Five numbers come back: waited for, or a picture late.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_RANGES_H
#define SLOSH_RANGES_H

#include "sim/base/error.h"
#include "sim/gl/mailbox.h"
#include "sim/gl/particle_buffers.h"

#include <stdbool.h>

/* Whose range: of a state the scalar's values. */
typedef struct RangeOf {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute values;
} RangeOf;

/* Of a scalar that is not waited for. */
typedef struct RangeLate {
    Mailbox found;
    RangeOf asked, of; /* what is on its way; what `range` is of */
    ScalarRange range; /* the last that came */
} RangeLate;

/* Zero-initialise it. */
typedef struct Ranges {
    unsigned count, find; /* programs */
    unsigned bins;        /* buffer, all 0 between two runs */
    Mailbox found;
    RangeLate late[SCALAR_COUNT]; /* made when first asked for */
} Ranges;

/* False when a shader does not compile or memory is short; ranges_destroy is needed in either case. */
bool ranges_create(Ranges *ranges, Error *error);
void ranges_destroy(Ranges *ranges);

/* Of the `count` floats there; what is not finite does not count. All 0, and not `any`, where nothing
   does. Of n values in
   order, from 0, the percentiles are number floor((n - 1) / 100) and its mirror: the ends themselves up to
   100 values. */
ScalarRange ranges_find(Ranges *ranges, const ParticleAttribute *values, size_t count);

/* The same of a state's scalar without waiting, but for the first time: then it may be of the state before,
   and `behind` becomes true. */
ScalarRange ranges_follow(Ranges *ranges, Scalar scalar, const ParticleBuffers *particles, bool *behind);

#endif
