/* Options of slosh-dist beyond slosh's. */
#ifndef APP_RANKS_RANKS_H
#define APP_RANKS_RANKS_H

#include "app/bench/plot.h"
#include "app/cli/args/args.h"
#include "app/lab/scaling.h"
#include "app/run/measure/measure.h"
#include "app/run/session.h"
#include "app/scene/scene.h"
#include "sim/error.h"
#include "sim/world.h"

#include <stdbool.h>

typedef struct DistOptions {
    bool balance; /* --balance on|off: shares follow the ranks' times; default on */
} DistOptions;

/* Gathers the particles read by probes, of all ranks, on the first rank. */

/* Zero-initialise before use. */
typedef struct Gathered {
    Cloud cloud;    /* on the first rank: in the order of a single process, so that sums have the same bits */
    Cloud own;      /* the rank's own particles */
    void *out, *in; /* records sent to, and received on, the first rank */
    ParticleId *id;
    uint32_t *cell;
    size_t own_capacity, out_capacity, in_capacity, cloud_capacity; /* capacity, particles */
} Gathered;

/* As RunRanks.gather; `user`: a Gathered. Ends all ranks if memory is short. */
const Cloud *dist_gather(void *user, const Probes *probes, World *world);
void dist_gather_free(Gathered *gathered);

/* The scene of a command line as a world on all ranks. Zero-initialise before use, and do not move. All
   functions except rank_session_say are collective. */

typedef struct RankSession {
    Session session; /* like slosh run's on each rank; the scene has the backend named in the file */
    RunRanks shared; /* of the session's run */
    Gathered gathered;
    int rank, size;
} RankSession;

/* Finds rank and size; from now on Ctrl-C is polled. */
void rank_session_begin(RankSession *ranks);

/* Opens the scene. Returns 0, or the exit code with the reason. */
int rank_session_open(RankSession *ranks, const Args *args, const char *command, Error *error);
void rank_session_close(RankSession *ranks);

/* Looks at the present state, at the end of a frame, for failures of the fluid. */
void rank_session_look(RankSession *ranks);

/* Prints on standard error, on the first rank only. */
void rank_session_say(const RankSession *ranks, const char *words);

/* Counts the ranks on this rank's machine, and their usable processors. */
void rank_session_machine(int *ranks, int *processors);

/* Collective: returns true if `ok` on all ranks; else all ranks get the error of the first failing rank. */
bool dist_agree(bool ok, Error *error);

/* Checks if a scene fits the memory of the ranks, before making any of it. */

typedef struct DistMemory {
    double particles; /* of all ranks, including solids and future emissions */
    double needed;    /* bytes: approximate need of a rank, for its particles and ghosts */
    double allowed;   /* bytes: least allowance of any rank */
    char machine[64]; /* machine of that rank */
} DistMemory;

/* A run from a file of slosh-dist bench --json. */

typedef struct ScalingSample {
    const char *path;
    ScalingRun run;
    int dimensions;
    double imbalance;    /* greatest over mean compute */
    char scene[256];     /* as on the command line */
    char processor[128]; /* "": not in the file */
} ScalingSample;

/* The chart of slosh-dist scaling: speed-up and efficiency over processors, and the parts of a step. */

typedef struct ScalingPicture {
    const ScalingSample *sample; /* one per run */
    const ScalingRun *runs;
    const ScalingSeries *series;
    int count; /* of the series */
} ScalingPicture;

/* Commands of slosh-dist. Each returns its exit code, equal on all ranks. */

/* Measures the parts of a step per rank; --json writes a file for dist_model. */
int dist_bench(const Args *args, const DistOptions *options);

/* Fits the model of cost to files of dist_bench; prints the fit, and the prediction for a larger run. On
   one rank. */
int dist_model(int count, char *const paths[]);

/* Reports strong and weak scaling from files of dist_bench on different rank counts, with -o and --json.
   On one rank. The words end with NULL. */
int dist_scaling(int count, char *const words[]);

#endif
