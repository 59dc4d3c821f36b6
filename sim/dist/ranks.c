#include "sim/dist/ranks_state.h"
#include "sim/dist/reduce.h"

#include <stdlib.h>
#include <string.h>

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
