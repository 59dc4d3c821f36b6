/* The life of foam from picture to picture, for effect_foam and tests.

   Each particle has an amount of foam, 0 to 1, on the way of the particle: the foam of the present state or
   the rest of the picture before, whichever is more. After a time t the rest is exp(-t / FOAM_LIFE). Amounts
   are known by the particles' ids, so order and number of particles may change. Foam of particles under the
   surface, and of single drops, lives on unseen.

   A state without a past has no rest: the first state, a state before the last one in time, and states
   without ids. The same state once more has the same amounts.

   Needs a current OpenGL 4.5 core context. */
#ifndef RENDER_WATER_FOAM_PRIVATE_H
#define RENDER_WATER_FOAM_PRIVATE_H

#include "sim/error.h"
#include "sim/gpu/particle_buffers.h"

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise. */
typedef struct FoamLife {
    unsigned recall, update; /* programs */
    unsigned amounts;        /* buffer: visible foam, a float per particle of the last state */
    size_t capacity;         /* of `amounts`, particles */
    unsigned table;          /* buffer: amounts of the last state by id. Open addressing; a slot has an
                                id + 1, or 0, and the amount */
    size_t slots;            /* a power of two, at least twice the particles; 0: no state yet */
    double time;             /* of the last state, s */
} FoamLife;

/* Returns false if a shader does not compile; call foam_life_destroy in either case. */
bool foam_life_create(FoamLife *life, Error *error);
void foam_life_destroy(FoamLife *life);

/* Takes a state of at least one particle, in two calls. The first: `amounts` is the rest of the past. */
void foam_life_recall(FoamLife *life, const ParticleBuffers *particles);

/* The second: `amounts` is the foam. The result of derived_foam stands in the place of
   SCALAR_TRAPPED_AIR; there are velocities; `foam` is ViewDef.foam, above 0. */
void foam_life_update(FoamLife *life, const ParticleBuffers *particles, double foam);

#endif
