/* The sentinel: after trouble the world goes back to the last good state and halves the step. */
#ifndef SLOSH_SENTINEL_H
#define SLOSH_SENTINEL_H

#include "sim/world/world_struct.h"

/* At the begin of a frame: keeps the state. Returns false if memory is short. */
bool sentinel_mark(World *world, Error *error);

/* At the begin of a frame: after many calm steps, takes back the last halving if friction allows the longer
   step. */
void sentinel_relieve(World *world);

/* Call after a step that is checked only at the end of its frame: remembers a solver in trouble until then.
   For non-finite residuals the frame's watch reports in better words. */
void sentinel_note_solves(World *world);

/* After a step with trouble (world->seen) that ended at `time`: restores the last good state and halves the
   step. The step number goes on, and settings by hand and keys since then stay, so that a recorded session
   gives the same result. Returns false, with the good state and the reason, if the step was already halved
   `retries` times. */
bool sentinel_back(World *world, double time, Error *error);

#endif
