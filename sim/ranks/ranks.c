/* States: read and marked by each rank alone, saved and loaded by all ranks together. */
#include "sim/ranks/ranks.h"

#include "sim/ranks/ranks_private.h"

#include <stdlib.h>
#include <string.h>

/* Once per frame: sharing is due if the slowest rank was much slower than the mean. */
static void look_at_shares(Ranks *ranks);

static bool ranks_read(void *state, const ParticleArrays *out)
{
    return cpu_read(((Ranks *)state)->cpu, out);
}

static size_t ranks_held(const void *state)
{
    return ((const Ranks *)state)->cpu->owned;
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

/* ---- load, mark and back ---- */

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

/* Drops the ghosts and makes room for `count` own particles. */
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

/* Shares of the cells: at the start and as the fluid moves. */

/* Cells are shared out again if the slowest rank takes more than UNEVEN times the mean time, and the time
   lost since the last sharing exceeds TAKES times the cost of sharing: moved particles cost about as much
   again. */
static const double UNEVEN = 1.05, TAKES = 2;

static bool balances = true;

void ranks_balance(bool on)
{
    balances = on;
}

bool is_own(const Dist *dist, const Constants *constants, const float *x)
{
    return dist_owner(dist, cpu_cell_of(constants, x)) == dist_rank(dist);
}

/* First shares: by the particles of each cell, known to all ranks; an empty box is shared by cells. */
static void share_first(Ranks *ranks, const Constants *constants, const InitialState *initial)
{
    const Clock begin = clock_now();
    for (size_t cell = 0; initial->count == 0 && cell < constants->cells.count; cell++)
        ranks->weight[cell] = 1;
    for (size_t i = 0; i < initial->count; i++)
        ranks->weight[cpu_cell_of(constants, initial->position + 3 * i)]++;
    dist_balance(ranks->dist, ranks->weight, true);
    ranks->took = clock_now().cpu - begin.cpu;
}

/* Call after cpu_cells. Weight of each own cell: its particles, each at the rank's mean time per particle
   and step. */
static void weigh(Ranks *ranks)
{
    const Cpu *cpu = ranks->cpu;
    const uint8_t *foreign = dist_foreign(ranks->dist);
    const double each = ranks->cpu_time / (ranks->worked > 0 ? ranks->worked : 1);
    for (size_t cell = 0; cell < cpu->constants->cells.count; cell++)
        ranks->weight[cell] = 0;
    for (size_t i = 0; i < cpu->count; i++) {
        const uint32_t cell = cpu->spare_cell[i];
        if (cpu_owns(cpu, i) && !foreign[cell])
            ranks->weight[cell] += each;
    }
}

void share_anew(Ranks *ranks)
{
    const Clock begin = clock_now();
    weigh(ranks);
    dist_balance(ranks->dist, ranks->weight, false);
    ranks->due = false;
    ranks->cpu_time = ranks->worked = 0;
    ranks->figures.balances++;
    const Clock end = clock_now();
    ranks->took = end.cpu - begin.cpu;
    ranks->figures.balance += end.wall - begin.wall;
}

static void look_at_shares(Ranks *ranks)
{
    /* The least time of all ranks is the cost of sharing: a late rank or a rank on a shared core waits and
       would raise the cost. */
    double most[2] = {ranks->cpu_time, -ranks->took}, mean = ranks->cpu_time;
    if (!balances || dist_size(ranks->dist) == 1)
        return;
    reduce_most(most, 2);
    reduce_sum(&mean, 1);
    mean /= dist_size(ranks->dist);
    ranks->due = most[0] > UNEVEN * mean && (most[0] - mean) / ranks->cpu->threads > TAKES * -most[1];
}

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

size_t ranks_owned(void)
{
    return told ? told->cpu->owned : 0;
}

void ranks_cells(uint32_t *cell)
{
    for (size_t k = 0; told && k < told->cpu->owned; k++)
        cell[k] = told->cpu->cell[cpu_owned(told->cpu, k)];
}

/* Runs within computing time, but counts as waiting and exchange only. */
static void sum_all(ExactSum *sums, int count)
{
    const Clock begin = clock_now();
    wait_for_others(told);
    const Clock met = clock_now();
    reduce_exact(sums, count);
    exchanged(told, met);
    not_computed(told, begin);
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

/* Particles of an initial state in the rank's own cells. */
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

void *some(const void *wanted, size_t count, size_t size)
{
    void *memory = wanted ? malloc((count + 1) * size) : NULL;
    if (wanted && !memory)
        dist_die("no memory for %zu particles; use more ranks or a larger spacing", count);
    return memory;
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

size_t room_for(size_t count, int size)
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
    ranks->cpu->sum_all = size > 1 ? sum_all : NULL;
    for (size_t i = 0; i < share.initial.count; i++)
        ranks->cpu->now.id[i] = share.id[i];
    share_free(&share);
    if (size > 1 && !cpu_share(ranks->cpu, dist_foreign(ranks->dist)))
        dist_die("no memory for %zu particles; use more ranks or a larger spacing", ranks->cpu->count);
    told = ranks;
    return ranks;
}

static bool ranks_feel(void *state, Forces *to, Error *error)
{
    if (!cpu_feel(((Ranks *)state)->cpu, to, error))
        dist_die("%s", error->message);
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

static void ranks_info(const void *state, WorldInfo *info)
{
    const Ranks *ranks = state;
    backend_cpu.info(ranks->cpu, info);
    info->guarded = ranks->guarded;
}

const Backend backend_ranks = {
    .name = RANKS_BACKEND,
    .help = "backend cpu on MPI ranks",
    .create = ranks_create,
    .destroy = ranks_destroy,
    .adapt = ranks_adapt,
    .pose = ranks_pose,
    .enter = ranks_enter,
    .leave = ranks_leave,
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
    .held = ranks_held,
    .energy = ranks_energy,
    .feel = ranks_feel,
    .emit = ranks_emit,
    .drain = ranks_drain,
    .save = ranks_save,
    .load = ranks_load,
    .mark = ranks_mark,
    .back = ranks_back,
    .info = ranks_info,
};
