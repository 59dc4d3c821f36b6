#include "sim/dist/ranks.h"

#include "sim/cpu/pass.h"
#include "sim/dist/dist.h"
#include "sim/dist/reduce.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { PASSES_KNOWN = 64, BALANCE_EVERY = 20 /* looks at the shares: frames */ };

/* Shares are made anew where the slowest rank takes so many times the mean. */
static const double UNEVEN = 1.05;

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
    int looks;       /* marks since the last look at the shares */
    bool due;        /* shares are to be made anew at the next grid */
    double cpu_time; /* s of this rank's computing since the last look */
    float *came;     /* places of particles that emitters sent out since the grid, on any rank */
    size_t came_count, came_room;
    RanksFigures figures;
} Ranks;

static bool balances = true;
static Ranks *told;

void ranks_figures(RanksFigures *figures)
{
    WorldInfo info;
    *figures = (RanksFigures){.compute = 0};
    if (!told)
        return;
    backend_cpu.info(told->cpu, &info);
    *figures = told->figures;
    figures->bytes = info.state_bytes;
    figures->owned = told->cpu->owned;
    figures->ghosts = dist_ghosts(told->dist);
    told->figures = (RanksFigures){.compute = 0};
}

void ranks_balance(bool on)
{
    balances = on;
}

/* ---- clocks ---- */

static double seconds(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct Clock {
    double wall, cpu;
} Clock;

static Clock clock_now(void)
{
    return (Clock){MPI_Wtime(), seconds(CLOCK_PROCESS_CPUTIME_ID)};
}

static void computed(Ranks *ranks, Clock since)
{
    ranks->figures.compute += MPI_Wtime() - since.wall;
    ranks->cpu_time += seconds(CLOCK_PROCESS_CPUTIME_ID) - since.cpu;
}

static void exchanged(Ranks *ranks, Clock since)
{
    const DistSent sent = dist_sent(ranks->dist);
    ranks->figures.exchange += MPI_Wtime() - since.wall;
    ranks->figures.sent += sent.bytes;
    ranks->figures.messages += sent.messages;
}

/* For who is slower, before an exchange, so that the exchange's time is its own. */
static void wait_for_others(Ranks *ranks)
{
    const double begin = MPI_Wtime();
    if (dist_size(ranks->dist) > 1)
        MPI_Barrier(MPI_COMM_WORLD);
    ranks->figures.wait += MPI_Wtime() - begin;
}

/* ---- columns by their names ---- */

/* Whether the name is among those of the list. */
static bool among(const char *list, const char *name)
{
    const size_t size = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += size)
        if ((at == list || at[-1] == ' ') && (at[size] == ' ' || at[size] == 0))
            return true;
    return false;
}

static uint64_t rows_named(const Cpu *cpu, const char *list)
{
    uint64_t rows = 0;
    for (int r = 0; r < cpu->all.count; r++)
        if (among(list, cpu->all.row[r]->name))
            rows |= UINT64_C(1) << r;
    return rows;
}

static Touched look_at(const Cpu *cpu, const Pass *pass)
{
    Touched touched = {.pass = pass,
                       .reads = rows_named(cpu, pass->reads),
                       .writes = rows_named(cpu, pass->writes),
                       .whole = true};
    for (const CpuLoop *loop = pass->cpu->loops; loop->body; loop++) {
        touched.walks |= loop->walks;
        touched.packed |= loop->packed;
        touched.whole &= loop->solids && !loop->walks;
    }
    return touched;
}

static Touched touched_by(Ranks *ranks, const Pass *pass)
{
    for (int k = 0; k < ranks->known_count; k++)
        if (ranks->known[k].pass == pass)
            return ranks->known[k];
    const Touched touched = look_at(ranks->cpu, pass);
    if (ranks->known_count < PASSES_KNOWN)
        ranks->known[ranks->known_count++] = touched;
    return touched;
}

/* What ghosts had of these columns is old now. */
static void stale(Ranks *ranks, const char *names)
{
    ranks->fresh &= ~rows_named(ranks->cpu, names);
}

/* ---- the grid ---- */

