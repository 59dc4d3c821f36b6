/* State of the CPU backend: structure of arrays, sorted by cell, and the grid for the sort. */
#ifndef SIM_CPU_CPU_H
#define SIM_CPU_CPU_H

#include "sim/base/base.h"
#include "sim/cpu/pairs.h"
#include "sim/def/fluids.h"
#include "sim/step/backend.h"
#include "sim/step/method.h"
#include "sim/world.h"

typedef ParticleColumns CpuParticles;

typedef struct Cpu {
    const Constants *constants;
    PairSet pairs;
    int threads;
    size_t count, owned; /* all particles, with boundary and ghost particles; own particles */
    size_t capacity;     /* room for particles */
    CpuParticles now;
    CpuParticles spare; /* target of the sort in `grid`; then the columns of `spare` and `now` are swapped */
    ColumnRows all, saved, sorted, of_fluids; /* all columns; columns with these flags */
    float (*place)[4], (*motion)[4];          /* packed for pair sums: see PairArgs */
    NeighbourLists lists;                     /* made by the first pass after `grid` that walks */
    uint32_t *cell, *spare_cell;              /* by `grid`, per particle: sorted; before the sort */
    uint32_t *rank;                           /* by `grid`: place in the cell before the sort by id */
    uint32_t *order;                          /* by `grid`: old index of each new index */
    CellFold fold;
    uint32_t *cell_start;   /* by `grid`, per place of `fold`: places + 2; the last for particles set aside */
    size_t gridded;         /* by `grid`: particles in the grid */
    size_t copies;          /* by `grid`, with periodic sides: copies of particles across a side, after */
    size_t copy_capacity;   /* the particles; room for copies */
    uint32_t *copy_of;      /* per copy: index of the original; from entry `count` on */
    uint8_t *copy_side;     /* per copy: crossed sides; from entry 0 on */
    uint32_t *copy_start;   /* first copy of each place of `fold`; places + 2; NULL: no periodic sides */
    uint32_t *owned_at;     /* by `grid`: indices of own particles; NULL without solids and ghosts */
    uint32_t *boundary_at;  /* indices of boundary particles; NULL without solids */
    uint32_t *fluid_at;     /* indices of fluid particles and ghosts; without ghosts `owned_at` */
    uint32_t *fluid_before; /* per particle: number of fluid particles before; an extra entry for the total */
    const uint8_t *foreign; /* per cell: 1 if the cell belongs to a foreign rank and has ghosts; NULL: no
                               ghosts */
    uint8_t *ghost;         /* by `grid`, per particle: 1 for a ghost; NULL: no ghosts */
    SolidStep solid[SOLIDS_MAX];     /* last move per solid; solids are at its end */
    WorldSums *partial;              /* by `sums`: an entry per range */
    WorldGauge gauge;                /* by `gauge` */
    size_t bytes;                    /* of all arrays above */
    size_t guarded;                  /* atomic */
    Forces *forces;                  /* sums of forces on box and solids; NULL: not requested */
    struct CpuForceSums *force_sums; /* scratch for these sums */
    /* Replaces each of `count` sums by the sum over all processes of the world; NULL: a single process. */
    void (*sum_all)(ExactSum *sums, int count);
    /* The same for integers. */
    void (*add_all)(int64_t *numbers, size_t count);
    StepWatch watch;            /* written by `kick` (atomic), read and reset by `watch` */
    struct CoarseLevel *coarse; /* made by the first cpu_coarse_correct */
    bool thin;                  /* since the last `grid`: a correction found the fluid too thin */
} Cpu;

/* Boundary particles are stored among the fluid particles: `fluid` is FLUIDS_MAX + solid, ids start here. */
#define BOUNDARY_ID (UINT64_C(1) << 63)

/* x of a boundary particle set aside, m. Its square is finite, since lanes past a row's end read the
   value. */
#define ASIDE PAST

enum { CPU_GRAIN = LISTS_GRAIN }; /* particles per range: some 0.2 ms of work, small against a step */

PairArgs cpu_pair_args(Cpu *cpu);

