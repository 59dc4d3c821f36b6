/* The CPU backend's state: structure of arrays, sorted by cell, and the grid that sorts it. */
#ifndef SLOSH_CPU_H
#define SLOSH_CPU_H

#include "sim/base/exact_sum.h"
#include "sim/base/parallel.h"
#include "sim/cpu/pair_set.h"
#include "sim/matter/forces.h"
#include "sim/world/backend.h"
#include "sim/world/cell_fold.h"
#include "sim/world/particles.h"

typedef ParticleColumns CpuParticles;

typedef struct Cpu {
    const Constants *constants;
    PairSet pairs;
    int threads;
    size_t count, owned; /* particles: boundary particles of solids and ghosts included; its own alone */
    size_t capacity;     /* room for */
    CpuParticles now;
    CpuParticles spare; /* what `grid` sorts into: its columns then change places with those of `now` */
    ColumnRows all, saved, sorted, of_fluids; /* columns, and those with these flags */
    float (*place)[4], (*motion)[4];          /* packed for pair sums: see PairArgs */
    NeighbourLists lists;                     /* by the first pass behind `grid` that has need of them */
    uint32_t *cell, *spare_cell;              /* by `grid`: of each particle, sorted; before the sort */
    uint32_t *rank;                           /* by `grid`: place within the cell before its sort by id */
    uint32_t *order;                          /* by `grid`: old place of each new one */
    CellFold fold;
    uint32_t *cell_start; /* by `grid`, of each place of `fold`: places + 2; the last is for what is set
                             aside */
    size_t gridded;       /* by `grid`: how many it has seen */
    size_t copies;      /* by `grid`, in boxes with periodic sides: particles that stand across one, behind */
    size_t copy_room;   /* the others; room for */
    uint32_t *copy_of;  /* of each of them: of which particle; at `count` and on */
    uint8_t *copy_side; /* and across which sides, from 0 on */
    uint32_t *copy_start;   /* the first of each place of `fold`; places + 2; NULL: no periodic sides */
    uint32_t *owned_at;     /* by `grid`: where its own particles stand; NULL without solids and ghosts */
    uint32_t *boundary_at;  /* and the solids'; NULL without solids */
    uint32_t *fluid_at;     /* and the fluids', ghosts among them; without ghosts `owned_at` */
    uint32_t *fluid_before; /* of each particle: how many of the fluids' particles stand before it; one entry
                               more, for all */
    const uint8_t *foreign; /* of each cell: 1 where its particles are ghosts, another's that are read here;
                               NULL: none are */
    uint8_t *ghost;         /* by `grid`, of each particle: 1 for a ghost; NULL: there are none */
    SolidStep solid[SOLIDS_MAX]; /* the last move of each: solids stand at the end of it */
    WorldSums *partial;          /* by `sums`: one a range */
    WorldGauge gauge;            /* by `gauge` */
    size_t bytes;                /* of all these */
    size_t guarded;              /* atomic */
    Forces *forces;              /* where what box and solids feel is summed; NULL: nobody asked, */
    struct CpuFelt *felt;        /* by which it is summed: sim/cpu/felt.h */
    /* Each of `count` sums becomes that of all processes that share the world; NULL: it is one. */
    void (*sum_all)(ExactSum *sums, int count);
    StepWatch watch; /* by `kick`, atomic while it runs; until `watch` */
} Cpu;

/* Boundary particles stand among the others, with FLUIDS_MAX + their solid for a fluid and ids from here on.
 */
#define BOUNDARY_ID (UINT64_C(1) << 63)

/* Of a boundary particle that is set aside: x, m. Its square is finite, since lanes past a row's end read it.
 */
#define ASIDE PAST

enum { CPU_GRAIN = LISTS_GRAIN }; /* particles in a range: some 0.2 ms of work, small against a step */

PairArgs cpu_pair_args(Cpu *cpu);

/* Whether a particle is a fluid's and no ghost. */
static inline bool cpu_owns(const Cpu *cpu, size_t i)
{
    return cpu->now.fluid[i] < FLUIDS_MAX && !(cpu->ghost && cpu->ghost[i]);
}

/* The next run of its own particles at or after *begin, as far as *stop; false when there is none before
   `end`. Without solids and ghosts it is all. */
static inline bool cpu_run(const Cpu *cpu, size_t *begin, size_t end, size_t *stop)
{
    *stop = end;
    if (!cpu->owned_at)
        return *begin < end;
    while (*begin < end && !cpu_owns(cpu, *begin))
        ++*begin;
    for (*stop = *begin; *stop < end && cpu_owns(cpu, *stop);)
        ++*stop;
    return *begin < end;
}

/* Where its own k-th particle stands. */
static inline size_t cpu_owned(const Cpu *cpu, size_t k)
{
    return cpu->owned_at ? cpu->owned_at[k] : k;
}

/* Whether its own k-th particle and the one before were in one cell when `grid` looked: cells are whole
   wherever the particles are shared, so what is added up cell by cell has the same bits there. */
static inline bool cpu_cell_goes_on(const Cpu *cpu, size_t k)
{
    return k > 0 && cpu->gridded == cpu->count &&
           cpu->cell[cpu_owned(cpu, k)] == cpu->cell[cpu_owned(cpu, k - 1)];
}