/* What its cells cost: particles, each as much as the rank's took. */
static void weigh(Ranks *ranks)
{
    const Cpu *cpu = ranks->cpu;
    const uint8_t *foreign = dist_foreign(ranks->dist);
    const double each = ranks->cpu_time / (double)(cpu->owned > 0 ? cpu->owned : 1);
    for (size_t cell = 0; cell < cpu->constants->cells.count; cell++)
        ranks->weight[cell] = 0;
    for (size_t i = 0; i < cpu->count; i++) {
        const uint32_t cell =
            cpu_cell_of(cpu->constants, (float[]){cpu->now.x[i], cpu->now.y[i], cpu->now.z[i]});
        if (cpu_owns(cpu, i) && !foreign[cell])
            ranks->weight[cell] += each;
    }
}

static void share_anew(Ranks *ranks)
{
    const double begin = MPI_Wtime();
    weigh(ranks);
    dist_balance(ranks->dist, ranks->weight, false);
    ranks->due = false;
    ranks->cpu_time = 0;
    ranks->figures.balances++;
    ranks->figures.balance += MPI_Wtime() - begin;
}

static void ranks_grid(void *state)
{
    Ranks *ranks = state;
    wait_for_others(ranks);
    if (ranks->due)
        share_anew(ranks);
    Clock begin = clock_now();
    dist_drop(ranks->dist, ranks->cpu);
    dist_migrate(ranks->dist, ranks->cpu);
    dist_halo(ranks->dist, ranks->cpu);
    exchanged(ranks, begin);
    begin = clock_now();
    cpu_grid(ranks->cpu);
    dist_follow(ranks->dist, ranks->cpu);
    computed(ranks, begin);
    ranks->fresh = rows_named(ranks->cpu, "position id fluid");
    ranks->came_count = 0;
}

/* ---- begin and end ---- */

static void ranks_destroy(void *state)
{
    Ranks *ranks = state;
    if (told == ranks)
        told = NULL;
    if (ranks->cpu)
        backend_cpu.destroy(ranks->cpu);
    dist_end(ranks->dist);
    columns_destroy(&ranks->kept);
    free(ranks->weight);
    free(ranks->came);
    free(ranks);
}

/* Those of an initial state whose cells are the rank's own. */
typedef struct Share {
    InitialState initial;
    float *position, *velocity, *density, *pressure;
    uint8_t *fluid;
    uint32_t *id;
} Share;

static void share_free(Share *share)
{
    void *const all[] = {share->position, share->velocity, share->density,
                         share->pressure, share->fluid,    share->id};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        free(all[k]);
}

static void *some(const void *wanted, size_t count, size_t size)
{
    void *memory = wanted ? malloc((count + 1) * size) : NULL;
    if (wanted && !memory)
        dist_die("no memory for %zu particles; use more ranks or a larger spacing", count);
    return memory;
}

static bool is_own(const Dist *dist, const Constants *constants, const float *x)
{
    return dist_owner(dist, cpu_cell_of(constants, x)) == dist_rank(dist);
}

static void share_take(const Ranks *ranks, const Constants *constants, const InitialState *from, Share *share)
{
    size_t count = 0;
    for (size_t i = 0; i < from->count; i++)
        count += is_own(ranks->dist, constants, from->position + 3 * i);
    share->position = some(from, count, 3 * sizeof(float));
    share->velocity = some(from->velocity, count, 3 * sizeof(float));
    share->density = some(from->density, count, sizeof(float));
    share->pressure = some(from->pressure, count, sizeof(float));
    share->fluid = some(from->fluid, count, 1);
    share->id = some(from, count, sizeof(uint32_t));
    count = 0;
    for (size_t i = 0; i < from->count; i++) {
        if (!is_own(ranks->dist, constants, from->position + 3 * i))
            continue;
        memcpy(share->position + 3 * count, from->position + 3 * i, 3 * sizeof(float));
        if (share->velocity)
            memcpy(share->velocity + 3 * count, from->velocity + 3 * i, 3 * sizeof(float));
        if (share->density)
            share->density[count] = from->density[i];
        if (share->pressure)
            share->pressure[count] = from->pressure[i];
        if (share->fluid)
            share->fluid[count] = from->fluid[i];
        share->id[count++] = (uint32_t)i;
    }
    share->initial = (InitialState){.count = count,
                                    .position = share->position,
                                    .velocity = share->velocity,
                                    .fluid = share->fluid,
                                    .density = share->density,
                                    .pressure = share->pressure};
}

