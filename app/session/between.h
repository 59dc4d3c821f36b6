/* Interpolation between two states: particles and box at a time between two steps. */
#ifndef SLOSH_BETWEEN_H
#define SLOSH_BETWEEN_H

#include "sim/gl/particle_buffers.h"
#include "sim/world/world.h"

/* A state in memory; empty when zeroed. */
typedef struct Still {
    ParticleBuffers state; /* attributes unused */
    ParticleArrays arrays; /* owned; velocity, fluid and id always, plus the requested scalars */
    size_t room;           /* particles */
} Still;

void still_free(Still *still);

/* Makes room for `count` particles with the attributes (PARTICLE_*). Returns false if memory is short. */
bool still_reserve(Still *still, size_t count, unsigned attributes);

/* Reads the world's present state; waits for a GPU. Returns false if memory is short. */
bool still_read(Still *still, World *world, unsigned attributes);

/* Interpolates both states at `time` (s). A particle, found by its id, follows the cubic curve with its
   positions and velocities at both states, the short way across periodic sides. The box is interpolated
   separately, scalars linearly. A particle of one state only (emitted, drained) moves on with its velocity,
   and exists in the half of the step nearer to its state. `out` has room for the particles of both states.
   Returns false if memory is short. */
bool between_states(const Still *before, const Still *after, const bool periodic[3], double time, Still *out);

#endif
