/* The one saved state of a world (DESIGN 2): all that its next step reads. Snapshots, resume, going back
   after trouble and a change of backend use it and nothing else: save, load, step is step, to the bit. */
#ifndef SLOSH_WORLD_STATE_H
#define SLOSH_WORLD_STATE_H

#include "sim/base/births.h"
#include "sim/body/body_state.h"
#include "sim/world/column.h"
#include "sim/world/live.h"
#include "sim/world/reading.h"
#include "sim/world/step_control.h"
#include "sim/world/world.h"

#include <stddef.h>

struct Method; /* sim/world/method.h */

/* What sim/world/energy_watch.h compares with; zero: nothing yet. */
typedef struct EnergyMark {
    double least;   /* energy of motion and compression less the work done since the first look, J */
    double until;   /* the step after which another takes its place */
    double next;    /* the step that looks again, sooner if a particle is much faster than */
    double speed;   /* at the last look, m/s */
    double work;    /* since the first look, of gravity and of what the box's motion is for the fluid, J */
    double stirred; /* its amount since `least`, whatever its sign, J */
    double surface; /* what tension might set free then, J */
    double most;    /* how much more energy than `least` was trouble at the last look, J */
    double jolted;  /* not 0: the box's velocity jumps in the step in hand */
    double turning; /* not 0: the sums have what a box that turns asks */
    double gauged;  /* not 0: they are of the gauge of a GPU */
    double time;    /* of the last look, s; what was found there: */
    EnergySums sums;
    BoxState box;
} EnergyMark;

/* What is not of a particle. Doubles only, so that it is also an array of WORLD_NUMBERS of them: files keep
   it as that. */
typedef struct WorldNumbers {
    double version;            /* WORLD_STATE_VERSION */
    double step, since_step;   /* substeps; where the present dt began */
    double since_time;         /* s, then */
    double guarded;            /* as WorldInfo has it */
    double emitted, drained;   /* the same */
    StepState stepping;        /* how it steps */
    BoxTarget target;          /* of the hand */
    BoxFilter filter;          /* where its part of the pose is */
    BoxState box;              /* the pose, in the world's frame */
    double live[LIVE_NUMBERS]; /* of the def, what may change while a world lives */
    EnergyMark energy;         /* these stand last: files may end before them */
    FingerState finger;
    double
        shut; /* which gates of emitters and drains are, as the bits of a whole number: sim/matter/flow.h */
    double pours;      /* s: since when the finger does so */
    BodyStates bodies; /* solids that float */
} WorldNumbers;

enum {
    WORLD_STATE_VERSION = 4,
    WORLD_NUMBERS = sizeof(WorldNumbers) / sizeof(double),
    WORLD_NUMBERS_LEAST = offsetof(WorldNumbers, energy) / sizeof(double)
};

/* Zero-initialise it; owns its columns. Particles stand in any order, `id` tells who is who. */
typedef struct WorldState {
    WorldNumbers numbers;
    size_t count, capacity;      /* particles; room for them */
    const struct Method *method; /* whose columns these are, beside those of terms that its def names */
    ParticleColumns particles;   /* those that are saved */
    Births births;               /* none, where emitters sent some out: not known */
} WorldState;

/* Of what world_save copies beside the particles. */
size_t world_births_bytes(const World *world);

/* Room for so many particles of a def; what was in it is lost. False when memory is short: then it is
 * empty. */
bool world_state_reserve(WorldState *state, const WorldDef *def, size_t count);
void world_state_free(WorldState *state); /* a zeroed one is allowed */

/* The numbers alone, for who has the particles from world_read. */
void world_save_numbers(World *world, WorldNumbers *numbers);

/* Copies the world's state. False with the reason: memory is short, or it is not sound (world_sound). */
bool world_save(World *world, WorldState *state, Error *error);

/* Puts a world that was made from the same def, but for what may change while it lives, into that state.
   False with the reason: another version, other particles, numbers that are none; the world is as it was. */
bool world_load(World *world, const WorldState *state, Error *error);

/* Carries the world over to another backend, where it goes on from the same state; *world is then another
   one. A context must be current as world_on_gpu says, for either. False with the reason: nothing has
   changed. */
bool world_move(World **world, const char *backend, Error *error);

/* Makes the world anew from a def that differs in its backend, its solids, its box or in whether somebody
   pours; it goes on from the same state, as another *world. Takes about as long as making it did, and for
   that time twice the memory. False with the reason: nothing has changed. */
bool world_rebuild(World **world, const WorldDef *def, Error *error);

/* Whether the box may become that of `def` where the world stands: with the same solids, of which those that
   stand are wholly in it before and after, and inside the cells that were made for it. Else the world is to
   be made anew. */
bool world_resizes(const World *world, const WorldDef *def);

/* From the next step on its box is as large as that of the def, and its solids are those of the def, where
   the hand has them: at once, where only that differs; else as world_rebuild does. Particles that a smaller
   box leaves outside come to its walls. */
bool world_set_shapes(World **world, const WorldDef *def, Error *error);

/* Puts it into a state in which it had the box and the solids of that def; where it has others now, *world is
   another one then, and its present state may be one that is not sound. False with the reason: nothing has
   changed. */
bool world_load_shapes(World **world, const WorldDef *def, const WorldState *state, Error *error);

#endif
