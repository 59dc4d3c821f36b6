/* A world: the state of a fluid in its box, and the time step. The WorldDef names backend and method; both
   come from lists printed by `slosh info`. All functions of a world must be called from a single thread at
   a time. */
#ifndef SLOSH_WORLD_H
#define SLOSH_WORLD_H

#include "sim/base/error.h"
#include "sim/base/scalar.h"
#include "sim/base/stage.h"
#include "sim/matter/forces.h"
#include "sim/matter/world_def.h"
#include "sim/touch/finger.h"
#include "sim/world/reading.h"
#include "sim/world/step_types.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct World World;

/* Creates a world at time 0 with densities and pressures evaluated. Returns NULL with the reason in
   `error`: unknown method or backend, def out of range, or too many particles or cells for the memory. */
World *world_create(const WorldDef *def, Error *error);
void world_destroy(World *world); /* NULL is allowed */

/* True if backend and method exist and support everything that the def names; needs no context.
   world_create also checks. */
bool world_can(const WorldDef *def, Error *error);

/* True if a world of the def can be made here: allocates buffers and compiles shaders, without computing. */
bool world_fits(const WorldDef *def, Error *error);

/* True if the def's backend runs on a GPU. A GL context must then be current for every use of a world of
   the def: the same context from before world_create until after world_destroy. */
bool world_on_gpu(const WorldDef *def);

/* Advances the world to the end of the frame (mode fixed: dt, in `substeps` steps; cfl: a single step).
   Adds stage times to `clock` (NULL: not measured). On trouble the sentinel goes back and halves the step:
   WorldInfo.trouble. Returns false with a message if `retries` halvings did not help: the world then holds
   the last good state, but without retries an invalid state. */
bool world_step(World *world, StageClock *clock, Error *error);

/* The same for a single step of the frame's `substeps`, for callers that act in between. */
bool world_substep(World *world, StageClock *clock, Error *error);

/* In mode cfl, steps before `time` (s) are shortened so that a state falls on `time`; other modes ignore
   the call. Not in the saved state: call again after a resume. */
void world_stop_at(World *world, double time);

/* True if the present state has no known trouble. A GPU backend otherwise checks only at the begin of the
   next frame, which then goes back: call before keeping a state. Waits for the GPU's steps. */
bool world_sound(World *world);

/* Sets the hand's target for the box from the next step on. The box follows through the filter, on top of
   the prescribed motion (sim/box/box_filter.h). The orientation is normalised; a non-finite target is
   ignored. */
void world_set_target(World *world, const BoxTarget *target);

/* Puts the box at the target at once, at rest; the fluid comes along unchanged and feels no force. */
void world_carry(World *world, const BoxTarget *target);

/* Makes room for fluid poured by a finger, up to WorldDef.most; nothing to do if the room exists. Takes as
   long as making the world, and replaces *world. Returns false with the reason: the backend cannot add
   particles, or memory is short. */
bool world_make_room(World **world, Error *error);

/* Sets a finger in the fluid from the next step on, or none. Ignores an invalid finger, and a pouring
   finger without room for particles. Poured fluid is limited to 0.3 of the sound speed and to a quarter of
   the support radius per step. */
void world_touch(World *world, const Finger *finger);

/* Sets the shut gates of emitters and drains from the next step on: bits of sim/matter/flow.h; unknown
   gates are ignored. An open emitter emits the layers due at its time, as if it had never been shut. */
void world_shut(World *world, uint64_t gates);
uint64_t world_gates_shut(const World *world);

/* Takes the live settings from `def`: gravity, viscosities, sound speed, negative pressure, dt, substeps,
   number and max_dt of mode cfl, the hand's limits, live keys of methods. The rest of `def` must be
   unchanged. Takes effect with the next step and belongs to the world's history like a target. Returns
   false with the reason, with nothing changed. */
bool world_change(World *world, const WorldDef *def, Error *error);

/* Reloads the shaders of a GPU backend. Returns false with the reason if a shader is wrong: the old shaders
   stay. */
bool world_reload(World *world, Error *error);

/* Describes the sentinel's finding in a line. */
void world_trouble_words(const WorldTrouble *trouble, char words[160]);

/* Restarts the counts of WorldInfo.solved. */
void world_tally_anew(World *world);

void world_info(const World *world, WorldInfo *info);

void world_sums(World *world, WorldSums *sums);

/* Starts to gather the gauge of the present state: queued after a GPU's steps, without waiting. No effect
   while an earlier gauge is under way. A world that is never asked has no pass and no buffer for the
   gauge. */
void world_gauge_ask(World *world);

/* True once per question, as soon as the answer is ready; never waits. On the CPU the answer is ready at
   once. */
bool world_gauge(World *world, WorldGauge *gauge);

/* From now on, steps sum the fluid's forces on box and solids; without this call there is no cost. Returns
   false with the reason: the backend cannot sum forces, or memory is short. */
bool world_feel(World *world, Error *error);

/* From now on, the world keeps the particles' acceleration, as with WorldDef.acceleration; unknown before
   the next step. No effect if already kept. Returns false with the reason: the backend cannot, or memory is
   short. */
bool world_keep_acceleration(World *world, Error *error);

/* Mean forces since the last call or since world_feel; `seconds` is 0 if there was no step. Steps taken
   back by the sentinel do not count. */
void world_forces(World *world, Forces *forces);

/* Returns false, with unusable arrays, if memory is short. */
bool world_read(World *world, const ParticleArrays *out);

/* A hash of id, position and velocity of every particle in the order of ids, and of pose and motion of
   floating solids: equal for equal bits; 0 if memory is short. */
uint64_t world_hash(World *world);

/* Lists of names, ended by a NULL name. */
typedef struct Named {
    const char *name, *help;
} Named;

/* Defaults of every field except the box, the spacing and the fluids, for scenes without a value. The
   reason for each number is in world_default.c. */
WorldDef world_def_default(void);

const Named *world_methods(void);
const Named *world_backends(void);

/* The def's number of threads for backend cpu, to read and set; 0: a thread per processor. */
int *world_threads(const WorldDef *def);

/* Processors of this machine. */
int world_processors(void);

#endif