/* The first shares: by the particles of each cell, which all ranks know; of an empty box by its cells. */
static void share_first(Ranks *ranks, const Constants *constants, const InitialState *initial)
{
    for (size_t cell = 0; initial->count == 0 && cell < constants->cells.count; cell++)
        ranks->weight[cell] = 1;
    for (size_t i = 0; i < initial->count; i++)
        ranks->weight[cpu_cell_of(constants, initial->position + 3 * i)]++;
    dist_balance(ranks->dist, ranks->weight, true);
}

/* Room for a rank's own particles as they come and go, and for ghosts. */
static size_t room_for(size_t count, int size)
{
    return size == 1 ? count : count + count / 8 + 1024;
}

static void *ranks_create(const Constants *constants, const WorldDef *def, const InitialState *initial,
                          size_t capacity, Error *error)
{
    Ranks *ranks = calloc(1, sizeof *ranks);
    Share share;
    if (!ranks)
        dist_die("no memory");
    ranks->dist = dist_init(constants);
    ranks->weight = calloc(constants->cells.count, sizeof *ranks->weight);
    if (!ranks->weight)
        dist_die("no memory for %zu cells; use a larger spacing or a smaller box", constants->cells.count);
    const int size = dist_size(ranks->dist);
    share_first(ranks, constants, initial);
    share_take(ranks, constants, initial, &share);
    ranks->total = initial->count;
    ranks->cpu = backend_cpu.create(constants, def, &share.initial,
                                    size == 1 ? capacity : room_for(share.initial.count, size), error);
    if (!ranks->cpu)
        dist_die("%s", error->message);
    for (size_t i = 0; i < share.initial.count; i++)
        ranks->cpu->now.id[i] = share.id[i];
    share_free(&share);
    if (size > 1 && !cpu_share(ranks->cpu, dist_foreign(ranks->dist)))
        dist_die("no memory for %zu particles; use more ranks or a larger spacing", ranks->cpu->count);
    told = ranks;
    return ranks;
}

static bool ranks_can(const WorldDef *def, Error *error)
{
    for (int k = 0; k < def->solid_count; k++)
        if (solid_floats(&def->solids[k]))
            return error_set(
                error, "slosh-dist has no solids that float yet (solids[%d].density); use slosh run", k);
    return true;
}

static bool ranks_adapt(void *state, Error *error)
{
    Ranks *ranks = state;
    ranks->known_count = 0;
    ranks->fresh = 0;
    if (!backend_cpu.adapt(ranks->cpu, error))
        dist_die("%s", error->message);
    return true;
}

/* ---- a step ---- */

static void ranks_pose(void *state, const SolidPose *pose)
{
    cpu_pose(((Ranks *)state)->cpu, pose);
}

static void ranks_drift(void *state, const BoxStep *step)
{
    Ranks *ranks = state;
    const Clock begin = clock_now();
    cpu_drift(ranks->cpu, step);
    stale(ranks, "position velocity");
    computed(ranks, begin);
}

static void ranks_run(void *state, const Pass *pass, const PassInput *input)
{
    Ranks *ranks = state;
    const Touched touched = touched_by(ranks, pass);
    const uint64_t wanted = touched.walks || touched.whole ? touched.reads & ~ranks->fresh : 0;
    if (wanted || touched.packed) {
        wait_for_others(ranks);
        const Clock begin = clock_now();
        dist_update(ranks->dist, ranks->cpu, wanted, touched.packed);
        ranks->fresh |= wanted;
        exchanged(ranks, begin);
    }
    const Clock begin = clock_now();
    cpu_run_pass(ranks->cpu, pass, input);
    if (touched.whole) /* ghosts have it too, from what their owners had */
        ranks->fresh |= touched.writes;
    else
        ranks->fresh &= ~touched.writes;
    computed(ranks, begin);
}

static void ranks_kick(void *state, const float gravity[3], float dt)
{
    Ranks *ranks = state;
    const Clock begin = clock_now();
    cpu_kick(ranks->cpu, gravity, dt);
    stale(ranks, "velocity acceleration");
    computed(ranks, begin);
}

static void ranks_touch(void *state, const FingerStep *finger)
{
    Ranks *ranks = state;
    cpu_touch(ranks->cpu, finger);
    stale(ranks, "velocity");
}

