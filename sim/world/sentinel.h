/* The sentinel: after trouble the world goes back to its last good state and takes half the step. */
#ifndef SLOSH_SENTINEL_H
#define SLOSH_SENTINEL_H

#include "sim/world/world_struct.h"

/* At the begin of a frame: keeps the state. False when memory is short. */
bool sentinel_mark(World *world, Error *error);

/* At the begin of a frame: after many calm steps the last halving is taken back, where friction
   stands the longer step. */
void sentinel_relieve(World *world);

/* Behind a step that is not looked at before its frame ends: a solver of it in trouble is remembered until
   then. Where numbers are none any more the watch of the frame has it, in better words. */
void sentinel_note_solves(World *world);

/* After a step that ended at `time` with trouble, world->seen: the last good state again, with half the step.
   The number of steps goes on, and what the hand and the keys have said since stays said, so that a recorded
   session comes out the same. False, with that state and the reason, when the step was halved `retries` times
   already. */
bool sentinel_back(World *world, double time, Error *error);

#endif