/* The first of its own particles from the k-th on that begins a cell; Cpu.owned if none does. */
static inline size_t cpu_cell_first(const Cpu *cpu, size_t k)
{
    while (k < cpu->owned && cpu_cell_goes_on(cpu, k))
        k++;
    return k;
}

/* What the pair sums need of particle i's fluid, of the terms that the scene names. */
static inline void cpu_fill_terms(const Cpu *cpu, size_t i)
{
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const int fluid = p->fluid[i];
    if (p->viscosity)
        p->viscosity[i] = s->viscosity[fluid];
    if (p->tension)
        p->tension[i] = s->tension[fluid];
    if (p->kind)
        p->kind[i] = (float)fluid;
}

/* The grid's cell of x, m. */
uint32_t cpu_cell_of(const Constants *constants, const float x[3]);

/* From now on there are ghosts: in those cells, as Cpu.foreign says, which outlives this. False when memory
   is short. */
bool cpu_share(Cpu *cpu, const uint8_t *foreign);

/* Room for so many particles, boundary particles included; keeps what goes with them (COLUMN_SORTED), and a
   grid must follow. False when memory is short: nothing has changed. */
bool cpu_grow(Cpu *cpu, size_t capacity);

/* Where its own particles, ghosts and boundary particles stand, after a change without a grid. */
void cpu_find(Cpu *cpu);

/* The grid; its two parts: the cell of each particle, in `spare_cell`; the particles sorted by these. */
void cpu_grid(void *state);

/* sim/cpu/copies.c, in boxes with periodic sides: counts the copies of the particles whose cells `grid` has
   found, false where there is no room for them; makes room, false when memory is short: then a grid
   must follow, or there are none, and the step is in trouble; puts them behind the particles. Before a walk
   of the pass: gives them what its pair sums gather; what is packed. */
bool cpu_copies_fit(Cpu *cpu);
bool cpu_copies_grow(Cpu *cpu);
void cpu_copies_drop(Cpu *cpu);
void cpu_copies_place(Cpu *cpu);
void cpu_copies_update(Cpu *cpu, const Pass *pass);
void cpu_copies_pack(Cpu *cpu);

/* Before a step: the first drift puts those that go through a periodic side back at once. Behind it: puts
   those that went through a periodic side back into the box. Until then they stay where the lists of
   neighbours have them. */
void cpu_enter(void *state);
void cpu_leave(void *state);
void cpu_cells(Cpu *cpu);
void cpu_sort(Cpu *cpu);
void cpu_run_pass(void *state, const Pass *pass, const PassInput *input);
void cpu_drift(void *state, const BoxStep *step);

/* sim/cpu/boundary.c, of solids: appends their particles after the fluids'; moves them along; gives those at
   `i` no share in the fluids' terms; fills in what the forces need of them, and takes back the velocities
   that are mirrored for it. */
void cpu_boundary_append(Cpu *cpu);
void cpu_boundary_move(Cpu *cpu, const SolidStep *steps);
void cpu_boundary_terms(Cpu *cpu, size_t i);
void cpu_boundary_fill(Cpu *cpu, const ApparentGravity *gravity);
void cpu_boundary_restore(Cpu *cpu);
bool cpu_guard_solids(const Cpu *cpu, const SolidStep *steps, const float before[3], float x[3], float v[3]);
void cpu_pose(void *state, const SolidPose *pose);
size_t cpu_emit(void *state, const EmitLayer *layer, size_t most);
/* Of cpu_emit: whether a particle may come in at x (m), which is in the box and in no cell of ghosts; adds
   there the layer's particle of that number, for which there must be room. */
bool cpu_has_room(Cpu *cpu, const float x[3]);
void cpu_append(Cpu *cpu, const EmitLayer *layer, const float x[3], size_t number);
double cpu_guide(void *state, const Guide *guides, int count);
size_t cpu_drain(void *state, const Fill *regions, int count);

/* Backend.excess and .sum; and the same as parts that add up: what is above 0, its greatest value or all. */
Excess cpu_excess(void *state, const ColumnDef *column);
double cpu_sum(void *state, const ColumnDef *column);
float cpu_excess_part(Cpu *cpu, const ColumnDef *column, ExactSum *sum);
void cpu_sum_part(Cpu *cpu, const ColumnDef *column, ExactSum *sum);
void cpu_touch(void *state, const FingerStep *finger);
void cpu_kick(void *state, const float gravity[3], float dt);
StepWatch cpu_watch(void *state);
void cpu_sums(void *state, WorldSums *sums);
bool cpu_read(void *state, const ParticleArrays *out);
extern const struct BackendMicro cpu_micro;
/* sim/cpu/forces.c, where a world was asked: adds what the kick does, behind it; and what the guards of a
   drift did, summed by sim/cpu/felt.h. */
bool cpu_feel(void *state, Forces *to, Error *error);
void cpu_feel_kick(Cpu *cpu, float dt);
void cpu_feel_drift(Cpu *cpu);
bool cpu_gauge(void *state, const double gravity[3]);
bool cpu_gauged(void *state, WorldGauge *gauge, bool waits);
void cpu_energy(void *state, bool turning, EnergySums *sums);
/* The same as parts that add up, one for each number of EnergySums. */
enum { ENERGY_SUMS = sizeof(EnergySums) / sizeof(double) };
void cpu_energy_part(Cpu *cpu, bool turning, ExactSum sums[ENERGY_SUMS]);

#endif