static void ranks_guide(void *state, const Guide *guides, int count)
{
    Ranks *ranks = state;
    cpu_guide(ranks->cpu, guides, count);
    stale(ranks, "velocity");
}

static StepWatch ranks_watch(void *state)
{
    Ranks *ranks = state;
    Clock begin = clock_now();
    StepWatch watch = cpu_watch(ranks->cpu);
    computed(ranks, begin);
    wait_for_others(ranks);
    begin = clock_now();
    double most[5] = {(double)watch.max_speed, (double)watch.max_acceleration,
                      (double)watch.max_density_ratio, !watch.bounded, watch.memory};
    reduce_most(most, 5);
    watch.max_speed = (float)most[0];
    watch.max_acceleration = (float)most[1];
    watch.max_density_ratio = (float)most[2];
    watch.bounded = most[3] == 0;
    watch.memory = most[4] != 0;
    ranks->guarded = ranks->began_guarded + (size_t)reduce_count((int64_t)ranks->cpu->guarded);
    exchanged(ranks, begin);
    return watch;
}

static Excess ranks_excess(void *state, const ColumnDef *column)
{
    Ranks *ranks = state;
    ExactSum sum = {.strange = false};
    Clock begin = clock_now();
    double most = (double)cpu_excess_part(ranks->cpu, column, &sum);
    computed(ranks, begin);
    wait_for_others(ranks);
    begin = clock_now();
    reduce_exact(&sum, 1);
    reduce_most(&most, 1);
    exchanged(ranks, begin);
    return (Excess){.mean = exact_value(&sum) / (ranks->total > 0 ? (double)ranks->total : 1),
                    .greatest = (float)most};
}

static double ranks_sum(void *state, const ColumnDef *column)
{
    Ranks *ranks = state;
    ExactSum sum = {.strange = false};
    Clock begin = clock_now();
    cpu_sum_part(ranks->cpu, column, &sum);
    computed(ranks, begin);
    wait_for_others(ranks);
    begin = clock_now();
    reduce_exact(&sum, 1);
    exchanged(ranks, begin);
    return exact_value(&sum);
}

static void ranks_energy(void *state, bool turning, EnergySums *sums)
{
    Ranks *ranks = state;
    ExactSum all[ENERGY_SUMS] = {{.strange = false}};
    double each[ENERGY_SUMS];
    cpu_energy_part(ranks->cpu, turning, all);
    reduce_exact(all, ENERGY_SUMS);
    for (int k = 0; k < ENERGY_SUMS; k++)
        each[k] = exact_value(&all[k]);
    memcpy(sums, each, sizeof *sums);
}

/* ---- what others read ---- */

static void ranks_sums(void *state, WorldSums *sums)
{
    Ranks *ranks = state;
    enum { COUNT = sizeof *sums / sizeof(double) };
    double each[COUNT], most;
    const double owned = (double)ranks->cpu->owned;
    cpu_sums(ranks->cpu, sums);
    for (int k = 0; k < 3; k++)
        sums->centre[k] = owned > 0 ? sums->centre[k] * sums->mass : 0;
    sums->neighbours_mean *= owned;
    most = sums->max_speed;
    memcpy(each, sums, sizeof each);
    reduce_sum(each, COUNT);
    reduce_most(&most, 1);
    memcpy(sums, each, sizeof each);
    sums->max_speed = most;
    for (int k = 0; k < 3 && sums->mass > 0; k++)
        sums->centre[k] /= sums->mass;
    sums->neighbours_mean /= ranks->total > 0 ? (double)ranks->total : 1;
}

enum { ARRAYS = sizeof(ParticleArrays) / sizeof(void *) };

/* Bytes of a particle in array k of a ParticleArrays. */
static size_t array_size(int k)
{
    const size_t at = (size_t)k * sizeof(void *);
    const bool four = at == offsetof(ParticleArrays, position) || at == offsetof(ParticleArrays, velocity);
    return four ? 4 * sizeof(float) : sizeof(float);
}

/* One array, gathered where it is wanted. */
static void read_one(Ranks *ranks, int k, void *all)
{
    void *local[ARRAYS] = {NULL};
    ParticleArrays arrays;
    local[k] = some(ranks, ranks->cpu->owned, array_size(k));
    memset(local[k], 0, ranks->cpu->owned * array_size(k));
    memcpy(&arrays, local, sizeof arrays);
    cpu_read(ranks->cpu, &arrays);
    reduce_gather(local[k], ranks->cpu->owned, array_size(k), all);
    free(local[k]);
}

