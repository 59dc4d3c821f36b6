/* A world: the state of a fluid in its box, and the step that carries it on.

   The backend and the method are named in the WorldDef; both stand in one list each, which `slosh info`
   prints. All functions of one world belong to one thread at a time. */
#ifndef SLOSH_WORLD_H
#define SLOSH_WORLD_H

#include "sim/base/error.h"
#include "sim/base/scalar.h"
#include "sim/base/stage.h"
#include "sim/matter/forces.h"
#include "sim/matter/world_def.h"
#include "sim/touch/finger.h"
#include "sim/world/reading.h"
#include "sim/world/step_control.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct World World;

/* A world at time 0, its densities and pressures evaluated, or NULL with the reason in `error`: an unknown
   method or backend, a def out of range, too many particles or cells for the memory. */
World *world_create(const WorldDef *def, Error *error);
void world_destroy(World *world); /* NULL is allowed */

/* Whether backend and method are there and have all that the def names; needs no context. World_create asks
   too. */
bool world_can(const WorldDef *def, Error *error);

/* Whether a world of the def could be made here: shaders and buffers are tried, and nothing is computed. */
bool world_fits(const WorldDef *def, Error *error);

/* Whether the def's backend works on a GPU: a GL context must then be current wherever a world of it is used,
   the same one, from before world_create until after world_destroy. */
bool world_on_gpu(const WorldDef *def);

/* Carries the world one frame on (mode fixed: dt, in `substeps` steps; cfl: one step), or what is left of it;
   stage times go into `clock` (NULL: not measured). On trouble the sentinel goes back and halves the step:
   WorldInfo.trouble. False with a message when that did not help, `retries` times: the world then holds the
   last good state; without retries what it holds is of no use. */
bool world_step(World *world, StageClock *clock, Error *error);

/* The same for one step of the frame's `substeps`: for who wants a say in between. */
bool world_substep(World *world, StageClock *clock, Error *error);

/* In mode cfl the steps before `time` (s) are shortened so that a state falls on it; other modes take no
   notice. No part of the saved state: whoever goes on from one asks again. */
void world_stop_at(World *world, double time);

/* Whether no trouble is known of the present state. A backend on a GPU is else asked at the begin of the next
   frame only, which then goes back: who keeps a state asks before. Waits for its steps. */
bool world_sound(World *world);

/* Where the hand wants the box from the next step on: the box follows through the filter, on top of the
   prescribed motion (sim/box/box_filter.h). The orientation is normalised; one that is not finite is not
   taken.
 */
void world_set_target(World *world, const BoxTarget *target);

/* Puts the box there at once and at rest; the fluid comes along as it is and feels no force. */
void world_carry(World *world, const BoxTarget *target);

/* Room for what a finger pours, up to WorldDef.most; nothing where it is there. It takes as long as making
   the world does, and *world is then another one. False with the reason: the backend takes no new particles,
   or memory is short. */
bool world_make_room(World **world, Error *error);

/* A finger in the fluid from the next step on, or none; what is no finger is not taken, nor one that pours
   where there is no room. What is poured is held to 0.3 of sound and a quarter of the support radius a step.
 */
void world_touch(World *world, const Finger *finger);

/* Which gates of emitters and drains are shut from the next step on: bits of sim/matter/flow.h; what has no
   gate is left out. An open emitter sends out the layers that its time has, as if it had never been shut. */
void world_shut(World *world, uint64_t gates);
uint64_t world_gates_shut(const World *world);

/* Takes from `def` what may change while a world lives: gravity, viscosities, sound speed, negative pressure,
   dt, substeps, number and max_dt of mode cfl, the hand's limits, live keys of methods; all else must be as
   it was. It holds from the next step on, and is as much a part of the world's history as a target is. False
   with the reason: nothing has changed. */
bool world_change(World *world, const WorldDef *def, Error *error);

/* Reads the shaders of a backend on a GPU again; false with the reason where one is wrong: those before stay.
 */
bool world_reload(World *world, Error *error);

/* What the sentinel found, for a line. */
void world_trouble_words(const WorldTrouble *trouble, char words[160]);

/* WorldInfo.solved counts from here on. */
void world_tally_anew(World *world);

void world_info(const World *world, WorldInfo *info);

void world_sums(World *world, WorldSums *sums);

/* Begins to gather the gauge of the present state: behind the steps in a GPU's queue, without waiting.
   Nothing while an earlier one is on its way. A world that is never asked has no pass and no buffer for it.
 */
void world_gauge_ask(World *world);

/* True once for each question, as soon as its answer has come; never waits. On the CPU it comes at once. */
bool world_gauge(World *world, WorldGauge *gauge);

/* From now on steps sum what the fluid does to box and solids; a world that is never asked pays nothing.
   False with the reason: the backend has no such sums, or memory is short. */
bool world_feel(World *world, Error *error);

/* From now on the world keeps the acceleration of its particles, as if WorldDef.acceleration had been set; it
   is not known before the next step. Nothing where it does already. False with the reason: the backend
   cannot, or memory is short. */
bool world_keep_acceleration(World *world, Error *error);

/* The means since the last call, or since world_feel; `seconds` is 0 where there was no step. Steps that the
   sentinel took back do not count. */
void world_forces(World *world, Forces *forces);

/* False, and nothing of use in the arrays, when memory is short. */
bool world_read(World *world, const ParticleArrays *out);

/* A hash of id, position and velocity of every particle in the order of their ids, and of where solids that
   float are and go: equal for equal bits; 0
   when memory is short. */
uint64_t world_hash(World *world);

/* The lists of what there is, ended by a NULL name. */
typedef struct Named {
    const char *name, *help;
} Named;

/* The defaults of every field but the box, the spacing, the fluids: what a scene that says nothing gets. The
   reason for each number stands beside it in world_default.c. */
WorldDef world_def_default(void);

const Named *world_methods(void);
const Named *world_backends(void);

/* The def's threads of the backend on the CPU, to be read and set; 0: one a processor. */
int *world_threads(const WorldDef *def);

/* Processors of this machine. */
int world_processors(void);

#endif
