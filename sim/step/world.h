/* A world from inside, for the files of sim/step: the struct, and what these files call of each other. */
#ifndef SIM_STEP_WORLD_H
#define SIM_STEP_WORLD_H

#include "sim/def.h"
#include "sim/state.h"
#include "sim/step/backend.h"
#include "sim/step/method.h"
#include "sim/step/substep.h"
#include "sim/world.h"

/* Worlds whose energy is not watched. */

/* NULL if the watch works in such a world, but for fingers; otherwise the reason for users. */
const char *energy_unwatched(const WorldDef *def);

/* Internals of a world, for the files of sim/step. */

/* A layer of particles, or a drain, with a number of particles not known yet. */
typedef struct Flow {
    bool drains;
    unsigned short *blocked; /* the emitter's counter; NULL: a drain or poured fluid */
    float born;              /* s */
} Flow;

struct World {
    WorldDef def; /* without `initial` */
    Constants constants;
    const Backend *backend;
    const Method *method;
    void *state;                     /* the backend's */
    size_t count, initial, capacity; /* particles: now, at the start, limit */
    uint64_t emitted, drained;       /* since the start */
    Births births;                   /* of emitted particles; births of drained particles are removed from
                                        time to time */
    size_t births_most;              /* above this number, births of drained particles are removed */
    float *layer;                    /* scratch for an emitter's layer */
    size_t layer_capacity;           /* size of the scratch, in particles */
    unsigned short blocked[EMITTERS_MAX]; /* by gate: consecutive layers of an emitter without room */
    Flow flows[FLOWS_MAX];                /* of the step, in order */
    int flow_count;
    uint64_t step;
    uint64_t since_step; /* first step with the present step size */
    double since_time;   /* time of that step, s */
    StepState stepping;
    double stop;                  /* s: in mode cfl a state falls on this time; in the past: none */
    StepSolve solves[SOLVES_MAX]; /* of the last step */
    SolveTally tally;             /* of all steps */
    double fastest;               /* as WorldInfo has it */
    bool kicked;                  /* since the last call of watch */
    StepTrouble seen;             /* trouble since the last good state */
    WorldState good;              /* state for going back */
    WorldTrouble trouble;
    uint64_t limited[STEP_LIMIT_COUNT]; /* steps since the start, by bound */
    BoxTarget target;                   /* of the hand */
    BoxFilter filter;                   /* at the present time */
    BoxState box;                       /* at the present time, with the hand's part */
    FingerState finger;                 /* at the present time */
    double pours;                       /* s: begin of the finger's pouring */
    struct Bodies *bodies;              /* sim/solids/solid.h; NULL: no floating solids */
    uint64_t closed;                    /* gates of emitters and drains, a bit each */
    EnergyMark energy;                  /* for the watch over energy */
    bool sums_forces;             /* the backend sums forces, into `step_forces`; on a GPU into `forces` */
    Forces step_forces;           /* forces of the current step */
    bool forces_wanted;           /* forces were requested (world_enable_forces) */
    Forces forces, forces_before; /* sums since the last request; sums at the good state */
    bool gauge_asked;             /* asked and not yet answered */
    double gauge_time;            /* time of the gauged state, s */
};

/* Creates the backend's state from the def's initial state or fills; the constants must exist. */
bool world_start(World *world, Error *error);

/* The pouring finger as an emitter of `fluid`; false if the finger does not pour. */
bool world_pours(const World *world, Emit *emit, int *fluid);

/* Adds fluid from emitters and finger for the coming step, and removes fluid in drains. Returns false, with
   nothing done, if memory is short. */
bool world_flow(World *world, Error *error);

/* Call after the passes of a step: adds the numbers of the step's flows. Returns false after a wrong guess:
   the step must start again. */
bool world_finish(World *world);

/* True if the backend has ids for `born` particles since the start; false with the reason. */
bool world_names(const World *world, uint64_t born, Error *error);

/* From now on the backend sums forces. Returns false with the reason. */
bool world_sum_forces(World *world, Error *error);

/* Removes births of drained layers. Call before a state is marked: an older marked state may still have
   these particles. */
void world_thin_births(World *world);

/* The box's pose at `time` (s): its motions, with the hand's part from `filter`. */
void world_box_at(const World *world, const BoxFilter *filter, double time, BoxState *box);

/* Sets the box to its pose at the present time. */
void world_pose(World *world);

/* Derives solids' poses, grid and densities from the particles. */
void world_recompute_derived(World *world);

/* True if the state can be loaded into the world: whole numbers, finite places, and each particle once. False
   with the reason. */
bool world_state_check(const World *world, const WorldState *state, Error *error);

/* Call after the backend restored or loaded particles: sets the count and all derived values. */
void world_put_back(World *world, const WorldNumbers *numbers, size_t count);

/* From now on, viscosities given by a table have their value at `time` (s). */
void world_update_viscosities(World *world, double time);

/* Time of a step by number, s, for the present step size. */
double world_time_at(const World *world, double step);

/* Count of particles that world_read gives: all; of MPI ranks the own share. */
size_t world_held(const World *world);

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

   On a GPU, the sums are read now and then, at the end of a frame, with a wait for results. The sums are also
   read at both ends of a step in which the box's velocity jumps. */

/* Call after each sound step (on a GPU: each frame) and for the initial state. Returns false if energy has
   grown, with the reason in world->seen; compares only at the ends of frames. */
bool energy_is_valid(World *world);

/* True if `energy_is_valid` is likely to read the sums at the end of the present step, the last of a frame.
 */
bool energy_expects_look(const World *world);

/* Call before a step. `begin`: the box at the step's begin; world->box is at the end. */
void energy_note_jump(World *world, const BoxState *begin);

/* Reports that `number` particles of a layer were emitted. */
void energy_add_emitted(World *world, const EmitLayer *layer, size_t number);

/* energy_needs_solids: true if the watch needs forces on solids. Then call energy_of_solids after each step
   with the forces and the solids' steps. */
bool energy_needs_solids(const World *world);
void energy_of_solids(World *world, const Forces *forces, const SolidStep solids[SOLIDS_MAX]);

/* Call after unknown work or a change of the energy's definition: comparison restarts with the next frame. */
void energy_restart(World *world);

/* The sentinel: after trouble the world goes back to the last good state and halves the step. */

/* At the begin of a frame: keeps the state. Returns false if memory is short. */
bool sentinel_mark(World *world, Error *error);

/* At the begin of a frame: after many calm steps, takes back the last halving if friction allows the longer
   step. */
void sentinel_lengthen_step(World *world);

/* Call after a wrong guess in the first step of a frame: restores the state of `sentinel_mark`, before
   emitters and drains, at the same step number, without a trace of the step. */
void sentinel_again(World *world);

/* Call after a step that is checked only at the end of its frame: remembers a solver in trouble until then.
   For non-finite residuals the frame's watch reports in better words. */
void sentinel_note_solves(World *world);

/* After a step with trouble (world->seen) that ended at `time`: restores the last good state and halves the
   step. The step number goes on, and settings by hand and keys since then stay, so that a recorded session
   gives the same result. Returns false, with the good state and the reason, if the step was already halved
   `retries` times. */
bool sentinel_back(World *world, double time, Error *error);

#endif
