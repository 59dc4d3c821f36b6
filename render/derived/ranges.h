/* The range of a scalar over all particles, computed on the GPU: one definition for every backend and
   file. The host reads five numbers, waiting or one picture late.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_RANGES_H
#define SLOSH_RANGES_H

#include "sim/base/error.h"
#include "sim/gl/mailbox.h"
#include "sim/gl/particle_buffers.h"

#include <stdbool.h>

/* Identifies values: a state and its scalar. */
typedef struct RangeOf {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute values;
} RangeOf;

/* A scalar's range that is not waited for. */
typedef struct RangeLate {
    Mailbox found;
    RangeOf asked, of; /* request in flight; source of `range` */
    ScalarRange range; /* the last answer */
} RangeLate;

/* Zero-initialise. */
typedef struct Ranges {
    unsigned count, find; /* programs */
    unsigned bins;        /* buffer, all 0 between two runs */
    Mailbox found;
    RangeLate late[SCALAR_COUNT]; /* created on first use */
} Ranges;

/* Returns false if a shader does not compile or memory is short; call ranges_destroy in either case. */
bool ranges_create(Ranges *ranges, Error *error);
void ranges_destroy(Ranges *ranges);

/* The range of `count` floats; values that are not finite are left out. All 0, and `any` false, if no
   value is finite. For n values in order, counted from 0, the percentiles are value floor((n - 1) / 100)
   and its mirror: up to 100 values, the ends. */
ScalarRange ranges_find(Ranges *ranges, const ParticleAttribute *values, size_t count);

/* As ranges_find, for a state's scalar, without waiting except for the first time. The range may be of an
   earlier state; then *behind becomes true. */
ScalarRange ranges_follow(Ranges *ranges, Scalar scalar, const ParticleBuffers *particles, bool *behind);

#endif