/* True for a fluid particle that is no ghost. */
static inline bool cpu_owns(const Cpu *cpu, size_t i)
{
    return cpu->now.fluid[i] < FLUIDS_MAX && !(cpu->ghost && cpu->ghost[i]);
}

/* Finds the next run of own particles at or after *begin, up to *stop; false if no run begins before `end`.
   Without solids and ghosts all particles are a run. */
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

/* Index of the k-th own particle. */
static inline size_t cpu_owned(const Cpu *cpu, size_t k)
{
    return cpu->owned_at ? cpu->owned_at[k] : k;
}

/* True if the k-th own particle and the previous own particle shared a cell in the last grid. Ranks share
   out whole cells, so sums made cell by cell have the same bits on any number of ranks. */
static inline bool cpu_cell_goes_on(const Cpu *cpu, size_t k)
{
    return k > 0 && cpu->gridded == cpu->count &&
           cpu->cell[cpu_owned(cpu, k)] == cpu->cell[cpu_owned(cpu, k - 1)];
}

/* The first own particle from k on that begins a cell; Cpu.owned if none. */
static inline size_t cpu_cell_first(const Cpu *cpu, size_t k)
{
    while (k < cpu->owned && cpu_cell_goes_on(cpu, k))
        k++;
    return k;
}

/* Sets particle i's columns for the pair terms of its fluid, if the scene has these terms. */
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

/* The grid cell of x (m). */
uint32_t cpu_cell_of(const Constants *constants, const float x[3]);

/* Enables ghosts in the cells marked by `foreign` (Cpu.foreign), which must outlive `cpu`. Returns false if
   memory is short. */
bool cpu_share(Cpu *cpu, const uint8_t *foreign);

/* The arrays of a state with constants, capacity and copy_capacity. Returns false if memory is short; call
   cpu_arrays_destroy in either case. */
bool cpu_arrays_create(Cpu *cpu, Error *error);
void cpu_arrays_destroy(Cpu *cpu);

/* Creates needed columns that are missing. */
bool cpu_columns_fit(Cpu *cpu);

/* Grows the room to `capacity` particles, boundary particles included. Keeps columns with COLUMN_SORTED;
   build the grid afterwards. Returns false if memory is short, with nothing changed. */
bool cpu_grow(Cpu *cpu, size_t capacity);

/* Finds the indices of own, ghost and boundary particles after a change without a grid. */
void cpu_find(Cpu *cpu);

/* Builds the grid. Two parts: cpu_cells finds the cell of each particle (`spare_cell`), cpu_sort sorts the
   particles by cell. */
void cpu_grid(void *state);

/* sim/cpu/boundary.c, for boxes with periodic sides.
   _fit: counts the copies after cpu_cells; false if room is short. _grow: makes room; false if memory is
   short, then call _drop: no copies exist, and the step reports the trouble. _place: puts the copies after
   the particles. Before a pass walks, _update copies the columns of the pass's pair sums and _pack the
   packed values. */
bool cpu_copies_fit(Cpu *cpu);
bool cpu_copies_grow(Cpu *cpu);
void cpu_copies_drop(Cpu *cpu);
void cpu_copies_place(Cpu *cpu);
void cpu_copies_update(Cpu *cpu, const Pass *pass);
void cpu_copies_pack(Cpu *cpu);

/* cpu_enter, before a step: the first drift wraps particles over periodic sides at once. cpu_leave, after a
   step: wraps particles that left through a periodic side. In between, particles stay unwrapped to match
   the neighbour lists. */
void cpu_enter(void *state);
void cpu_leave(void *state);
void cpu_cells(Cpu *cpu);
void cpu_sort(Cpu *cpu);
void cpu_run_pass(void *state, const Pass *pass, const PassInput *input);
void cpu_drift(void *state, const BoxStep *step);

/* sim/cpu/boundary.c, for solids. _append: adds the boundary particles after the fluid particles. _move:
   moves boundary particles with the solids. _terms: clears the fluid terms of boundary particle i. _fill:
   extrapolates the fluid to the boundary particles, for forces. _restore: undoes the mirrored velocities of
   _fill. cpu_guard_solids: keeps a particle out of the solids; true if x or v changed. */
