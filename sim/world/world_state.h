/* The single saved state of a world (DESIGN 2): all data read by the next step. Used alone by snapshots,
   resume, going back after trouble and a change of backend: save, load, step equals step, to the bit. */
#ifndef SLOSH_WORLD_STATE_H
#define SLOSH_WORLD_STATE_H

#include "sim/base/births.h"
#include "sim/body/body_state.h"
#include "sim/matter/energy_sums.h"
#include "sim/world/column.h"
#include "sim/world/live.h"
#include "sim/world/reading.h"
#include "sim/world/step_types.h"
#include "sim/world/world.h"

#include <stddef.h>

struct Method; /* sim/world/method.h */

/* Reference of sim/world/energy_watch.h; zero: none yet. */
typedef struct EnergyMark {
    double least;   /* energy of motion and compression minus work since the first look, J */
    double until;   /* step after which a new reference is taken */
    double next;    /* step of the next look; earlier if particles are much faster than */
    double speed;   /* the greatest speed at the last look, m/s */
    double work;    /* work of gravity and of the box's motion since the first look, J */
    double stirred; /* absolute work since `least`, J */
    double surface; /* surface energy that might come free, at `least`, J */
    double most;    /* allowed gain over `least` at the last look, J */
    double jolted;  /* not 0: the box's velocity jumps in the current step */
    double turning; /* not 0: the sums include those for a turning box */
    double gauged;  /* not 0: the sums are from a GPU's gauge */
    double time;    /* of the last look, s; sums and box at that time: */
    EnergySums sums;
    BoxState box;
} EnergyMark;

/* The state besides the particles. Doubles only: also an array of WORLD_NUMBERS doubles, stored as such in
   files. */
typedef struct WorldNumbers {
    double version;            /* WORLD_STATE_VERSION */
    double step, since_step;   /* substeps; first step with the present dt */
    double since_time;         /* time of since_step, s */
    double guarded;            /* as WorldInfo.guarded */
    double emitted, drained;   /* as in WorldInfo */
    StepState stepping;        /* step sizes */
    BoxTarget target;          /* of the hand */
    BoxFilter filter;          /* the hand's part of the pose */
    BoxState box;              /* the pose, in the world's frame */
    double live[LIVE_NUMBERS]; /* live settings of the def */
    EnergyMark energy;         /* last members from here on: files may end before them */
    FingerState finger;
    double shut;       /* shut gates of emitters and drains, bits as an integer: sim/matter/flow.h */
    double pours;      /* s: begin of the finger's pouring */
    BodyStates bodies; /* floating solids */
} WorldNumbers;

enum {
    WORLD_STATE_VERSION = 4,
    WORLD_NUMBERS = sizeof(WorldNumbers) / sizeof(double),
    WORLD_NUMBERS_LEAST = offsetof(WorldNumbers, energy) / sizeof(double)
};

/* Zero-initialise; owns its columns. Particles are in any order, identified by `id`. */
typedef struct WorldState {
    WorldNumbers numbers;
    size_t count, capacity;      /* particles; capacity of the columns */
    const struct Method *method; /* owner of the columns, together with terms named by its def */
    ParticleColumns particles;   /* saved columns */
    Births births;               /* empty although particles were emitted: unknown */
} WorldState;

/* Bytes copied by world_save besides the particles. */
size_t world_births_bytes(const World *world);

/* Makes room for `count` particles of a def; old contents are lost. Returns false if memory is short, with
   an empty state. */
bool world_state_reserve(WorldState *state, const WorldDef *def, size_t count);
void world_state_free(WorldState *state); /* a zeroed state is allowed */

/* Saves the numbers alone, for callers with particles from world_read. */
void world_save_numbers(World *world, WorldNumbers *numbers);

/* Copies the world's state. Returns false with the reason: memory is short, or the state is unsound
   (world_sound). */
bool world_save(World *world, WorldState *state, Error *error);

/* Loads a state into a world made from the same def, except for live settings. Returns false with the
   reason: a different version, different particles or non-finite numbers; the world is unchanged. */
bool world_load(World *world, const WorldState *state, Error *error);

/* Moves the world to a different backend, which continues from the same state; replaces *world. A context
   must be current as for world_on_gpu, for either backend. Returns false with the reason, with nothing
   changed. */
bool world_move(World **world, const char *backend, Error *error);

/* Rebuilds the world from a def with a different backend, solids, box or pouring; continues from the same
   state and replaces *world. Takes about as long as world_create, with twice the memory in the meantime.
   Returns false with the reason, with nothing changed. */
bool world_rebuild(World **world, const WorldDef *def, Error *error);

/* True if the box can be resized to that of `def` in place: same solids, with resting solids wholly inside
   before and after, and the new box inside the existing cells. Otherwise rebuild the world. */
bool world_resizes(const World *world, const WorldDef *def);

/* From the next step on, takes box size and solids from `def`, with the hand's poses. Works in place if
   only those differ or if world_resizes; otherwise like world_rebuild. Particles outside of a smaller box
   move to its walls. */
bool world_set_shapes(World **world, const WorldDef *def, Error *error);

/* Loads a state saved with the box and solids of `def`. Replaces *world if its box or solids differ; the
   present state may be unsound. Returns false with the reason, with nothing changed. */
bool world_load_shapes(World **world, const WorldDef *def, const WorldState *state, Error *error);

#endif
