/* Internals of a world, for the files of sim/world. */
#ifndef SIM_STEP_WORLD_H
#define SIM_STEP_WORLD_H

#include "sim/step/backend.h"
#include "sim/step/iterate.h"
#include "sim/step/method.h"
#include "slosh/state.h"
#include "slosh/world.h"

struct World {
    WorldDef def; /* without `initial` */
    Constants constants;
    const Backend *backend;
    const Method *method;
    void *state;                         /* the backend's */
    size_t count, initial, capacity;     /* particles: now, at the start, limit */
    uint64_t emitted, drained;           /* since the start */
    Births births;                       /* of emitted particles; births of drained particles are removed from
                                            time to time */
    size_t births_most;                  /* above this number, births of drained particles are removed */
    float *layer;                        /* scratch for an emitter's layer */
    size_t layer_room;                   /* size of the scratch, in particles */
    unsigned short barred[EMITTERS_MAX]; /* by gate: consecutive layers of an emitter without room */
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
    struct Bodies *bodies;              /* sim/solids/bodies.h; NULL: no floating solids */
    uint64_t shut;                      /* gates of emitters and drains, a bit each */
    EnergyMark energy;                  /* for sim/step/sentinel.h */
    bool sums_forces;                   /* the backend sums forces, into `pushed`; on a GPU into `felt` */
    Forces pushed;                      /* forces of the current step */
    bool feels;                         /* forces were requested (world_enable_forces) */
    Forces felt, felt_before;           /* sums since the last request; sums at the good state */
    bool gauge_asked;                   /* asked and not yet answered */
    double gauge_time;                  /* time of the gauged state, s */
};

/* Creates the backend's state from the def's initial state or fills; the constants must exist. */
bool world_start(World *world, Error *error);

/* The pouring finger as an emitter of `fluid`; false if the finger does not pour. */
bool world_pours(const World *world, Emit *emit, int *fluid);

/* Adds fluid from emitters and finger for the coming step, and removes fluid in drains. Returns false, with
   nothing done, if memory is short. */
bool world_flow(World *world, Error *error);

/* As WorldInfo.barred. */
uint64_t world_barred(const World *world);

/* True if the backend has ids for `born` particles since the start; false with the reason. */
bool world_names(const World *world, uint64_t born, Error *error);

/* From now on the backend sums forces. Returns false with the reason. */
bool world_sum_forces(World *world, Error *error);

/* Removes births of drained layers. Call before a state is marked: an older marked state may still have
   these particles. */
void world_thin_births(World *world);

/* Sets the box to its motions and the hand's filter at the present time. */
void world_pose(World *world);

/* Derives solids' poses, grid and densities from the particles. */
void world_recompute_derived(World *world);

/* Fills term columns missing in `known` (NULL: all) as unknown. */
void world_clear_unknown(World *world, const ParticleColumns *known);

/* Call after the backend restored or loaded particles: sets the count and all derived values. */
void world_put_back(World *world, const WorldNumbers *numbers, size_t count);

/* From now on, viscosities given by a table have their value at `time` (s). */
void world_update_viscosities(World *world, double time);

/* Time of a step by number, s, for the present step size. */
double world_time_at(const World *world, double step);

/* Makes `def` the world's def; its constant part must equal the world's. Returns false with the reason,
   with nothing changed. */
bool world_adopt(World *world, const WorldDef *def, Error *error);

#endif