void cpu_boundary_append(Cpu *cpu);
void cpu_boundary_move(Cpu *cpu, const SolidStep *steps);
void cpu_boundary_terms(Cpu *cpu, size_t i);
void cpu_boundary_fill(Cpu *cpu, const ApparentGravity *gravity);
void cpu_boundary_restore(Cpu *cpu);
bool cpu_guard_solids(const Cpu *cpu, const SolidStep *steps, const float before[3], float x[3], float v[3]);
void cpu_pose(void *state, const SolidPose *pose);
size_t cpu_emit(void *state, const EmitLayer *layer, size_t most);
/* Parts of cpu_emit. cpu_has_room: true if a particle may be emitted at x (m); x must be in the box and in
   no cell of ghosts. cpu_append: adds the layer's particle `number` at x; the room must exist. */
bool cpu_has_room(Cpu *cpu, const float x[3]);
void cpu_append(Cpu *cpu, const EmitLayer *layer, const float x[3], size_t number);
double cpu_guide(void *state, const Guide *guides, int count);
size_t cpu_drain(void *state, const Fill *regions, int count);

/* Backend.excess and .sum; then the same as parts: adds the positive values or all values to `sum`.
   cpu_excess_part returns the greatest value. */
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
/* sim/cpu/forces.c, if forces were requested. _kick: call after a kick to add its forces. _drift: adds the
   impulses of the drift's guards, summed below. */
bool cpu_enable_forces(void *state, Forces *to, Error *error);
void cpu_add_kick_forces(Cpu *cpu, float dt);
void cpu_add_drift_forces(Cpu *cpu);
bool cpu_gauge(void *state, const double gravity[3]);
bool cpu_gauged(void *state, WorldGauge *gauge, bool waits);
void cpu_energy(void *state, bool turning, EnergySums *sums);
/* cpu_energy as parts that add up: a sum per number of EnergySums. */
enum { ENERGY_SUMS = sizeof(EnergySums) / sizeof(double) };
void cpu_energy_part(Cpu *cpu, bool turning, ExactSum sums[ENERGY_SUMS]);

/* Forces on box and solids, as sums with the same bits for any division of the work: per cell in double,
   exact over cells. */

enum { PUSH_NUMBERS = sizeof(Push) / sizeof(double), FORCE_SUMS_MAX = SOLIDS_MAX + 1 };

typedef struct PushSum {
    ExactSum number[PUSH_NUMBERS];
} PushSum;

/* The part of a range. Initialize `any` to false; the rest needs no value. */
typedef struct CpuForceSums {
    bool any;
    PushSum of[FORCE_SUMS_MAX]; /* the box, then each solid */
} CpuForceSums;

/* cpu_force_sums_begin zeroes the sum; cpu_force_sums_merge adds a range's part to the sum. */
void cpu_force_sums_begin(Cpu *cpu);
void cpu_force_sums_merge(Cpu *cpu, const CpuForceSums *sums);

/* Adds to `sums` the impulse of the guard of `whom` on a particle at x (m): velocity `before` became v.
   Then sets `before` to v. `sums` NULL: adds nothing. */
void cpu_force_of_guard(CpuForceSums *sums, int whom, float mass, const float x[3], const float v[3],
                        float before[3]);

/* A method's pass on the CPU: loops over all particles in sequence, each loop in parallel ranges. */

typedef struct CpuRange {
    Cpu *cpu;
    const PairArgs *args;
    const PassInput *input;
    size_t begin, end;
} CpuRange;

typedef struct CpuLoop {
    void (*body)(const CpuRange *range);
    bool walks; /* over neighbours */
    /* Before a walk, for all particles: fills Cpu.place, .motion or both, as the walk requires. NULL:
       both. */
    void (*pack)(const CpuRange *range);
    bool packed; /* the previous pass has filled them */
    bool solids; /* also over boundary particles; otherwise over runs of own fluid particles */
} CpuLoop;

