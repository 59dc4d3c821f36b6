/* Internals of Dist, for the files of sim/ranks. */
#ifndef SIM_RANKS_RANKS_PRIVATE_H
#define SIM_RANKS_RANKS_PRIVATE_H

#include "sim/ranks/ranks.h"

#include "sim/cpu/cpu.h"

#include <zoltan.h>
#include <zoltan_comm.h>

/* Ranks that see an own cell: `count` entries of Dist.seen from `first`. */
typedef struct CellReaders {
    uint32_t first, count;
} CellReaders;

/* Cells with particles, for Zoltan. */
typedef struct BalanceObjects {
    const double *weight;
    uint32_t *cell;
    int count;
} BalanceObjects;

struct Dist {
    const Constants *constants;
    MPI_Comm comm;
    int rank, size;
    int wide; /* layers of cells with ghosts */
    struct Zoltan_Struct *zoltan;
    BalanceObjects objects;
    int *owner;       /* per cell */
    uint8_t *foreign; /* per cell, plus an extra entry: see Cpu.foreign */
    uint8_t *shown;   /* per cell, plus an extra entry: 1 if foreign ranks see the cell */
    uint32_t *border; /* per shown cell: index in `sets` */
    CellReaders *sets;
    int *seen;
    size_t set_count, set_capacity, seen_count, seen_capacity;
    ZOLTAN_COMM_OBJ *plan; /* of the present ghosts; NULL: none */
    size_t send_count, ghost_count;
    uint32_t *send_at, *ghost_at;         /* indices of particles sent as ghosts; of ghosts here */
    size_t send_capacity, ghost_capacity; /* bytes */
    uint32_t *ranges;                     /* scratch of dist_pick */
    size_t ranges_capacity;
    int *to;        /* receiving ranks */
    char *out, *in; /* send and receive buffers */
    size_t to_capacity, out_capacity, in_capacity;
    DistSent sent;
};

/* Ends all ranks if `code` is a Zoltan error. */
void dist_check(int code, const char *what);

/* Internals of the backend of ranks, for the ranks_*.c files. */

enum { PASSES_KNOWN = 64 };

/* The rows of cpu->all read and written by a pass, a bit per row. */
typedef struct PassAccess {
    const Pass *pass;
    uint64_t reads, writes;
    bool walks, packed, whole; /* a loop walks; reads filled Cpu.motion; no loop leaves out ghosts */
} PassAccess;

typedef struct Ranks {
    Cpu *cpu;
    Dist *dist;
    uint64_t fresh; /* rows of cpu->all up to date for ghosts */
    PassAccess known[PASSES_KNOWN];
    int known_count;
    size_t total, guarded;  /* over all ranks: particles; guarded steps of particles */
    size_t began_guarded;   /* `guarded` before the rank's own count began */
    ParticleColumns marked; /* state of the last mark */
    size_t marked_count, marked_capacity;
    double *weight;  /* scratch per cell */
    bool due;        /* share the cells out at the next grid */
    double took;     /* s of the rank's processor time for the last sharing */
    double cpu_time; /* s of computing since then, over all threads of the rank */
    double worked;   /* particles computed since then, summed over steps */
    float *came;     /* positions emitted on foreign ranks since the grid */
    size_t came_count, came_capacity;
    RanksFigures figures;
} Ranks;

/* ---- clocks: ranks_shares.c ---- */

typedef struct Clock {
    double wall, cpu;
} Clock;

Clock clock_now(void);

/* Adds the time since `since`: computed to computing; exchanged to exchange. not_computed takes the time
   out of a longer one counted as computing. */
void computed(Ranks *ranks, Clock since);
void not_computed(Ranks *ranks, Clock since);
void exchanged(Ranks *ranks, Clock since);

/* Waits for slower ranks before an exchange, to keep waiting out of the exchange time. */
void wait_for_others(Ranks *ranks);

/* ---- shares: ranks_shares.c ---- */

/* First shares: by the particles of each cell, known to all ranks; an empty box is shared by cells. */
void share_first(Ranks *ranks, const Constants *constants, const InitialState *initial);

/* Finds if sharing is due (Ranks.due). share_anew then shares the cells out again. */
void look_at_shares(Ranks *ranks);
void share_anew(Ranks *ranks);

/* True if the cell at x (m) belongs to the rank. */
bool is_own(const Dist *dist, const Constants *constants, const float *x);

/* ---- a step: ranks_step.c ---- */

void ranks_grid(void *state);
void ranks_pose(void *state, const SolidPose *pose);
void ranks_enter(void *state);
void ranks_leave(void *state);
void ranks_drift(void *state, const BoxStep *step);
void ranks_run(void *state, const Pass *pass, const PassInput *input);
void ranks_kick(void *state, const float gravity[3], float dt);
void ranks_touch(void *state, const FingerStep *finger);
double ranks_guide(void *state, const Guide *guides, int count);

/* ---- sums over all ranks: ranks_step.c ---- */

StepWatch ranks_watch(void *state);
Excess ranks_excess(void *state, const ColumnDef *column);
double ranks_sum(void *state, const ColumnDef *column);
void ranks_energy(void *state, bool turning, EnergySums *sums);
bool ranks_gauge(void *state, const double gravity[3]);
bool ranks_gauged(void *state, WorldGauge *gauge, bool waits);
void ranks_sums(void *state, WorldSums *sums);

/* ---- emitters and drains: ranks_step.c ---- */

size_t ranks_emit(void *state, const EmitLayer *layer, size_t most);
size_t ranks_drain(void *state, const Fill *regions, int count);

/* ---- memory: ranks_shares.c ---- */

/* Array size for `count` own particles: on more than one rank with spare room for moved particles and
   ghosts. */
size_t room_for(size_t count, int size);

/* Memory for `count` entries of `size` bytes, NULL if `wanted` is NULL. Ends all ranks if memory is short.
   The caller frees. */
void *some(const void *wanted, size_t count, size_t size);

#endif
