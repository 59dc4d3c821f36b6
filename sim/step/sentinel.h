/* Detects energy gained without work. A step too long for friction heats fluid at rest, even without large
   moves of particles. The watched energy is the energy of motion and compression, of fluids and floating
   solids. The method must give its energy of compression or be incompressible. Without trouble, energy
   minus the work done does not grow.

   Work comes from:
   - gravity and the box's motion, by sums over the particles at two looks; if the box's velocity jumps in
     a step, the looks are at both ends of the step;
   - solids with prescribed motion, by the forces on these solids;
   - emitters: emitted fluid brings energy, and the emitter holds fluid to its course. Drained fluid takes
     its energy along.

   For surface energy only a bound is known: tension may free all surface energy present, as a lid may drag
   fluid to the lid's speed. A world touched by a finger is not watched.

   On a GPU, the sums are read now and then, at the end of a frame whose results were waited for, and at both
   ends of a step in which the box's velocity jumps. */
#ifndef SIM_STEP_SENTINEL_H
#define SIM_STEP_SENTINEL_H

#include "sim/step/energy_unwatched.h"
#include "sim/step/world.h"

/* Call after each sound step (on a GPU: each frame) and for the initial state. Returns false if energy has
   grown, with the reason in world->seen; compares only at the ends of frames. */
bool energy_is_valid(World *world);

/* Call before a step. `begin`: the box at the step's begin; world->box is at the end. */
void energy_brace(World *world, const BoxState *begin);

/* Reports that `number` particles of a layer were emitted. */
void energy_comes(World *world, const EmitLayer *layer, size_t number);

/* energy_asks_solids: true if the watch needs forces on solids. Then call energy_of_solids after each step
   with the forces and the solids' steps. */
bool energy_asks_solids(const World *world);
void energy_of_solids(World *world, const Forces *felt, const SolidStep solids[SOLIDS_MAX]);

/* Call after unknown work or a change of the energy's definition: comparison restarts with the next frame. */
void energy_forget(World *world);

/* The sentinel: after trouble the world goes back to the last good state and halves the step. */

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