/* Fluid particle i next to boundary particle b, or to an image of b in the walls of the box. */
typedef struct SolidPair {
    const Cpu *cpu;
    float dt; /* of the step, s */
    size_t i, b;
    float d[3], r; /* x_i - x_b, m; its length in (0, h) */
    float volume;  /* of b in friction, 1 / n; 0 for an image: without friction */
} SolidPair;

/* Force of b on i, N in units of Constants.unit_volume. */
typedef void (*SolidForce)(const SolidPair *pair, float force[3]);

typedef struct CpuPass {
    CpuLoop loops[4];                              /* ended by a loop without a body */
    PairCost (*pair)(const Constants *constants);  /* counted as in sim/step/method.h; NULL: no pairs */
    void (*end)(Cpu *cpu, const PassInput *input); /* after the loops, by itself; NULL: nothing */
    SolidForce solid; /* for forces on solids, after the pass; NULL: no lasting force on solids */
} CpuPass;

/* True if `name` is in the blank-separated list, as in Pass.reads. */
bool cpu_name_among(const char *list, const char *name);

/* Runs the pair sums of a range. */
static inline void cpu_pairs(const CpuRange *range, const PairLoops *loops)
{
    loops->in[range->cpu->pairs](range->args, range->begin, range->end);
}

/* sim/cpu/forces.c: adds the forces of a pass on solids over dt (s). */
void cpu_add_solid_forces(Cpu *cpu, SolidForce force, float dt);

/* F U = -W'(r) / r of a kernel, 1/m2, times `scale`: for few pairs. */
static inline float cpu_slope(const Kernel *kernel, const SolidPair *pair, double scale)
{
    const Constants *s = pair->cpu->constants;
    const double r = (double)pair->r;
    return (float)(-scale * s->unit_volume * kernel->derivative(r, (double)s->support_radius) / r);
}

/* pair_viscosity of sim/def/fluids.h, Pa s, for forces with friction. */
static inline float cpu_pair_viscosity(const SolidPair *pair)
{
    const float *viscosity = pair->cpu->now.viscosity;
    return viscosity ? (float)pair_viscosity((double)viscosity[pair->i], (double)viscosity[pair->b])
                     : 2 * pair->cpu->constants->viscosity[0];
}

/* Adds surface tension, then turns the summed forces into accelerations. */
void cpu_force_end(const CpuRange *range);

/* Adds the cushion of the walls (sim/box/box.h); call after cpu_force_end. */
void cpu_cushion(const CpuRange *range);

/* Adds the share of a particle's weight held by the walls (WallLift); call after cpu_force_end. Fades out
   below the pressure of `from` + 1 layers, so that a drop on a wall falls freely. */
void cpu_wall_lift(const CpuRange *range, float from);

/* The coarse level (sim/step/backend.h) of the own fluid particles. Weights, holds and residuals are of the
   order of 1: sums have 36 bits below 1, and a hold or residual counts up to 100. */
typedef struct CoarseTerms {
    const float *weight; /* per particle, at least 0; with 0 the particle's value stays */
    const float *hold;   /* at least 0: what holds v at 0, as a free surface holds pressure */
    const float *residual;
    float *value; /* += scale * v */
    float scale;
    bool negative; /* values may be below 0 */
    double left;   /* the part of the residual of v that is enough, 0 to 1 */
} CoarseTerms;

typedef struct CoarseLevel CoarseLevel;

/* Corrects the values, with the same bits on any number of threads and ranks. Needs the grid of the present
   positions. Thin fluid is left to iterations: then values stay, and Cpu.thin says so until the next grid. If
   memory is short, values stay and StepWatch.memory says so. */
void cpu_coarse_correct(Cpu *cpu, const CoarseTerms *terms);
void cpu_coarse_destroy(CoarseLevel *level);

/* The machine's peak rates on some threads: the best of a few tries. */

/* Returns false if memory is short. */
bool ceilings_measure(int threads, PairSet set, Ceilings *out);

#endif
