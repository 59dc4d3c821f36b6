/* Internals of the backend of ranks, for the ranks_*.c files. */
#ifndef SLOSH_RANKS_STATE_H
#define SLOSH_RANKS_STATE_H

#include "sim/cpu/pass.h"
#include "sim/dist/dist.h"
#include "sim/dist/ranks.h"

enum { PASSES_KNOWN = 64 };

/* The rows of cpu->all read and written by a pass, a bit per row. */
typedef struct Touched {
    const Pass *pass;
    uint64_t reads, writes;
    bool walks, packed, whole; /* a loop walks; reads filled Cpu.motion; no loop leaves out ghosts */
} Touched;

typedef struct Ranks {
    Cpu *cpu;
    Dist *dist;
    uint64_t fresh; /* rows of cpu->all up to date for ghosts */
    Touched known[PASSES_KNOWN];
    int known_count;
    size_t total, guarded; /* over all ranks: particles; guarded steps of particles */
    size_t began_guarded;  /* `guarded` before the rank's own count began */
    ParticleColumns kept;  /* state of the last mark */
    size_t kept_count, kept_room;
    double *weight;  /* scratch per cell */
    bool due;        /* share the cells out at the next grid */
    double took;     /* s of the rank's processor time for the last sharing */
    double cpu_time; /* s of computing since then, over all threads of the rank */
    double worked;   /* particles computed since then, summed over steps */
    float *came;     /* positions emitted on foreign ranks since the grid */
    size_t came_count, came_room;
    RanksFigures figures;
} Ranks;

/* ---- clocks: ranks_clock.c ---- */

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

/* Shares the cells out again, after look_at_shares found sharing due. */
void share_anew(Ranks *ranks);

/* Once per frame: sharing is due if the slowest rank was much slower than the mean. */
void look_at_shares(Ranks *ranks);

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

/* ---- sums over all ranks: ranks_sums.c ---- */

StepWatch ranks_watch(void *state);
Excess ranks_excess(void *state, const ColumnDef *column);
double ranks_sum(void *state, const ColumnDef *column);
void ranks_energy(void *state, bool turning, EnergySums *sums);
void ranks_sums(void *state, WorldSums *sums);

/* ---- states: ranks_keep.c ---- */

bool ranks_read(void *state, const ParticleArrays *out);
size_t ranks_held(const void *state);
bool ranks_save(void *state, const ParticleColumns *to);
bool ranks_load(void *state, const ParticleColumns *from, size_t count, size_t guarded);
bool ranks_mark(void *state, Error *error);
void ranks_back(void *state, size_t count, size_t guarded);

/* ---- emitters and drains: ranks_flow.c ---- */

size_t ranks_emit(void *state, const EmitLayer *layer, size_t most);
size_t ranks_drain(void *state, const Fill *regions, int count);

/* ---- memory ---- */

/* Array size for `count` own particles: on more than one rank with spare room for moved particles and
   ghosts. */
size_t room_for(size_t count, int size);

/* Memory for `count` entries of `size` bytes, NULL if `wanted` is NULL. Ends all ranks if memory is short.
   The caller frees. */
void *some(const void *wanted, size_t count, size_t size);

#endif
