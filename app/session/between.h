/* A picture between two states: particles and box at a time that the steps have left out. */
#ifndef SLOSH_BETWEEN_H
#define SLOSH_BETWEEN_H

#include "sim/gl/particle_buffers.h"
#include "sim/world/world.h"

/* A state in memory. Zeroed it is empty. */
typedef struct Still {
    ParticleBuffers state; /* its attributes are not read */
    ParticleArrays arrays; /* owned; velocity, fluid and id always, scalars that were asked for */
    size_t room;           /* particles */
} Still;

void still_free(Still *still);

/* Room for so many particles with those attributes (PARTICLE_*). False when memory is short. */
bool still_reserve(Still *still, size_t count, unsigned attributes);

/* The world's present state; waits for a GPU. False when memory is short. */
bool still_read(Still *still, World *world, unsigned attributes);

/* What is at `time` (s) between the states: each particle, found by its id, on the cubic curve that has its
   positions and velocities at both, the short way across periodic sides; the box on its own; scalars in
   proportion. What is in one state alone (let in, drained) goes on by its velocity, and is there in the half
   of the step that is nearer to that state. `out` has the room of both together. False when memory is short.
 */
bool between_states(const Still *before, const Still *after, const bool periodic[3], double time, Still *out);

#endif
