/* A run: a world and its scene, made, stepped and watched; commands, probes and messages of the world; in one
   process or on MPI ranks. A command without a window (Session) and the window's simulator (Simulator) own a
   run each, and print or show the messages. */
#ifndef APP_RUN_RUN_H
#define APP_RUN_RUN_H

#include "app/run/measure/measure.h"
#include "app/run/recording/recording.h"
#include "app/scene/scene.h"
#include "sim/error.h"
#include "sim/state.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stdint.h>

/* Messages already told: each once. */
typedef struct RunReports {
    unsigned count;                        /* of the world's troubles seen so far */
    unsigned halvings[STEP_TROUBLE_COUNT]; /* each kind of trouble, bit n: with 1 / 2^n of the step */
    uint64_t blocked;                      /* a bit per emitter that finds no room */
    bool full;                             /* emitters wait */
    bool lost;                             /* particles have no cell in the grid */
    bool unlisted;                         /* memory is short for lists of neighbours */
} RunReports;

/* The scene's probes. */
typedef struct RunProbes {
    Probes *probes;    /* NULL: not open */
    float *value;      /* of the last reading, a number per column */
    Cloud cloud;       /* scratch */
    bool wants_forces; /* a probe measures a force; the world sums forces */
} RunProbes;

/* A world on MPI ranks (app/ranks). All functions are collective. */
typedef struct RunRanks {
    int size;                            /* count of ranks */
    const struct SnapshotParallel *file; /* for snapshots written by all ranks; first rank; agreement */
    OutcomeSum *sum, *most;              /* sum, and maximum, of each value over all ranks */
    void (*spread)(WorldState *state, const WorldDef *def); /* the first rank's state to all */
    /* On the first rank: all particles read by probes, in the order of a single process; NULL on the rest. */
    const Cloud *(*gather)(void *user, const Probes *probes, World *world);
    void *user;
} RunRanks;

typedef struct Run {
    Scene scene;    /* with the changes by commands */
    World *world;   /* NULL: none */
    WorldInfo info; /* of the present state, kept up to date by the functions here */
    RunReports reported;
    FluidWatch watch;
    RunProbes probes;
    const RunRanks *ranks; /* NULL: a single process */
} Run;

/* Gets a message for the user: one line, without a newline. */
typedef void RunTell(void *user, const char *words);

/* Makes the world anew, from `def`: the scene's, or with another backend. No message counts as told. Returns
   false with the reason, and without a world. */
bool run_begin(Run *run, const WorldDef *def, Error *error);

/* Advances by one step of a frame, and tells what is new: trouble that the sentinel met, emitters that wait,
   lost particles, fluid that clumps, leaks or loses volume. `clock` as of world_substep. Returns false if the
   simulation broke. */
bool run_substep(Run *run, StageClock *clock, RunTell *tell, void *user, Error *error);

/* Repeats a step of the past: tells nothing, and does not look. */
bool run_substep_again(Run *run, Error *error);

/* Applies a command now (sim_command_apply). */
bool run_apply(Run *run, const SimCommand *command, Error *error);

/* Looks for fluid that clumps, leaks or loses volume, if a look is due; run_substep does so. */
void run_look(Run *run, RunTell *tell, void *user);

/* run_open_probes: opens the scene's probes. run_read_probes: reads the probes into run->probes.value, on
   ranks on the first alone. `mean` gets the mean forces since the last reading, or 0 if no probe wants
   forces. On a GPU a reading waits for the particles. Both return false if memory is short. run_close_probes:
   also if not open. */
bool run_open_probes(Run *run);
bool run_read_probes(Run *run, Forces *mean);
void run_close_probes(Run *run);

/* True for a single process and for the first rank: the process that prints, and writes all but snapshots. */
bool run_is_first(const Run *run);

/* True if `ok` on all ranks; else all get the error of the first rank that failed. */
bool run_agree(const Run *run, bool ok, Error *error);

#endif