static bool ranks_read(void *state, const ParticleArrays *out)
{
    void *all[ARRAYS];
    double wanted[ARRAYS];
    memcpy(all, out, sizeof all);
    for (int k = 0; k < ARRAYS; k++)
        wanted[k] = all[k] != NULL;
    reduce_most(wanted, ARRAYS);
    for (int k = 0; k < ARRAYS; k++)
        if (wanted[k] > 0)
            read_one(state, k, all[k]);
    return true;
}

static bool ranks_save(void *state, const ParticleColumns *to)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    ParticleColumns from = {.x = NULL}, out = *to;
    if (!columns_create(&from, &cpu->saved, cpu->owned, NULL))
        dist_die("no memory for the state of %zu particles", cpu->owned);
    backend_cpu.save(cpu, &from);
    for (int r = 0; r < cpu->saved.count; r++)
        for (int c = 0; c < cpu->saved.row[r]->components; c++)
            reduce_gather(*column_array(&from, cpu->saved.row[r], c), cpu->owned,
                          column_size(cpu->saved.row[r]), *column_array(&out, cpu->saved.row[r], c));
    columns_destroy(&from);
    return true;
}

/* ---- going back and going on ---- */

static void start_with(Ranks *ranks, size_t count, size_t guarded)
{
    Cpu *cpu = ranks->cpu;
    cpu->count = cpu->owned = count;
    if (cpu->boundary_at)
        cpu_boundary_append(cpu);
    if (cpu->ghost)
        memset(cpu->ghost, 0, cpu->count);
    cpu->guarded = 0;
    ranks->began_guarded = ranks->guarded = guarded;
    ranks->fresh = 0;
}

/* No ghosts, and room for so many particles of its own. */
static void make_room(Ranks *ranks, size_t count)
{
    Cpu *cpu = ranks->cpu;
    const size_t all = count + cpu->constants->boundary.count;
    dist_drop(ranks->dist, cpu);
    if (all > cpu->capacity && !cpu_grow(cpu, room_for(all, 2)))
        dist_die("no memory for %zu particles; use more ranks or a larger spacing", all);
}

static bool ranks_load(void *state, const ParticleColumns *from, size_t count, size_t guarded)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    uint32_t *own = malloc((count + 1) * sizeof *own);
    size_t owned = 0;
    if (!own)
        dist_die("no memory for %zu particles", count);
    for (size_t i = 0; i < count; i++)
        if (is_own(ranks->dist, cpu->constants, (float[]){from->x[i], from->y[i], from->z[i]}))
            own[owned++] = (uint32_t)i;
    make_room(ranks, owned);
    columns_copy(&cpu->saved, from, &cpu->now, own, 0, owned);
    free(own);
    ranks->total = count;
    start_with(ranks, owned, guarded);
    return true;
}

/* Whether the slowest rank of late was much slower than the mean. */
static void look_at_shares(Ranks *ranks)
{
    double time[2] = {ranks->cpu_time, ranks->cpu_time};
    if (!balances || dist_size(ranks->dist) == 1 || ++ranks->looks < BALANCE_EVERY)
        return;
    ranks->looks = 0;
    reduce_sum(&time[0], 1);
    reduce_most(&time[1], 1);
    ranks->due = time[1] > UNEVEN * time[0] / dist_size(ranks->dist);
    if (!ranks->due)
        ranks->cpu_time = 0;
}

static bool ranks_mark(void *state, Error *error)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    (void)error;
    look_at_shares(ranks);
    if (cpu->owned > ranks->kept_room || !ranks->kept.x) {
        columns_destroy(&ranks->kept);
        ranks->kept_room = cpu->owned + cpu->owned / 16 + 16;
    }
    if (!columns_create(&ranks->kept, &cpu->saved, ranks->kept_room, NULL))
        dist_die("no memory for the state of %zu particles", cpu->owned);
    ranks->kept_count = cpu->owned;
    return backend_cpu.save(cpu, &ranks->kept);
}

