/* Interpolation between two states: particles and box at a time between two steps. */
#ifndef APP_RUN_PLAYBACK_INTERPOLATE_H
#define APP_RUN_PLAYBACK_INTERPOLATE_H

#include "sim/gpu/particle_buffers.h"
#include "slosh/world.h"

/* A state in memory; empty when zeroed. */
typedef struct StateCopy {
    ParticleBuffers state; /* attributes unused */
    ParticleArrays arrays; /* owned; velocity, fluid and id always, plus the requested scalars */
    size_t room;           /* particles */
} StateCopy;

void state_copy_free(StateCopy *copy);

/* Makes room for `count` particles with the attributes (PARTICLE_*). Returns false if memory is short. */
bool state_copy_reserve(StateCopy *copy, size_t count, unsigned attributes);

/* Reads the world's present state; waits for a GPU. Returns false if memory is short. */
bool state_copy_read(StateCopy *copy, World *world, unsigned attributes);

/* Interpolates both states at `time` (s). A particle, found by its id, follows the cubic curve with its
   positions and velocities at both states, the short way across periodic sides. The box is interpolated
   separately, scalars linearly. A particle of one state only (emitted, drained) moves on with its velocity,
   and exists in the half of the step nearer to its state. `out` has room for the particles of both states.
   Returns false if memory is short. */
bool interpolate_states(const StateCopy *before, const StateCopy *after, const bool periodic[3], double time,
                        StateCopy *out);

#endif
