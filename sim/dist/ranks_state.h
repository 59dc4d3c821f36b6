/* The backend of ranks inside: what its files share. */
#ifndef SLOSH_RANKS_STATE_H
#define SLOSH_RANKS_STATE_H

#include "sim/cpu/pass.h"
#include "sim/dist/dist.h"
#include "sim/dist/ranks.h"

enum { PASSES_KNOWN = 64 };

/* Which rows of cpu->all a pass reads and writes, a bit each. */
typedef struct Touched {
    const Pass *pass;
    uint64_t reads, writes;
    bool walks, packed, whole; /* some loop walks; finds Cpu.motion filled; no loop leaves ghosts out */
} Touched;

typedef struct Ranks {
    Cpu *cpu;
    Dist *dist;
    uint64_t fresh; /* rows of which ghosts have what their owners have */
    Touched known[PASSES_KNOWN];
    int known_count;
    size_t total, guarded; /* of all ranks: particles; the guards' work */
    size_t began_guarded;  /* before this rank's count began */
    ParticleColumns kept;  /* of the last mark */
    size_t kept_count, kept_room;
    double *weight;  /* of each cell: room */
    bool due;        /* shares are to be made anew at the next grid */
    double took;     /* s of this rank's processor: to make them, the last time */
    double cpu_time; /* s of this rank's computing since then, of all its threads, */
    double worked;   /* and particles that it computed, each in each step */
    float *came;     /* places of particles that emitters sent out since the grid, on any rank */
    size_t came_count, came_room;
    RanksFigures figures;
} Ranks;

/* ---- clocks: ranks_clock.c ---- */

typedef struct Clock {
    double wall, cpu;
} Clock;

Clock clock_now(void);

/* The time since then counts as computing; does not, within a longer time that will be counted so; counts as
   an exchange. */
void computed(Ranks *ranks, Clock since);
void not_computed(Ranks *ranks, Clock since);
void exchanged(Ranks *ranks, Clock since);

/* For who is slower, before an exchange, so that the exchange's time is its own. */
void wait_for_others(Ranks *ranks);

/* ---- whose particles are whose: ranks_shares.c ---- */

/* The first shares: by the particles of each cell, which all ranks know; of an empty box by its cells. */
void share_first(Ranks *ranks, const Constants *constants, const InitialState *initial);

/* Shares anew, where a look found that they are due. */
void share_anew(Ranks *ranks);

/* Once a frame: whether the slowest rank of late was much slower than the mean. */
void look_at_shares(Ranks *ranks);

/* Whether the cell at x (m) is this rank's. */
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

/* ---- what all ranks add up: ranks_sums.c ---- */

StepWatch ranks_watch(void *state);
Excess ranks_excess(void *state, const ColumnDef *column);
double ranks_sum(void *state, const ColumnDef *column);
void ranks_energy(void *state, bool turning, EnergySums *sums);
void ranks_sums(void *state, WorldSums *sums);

/* ---- states that are read, kept, and gone back to: ranks_keep.c ---- */

bool ranks_read(void *state, const ParticleArrays *out);
size_t ranks_held(const void *state);
bool ranks_save(void *state, const ParticleColumns *to);
bool ranks_load(void *state, const ParticleColumns *from, size_t count, size_t guarded);
bool ranks_mark(void *state, Error *error);
void ranks_back(void *state, size_t count, size_t guarded);

/* ---- particles that come and go: ranks_flow.c ---- */

size_t ranks_emit(void *state, const EmitLayer *layer, size_t most);
size_t ranks_drain(void *state, const Fill *regions, int count);

/* ---- memory ---- */

/* Room for a rank's own particles as they come and go, and for ghosts. */
size_t room_for(size_t count, int size);

/* Memory for count entries of `size` bytes where `wanted` is not NULL; ends all ranks where there is none. */
void *some(const void *wanted, size_t count, size_t size);

#endif