static void ranks_back(void *state, size_t count, size_t guarded)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    make_room(ranks, ranks->kept_count);
    columns_copy(&cpu->saved, &ranks->kept, &cpu->now, NULL, 0, ranks->kept_count);
    ranks->total = count;
    start_with(ranks, ranks->kept_count, guarded);
}

static void ranks_info(const void *state, WorldInfo *info)
{
    const Ranks *ranks = state;
    backend_cpu.info(ranks->cpu, info);
    info->guarded = ranks->guarded;
}

/* ---- particles that come and go ---- */

/* Whether none of those that came since the grid, on any rank, is near. */
static bool clear_of_others(const Ranks *ranks, const float x[3])
{
    const Constants *s = ranks->cpu->constants;
    const float least = 0.9f * s->spacing; /* as sim/cpu/flow.c has it */
    for (size_t k = 0; k < ranks->came_count; k++) {
        const float *other = ranks->came + 3 * k;
        float d[3] = {x[0] - other[0], x[1] - other[1], x[2] - other[2]};
        periodic_nearest(&s->periodic, d);
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < least * least)
            return false;
    }
    return true;
}

/* Who came on another rank since the grid. */
static void note(Ranks *ranks, const float x[3])
{
    if (ranks->came_count == ranks->came_room) {
        ranks->came_room = 2 * ranks->came_room + 256;
        ranks->came = realloc(ranks->came, ranks->came_room * 3 * sizeof *ranks->came);
        if (!ranks->came)
            dist_die("no memory for the particles that come");
    }
    memcpy(ranks->came + 3 * ranks->came_count++, x, 3 * sizeof *x);
}

/* On each rank, where one of them has none: then with another grid, since that is lost. */
static void room_to_emit(Ranks *ranks, size_t count)
{
    Cpu *cpu = ranks->cpu;
    double full = cpu->count + count > cpu->capacity;
    reduce_most(&full, 1);
    if (full == 0)
        return;
    dist_drop(ranks->dist, cpu);
    if (!cpu_grow(cpu, room_for(cpu->count + count, 2)))
        dist_die("no memory for the particles that come");
    ranks_grid(ranks);
}

/* Who owns the cell of a place says whether there is room. Places of one layer are a spacing apart: they do
   not ask each other. */
static size_t ranks_emit(void *state, const EmitLayer *layer, size_t most)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    size_t number = 0;
    double *room = some(layer, layer->count, sizeof *room);
    room_to_emit(ranks, layer->count);
    for (size_t k = 0; k < layer->count; k++) {
        const float *x = layer->position + 3 * k;
        room[k] = walls_contain(&cpu->constants->walls, x) && is_own(ranks->dist, cpu->constants, x) &&
                  cpu_has_room(cpu, x) && clear_of_others(ranks, x);
    }
    reduce_most(room, (int)layer->count);
    for (size_t k = 0; k < layer->count && number < most; k++) {
        const float *x = layer->position + 3 * k;
        if (room[k] == 0)
            continue;
        if (is_own(ranks->dist, cpu->constants, x))
            cpu_append(cpu, layer, x, number);
        else
            note(ranks, x);
        number++;
    }
    free(room);
    ranks->total += number;
    return number;
}

static size_t ranks_drain(void *state, const Fill *regions, int count)
{
    Ranks *ranks = state;
    const size_t gone = (size_t)reduce_count((int64_t)cpu_drain(ranks->cpu, regions, count));
    ranks->total -= gone;
    return gone;
}

const Backend backend_ranks = {
    .name = RANKS_BACKEND,
    .help = "backend cpu on MPI ranks",
    .can = ranks_can,
    .create = ranks_create,
    .destroy = ranks_destroy,
    .adapt = ranks_adapt,
    .pose = ranks_pose,
    .drift = ranks_drift,
    .grid = ranks_grid,
    .run = ranks_run,
    .excess = ranks_excess,
    .sum = ranks_sum,
    .kick = ranks_kick,
    .watch = ranks_watch,
    .touch = ranks_touch,
    .guide = ranks_guide,
    .sums = ranks_sums,
    .read = ranks_read,
    .energy = ranks_energy,
    .emit = ranks_emit,
    .drain = ranks_drain,
    .save = ranks_save,
    .load = ranks_load,
    .mark = ranks_mark,
    .back = ranks_back,
    .info = ranks_info,
};
