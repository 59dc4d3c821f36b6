/* Inside a world: for the files that make one up. */
#ifndef SLOSH_WORLD_STRUCT_H
#define SLOSH_WORLD_STRUCT_H

#include "sim/matter/forces.h"
#include "sim/world/backend.h"
#include "sim/world/iterate.h"
#include "sim/world/method.h"
#include "sim/world/world_state.h"

struct World {
    WorldDef def; /* `initial` is not kept */
    Constants constants;
    const Backend *backend;
    const Method *method;
    void *state;                     /* the backend's */
    size_t count, initial, capacity; /* particles: now, at the start, at most */
    uint64_t emitted, drained;       /* since the start */
    Births births;                   /* of those that were emitted and, but for the newest, are not gone */
    size_t births_most;              /* with more than these it is looked who is gone */
    float *layer;                    /* room for an emitter's layer, */
    size_t layer_room;               /* of so many particles */
    unsigned short barred[EMITTERS_MAX]; /* by its gate: layers of an emitter in a row that found no room */
    uint64_t step;
    uint64_t since_step; /* when the present step size began, */
    double since_time;   /* at this time, s */
    StepState stepping;
    double stop;                  /* s: a state falls on it in mode cfl; behind: none does */
    StepSolve solves[SOLVES_MAX]; /* of the last step */
    SolveTally tally;             /* of all of them */
    double fastest;               /* as WorldInfo has it */
    bool kicked;                  /* since the watch was last asked */
    StepTrouble seen;             /* then, since the last good state */
    WorldState good;              /* what the sentinel goes back to */
    WorldTrouble trouble;
    uint64_t limited[STEP_LIMIT_COUNT]; /* steps since the start, by what bounded them */
    BoxTarget target;                   /* of the hand */
    BoxFilter filter;                   /* at the present time */
    BoxState box;                       /* at the present time, the hand's part included */
    FingerState finger;                 /* at the present time */
    double pours;                       /* s: since when the finger does so */
    struct Bodies *bodies;              /* sim/body/bodies.h; NULL: no solid floats */
    uint64_t shut;                      /* gates of emitters and drains, a bit each */
    EnergyMark energy;                  /* of sim/world/energy_watch.h */
    bool sums_forces;                   /* the backend does, into: */
    Forces pushed;                      /* of the step in hand, or on a GPU at once into `felt`; */
    bool feels;                         /* somebody asked; then: */
    Forces felt, felt_before;           /* since it was last asked; of the good state */
    bool gauge_asked;                   /* and not answered yet, */
    double gauge_time;                  /* of the state at this time, s; */
    bool gauge_kept;                    /* but the answer is here: */
    WorldGauge gauge;
};

/* Makes the backend's state from the def's initial state or fills, with constants that are there. */
bool world_start(World *world, Error *error);

/* What the finger pours as an emitter of that fluid; false: it does not pour. */
bool world_pours(const World *world, Emit *emit, int *fluid);

/* Adds the fluid that emitters and the finger send out in the step ahead, and takes fluid out of the drains.
   False, and nothing done, when memory is short. */
bool world_flow(World *world, Error *error);

/* As WorldInfo has it. */
uint64_t world_barred(const World *world);

/* Whether the backend has ids for so many particles that were ever born, or the reason. */
bool world_names(const World *world, uint64_t born, Error *error);

/* The gauge of the present state; waits for it. What somebody else has asked for is kept. False when it is
   not to be had. */
bool world_gauge_now(World *world, WorldGauge *gauge);

/* From now on the backend sums forces; false with the reason. */
bool world_sum_forces(World *world, Error *error);

/* Leaves out the births of layers that are gone. Before a state to go back to is marked: that one may have
   them still. */
void world_thin_births(World *world);

/* The box as its motions and the hand's filter have it now. */
void world_pose(World *world);

/* What follows from the particles alone: the solids' places, grid, densities. */
void world_settle(World *world);

/* What terms keep of particles and `known` (NULL: nothing) has not, is not known. */
void world_forget(World *world, const ParticleColumns *known);

/* Particles that the backend has got back or taken: how many, and all that follows from them. */
void world_put_back(World *world, const WorldNumbers *numbers, size_t count);

/* From here on a viscosity that is a table has its value at `time` (s). */
void world_vary(World *world, double time);

/* s, of a step by its number, as far as the present step size holds. */
double world_time_at(const World *world, double step);

/* The def, whose constant part is the world's own, becomes the world's. False with the reason: nothing has
   changed. */
bool world_adopt(World *world, const WorldDef *def, Error *error);

#endif
