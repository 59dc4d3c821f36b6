/* States: read and marked by each rank alone, saved and loaded by all ranks together. */
#include "sim/ranks/ranks.h"

#include "sim/ranks/ranks_private.h"

#include <stdlib.h>
#include <string.h>

/* Once per frame: sharing is due if the slowest rank was much slower than the mean. */
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
    if (cpu->owned > ranks->marked_capacity || !ranks->marked.x) {
        columns_destroy(&ranks->marked);
        ranks->marked_capacity = cpu->owned + cpu->owned / 16 + 16;
    }
    if (!columns_create(&ranks->marked, &cpu->saved, ranks->marked_capacity, NULL))
        dist_die("no memory for the state of %zu particles", cpu->owned);
    ranks->marked_count = cpu->owned;
    return backend_cpu.save(cpu, &ranks->marked);
}

static void ranks_back(void *state, size_t count, size_t guarded)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    make_room(ranks, ranks->marked_count);
    columns_copy(&cpu->saved, &ranks->marked, &cpu->now, NULL, 0, ranks->marked_count);
    ranks->total = count;
    start_with(ranks, ranks->marked_count, guarded);
}

/* Shares of the cells: at the start and as the fluid moves. */

static Ranks *reporting;

void ranks_figures(RanksFigures *figures)
{
    WorldInfo info;
    *figures = (RanksFigures){.compute = 0};
    if (!reporting)
        return;
    backend_cpu.info(reporting->cpu, &info);
    *figures = reporting->figures;
    figures->bytes = info.state_bytes;
    figures->owned = reporting->cpu->owned;
    figures->ghosts = dist_ghosts(reporting->dist);
    reporting->figures = (RanksFigures){.compute = 0};
}

void ranks_cells(uint32_t *cell)
{
    for (size_t k = 0; reporting && k < reporting->cpu->owned; k++)
        cell[k] = reporting->cpu->cell[cpu_owned(reporting->cpu, k)];
}

/* Runs within computing time, but counts as waiting and exchange only. */
static void sum_all(ExactSum *sums, int count)
{
    const Clock begin = clock_now();
    wait_for_others(reporting);
    const Clock met = clock_now();
    reduce_exact(sums, count);
    exchanged(reporting, met);
    not_computed(reporting, begin);
}

static void add_all(int64_t *numbers, size_t count)
{
    const Clock begin = clock_now();
    wait_for_others(reporting);
    const Clock met = clock_now();
    reduce_integers(numbers, count);
    exchanged(reporting, met);
    not_computed(reporting, begin);
}

/* ---- begin and end ---- */

static void ranks_destroy(void *state)
{
    Ranks *ranks = state;
    if (reporting == ranks)
        reporting = NULL;
    if (ranks->cpu)
        backend_cpu.destroy(ranks->cpu);
    dist_end(ranks->dist);
    columns_destroy(&ranks->marked);
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
    ranks->cpu->add_all = size > 1 ? add_all : NULL;
    for (size_t i = 0; i < share.initial.count; i++)
        ranks->cpu->now.id[i] = share.id[i];
    share_free(&share);
    if (size > 1 && !cpu_share(ranks->cpu, dist_foreign(ranks->dist)))
        dist_die("no memory for %zu particles; use more ranks or a larger spacing", ranks->cpu->count);
    reporting = ranks;
    return ranks;
}

static bool ranks_enable_forces(void *state, Forces *to, Error *error)
{
    if (!cpu_enable_forces(((Ranks *)state)->cpu, to, error))
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
    .gauge = ranks_gauge,
    .gauged = ranks_gauged,
    .read = ranks_read,
    .held = ranks_held,
    .energy = ranks_energy,
    .enable_forces = ranks_enable_forces,
    .emit = ranks_emit,
    .drain = ranks_drain,
    .save = ranks_save,
    .load = ranks_load,
    .mark = ranks_mark,
    .back = ranks_back,
    .info = ranks_info,
};
