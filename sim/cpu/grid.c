/* Counting sort by places of the cell fold (sim/step/cells.h). Atomic counters hand out the places
   within a cell in any order; a sort by cell and id follows. So the result depends on positions and ids
   only, not on threads or history. */
#include "sim/cpu/cpu.h"

#include "sim/base/parallel.h"
#include "sim/cpu/pairs.h"
#include "slosh/world.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct CellMap {
    float origin[3], inverse[3], first[3], last[3]; /* cells inside the border */
    int size[3];
} CellMap;

static CellMap cell_map(const Constants *constants)
{
    const CellGrid *cells = &constants->cells;
    CellMap map;
    for (int k = 0; k < 3; k++) {
        map.origin[k] = cells->origin[k];
        map.inverse[k] = cells->inverse[k];
        map.first[k] = (float)(cells->first[k] + 1);
        map.last[k] = (float)(cells->first[k] + cells->size[k] - 2);
        map.size[k] = cells->size[k];
    }
    return map;
}

/* The cell along axis k, clamped, so that a non-finite position does no harm before the report. Without
   libm: its floorf is a call on baseline x86-64. */
static uint32_t cell_along(const CellMap *map, int k, float x)
{
    const float place = (x - map->origin[k]) * map->inverse[k];
    const float held = place < map->last[k]    ? (place > map->first[k] ? place : map->first[k])
                       : place >= map->last[k] ? map->last[k]
                                               : map->first[k];
    const int towards_zero = (int)held, whole = towards_zero - ((float)towards_zero > held);
    return (uint32_t)(whole - (int)map->first[k]) + 1;
}

static uint32_t cell_at(const CellMap *map, float x, float y, float z)
{
    const uint32_t ix = cell_along(map, 0, x), iy = cell_along(map, 1, y), iz = cell_along(map, 2, z);
    return (iz * (uint32_t)map->size[1] + iy) * (uint32_t)map->size[0] + ix;
}

uint32_t cpu_cell_of(const Constants *constants, const float x[3])
{
    const CellMap map = cell_map(constants);
    return cell_at(&map, x[0], x[1], x[2]);
}

/* Particles in sequence mostly share a cell: an atomic per run, not per particle. */
static void take_places(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    const uint32_t *cell = cpu->spare_cell;
    for (size_t i = begin, stop; i < end; i = stop) {
        for (stop = i + 1; stop < end && cell[stop] == cell[i];)
            stop++;
        const uint32_t place = cell_fold_of(&cpu->fold, &cpu->constants->cells, cell[i]);
        uint32_t rank =
            __atomic_fetch_add(&cpu->cell_start[place + 1], (uint32_t)(stop - i), __ATOMIC_RELAXED);
        for (size_t k = i; k < stop; k++)
            cpu->rank[k] = rank++;
        for (size_t k = i; cpu->fold.shared && k < stop; k++)
            cpu->cell[k] = place;
    }
}

static void find_cells(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    const CellMap map = cell_map(cpu->constants);
    const CpuParticles *p = &cpu->now;
    for (size_t i = begin; i < end; i++) {
        const bool aside = cpu->boundary_at && p->x[i] == ASIDE; /* in an extra cell that is never read */
        cpu->spare_cell[i] =
            aside ? (uint32_t)cpu->constants->cells.count : cell_at(&map, p->x[i], p->y[i], p->z[i]);
    }
}

static void place_particles(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    const uint32_t *place = cpu->fold.shared ? cpu->cell : cpu->spare_cell;
    for (size_t i = begin; i < end; i++)
        cpu->order[cpu->cell_start[place[i]] + cpu->rank[i]] = (uint32_t)i;
}

/* Insertion sort by id, since a cell holds some ten particles, mostly in order. `cell`: given if cells
   share a place; sorts by cell first, so that each cell's particles are contiguous. */
static inline void sort_place(uint32_t *order, size_t count, const ParticleId *id, const uint32_t *cell)
{
    for (size_t i = 1; i < count; i++) {
        const uint32_t moved = order[i];
        size_t j = i;
        for (; j > 0; j--) {
            const uint32_t before = order[j - 1];
            if (cell && cell[before] != cell[moved] ? cell[before] < cell[moved] : id[before] <= id[moved])
                break;
            order[j] = before;
        }
        order[j] = moved;
    }
}

static void sort_places(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    for (size_t place = begin; place < end; place++) {
        const uint32_t first = cpu->cell_start[place], count = cpu->cell_start[place + 1] - first;
        if (cpu->fold.shared)
            sort_place(cpu->order + first, count, cpu->now.id, cpu->spare_cell);
        else
            sort_place(cpu->order + first, count, cpu->now.id, NULL);
    }
}

static void move_particles(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    for (size_t i = begin; i < end; i++)
        cpu->cell[i] = cpu->spare_cell[cpu->order[i]];
    for (size_t i = begin; cpu->foreign && i < end; i++)
        cpu->ghost[i] = cpu->foreign[cpu->cell[i]];
    columns_copy(&cpu->sorted, &cpu->now, &cpu->spare, cpu->order, begin, end);
}

void cpu_find(Cpu *cpu)
{
    const bool ghosts = cpu->ghost;
    size_t owned = 0, fluid = 0, boundary = 0;
    for (size_t i = 0; i < cpu->count; i++) {
        cpu->fluid_before[i] = (uint32_t)fluid;
        if (cpu->now.fluid[i] >= FLUIDS_MAX) {
            cpu->boundary_at[boundary++] = (uint32_t)i;
            continue;
        }
        cpu->fluid_at[fluid++] = (uint32_t)i;
        if (ghosts && !cpu->ghost[i])
            cpu->owned_at[owned++] = (uint32_t)i;
    }
    cpu->fluid_before[cpu->count] = (uint32_t)fluid;
}

void cpu_cells(Cpu *cpu)
{
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, find_cells, cpu);
}

static void count_cells(Cpu *cpu)
{
    const size_t places = cpu->fold.count;
    memset(cpu->cell_start, 0, (places + 2) * sizeof *cpu->cell_start);
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, take_places, cpu);
    for (size_t place = 0; place <= places; place++)
        cpu->cell_start[place + 1] += cpu->cell_start[place];
}

void cpu_sort(Cpu *cpu)
{
    count_cells(cpu);
    if (cpu->copy_start && !cpu_copies_fit(cpu)) {
        if (cpu_copies_grow(cpu)) {
            cpu_cells(cpu);
            count_cells(cpu);
            cpu_copies_fit(cpu);
        } else {
            cpu_copies_drop(cpu);
        }
    }
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, place_particles, cpu);
    parallel_ranges(cpu->threads, cpu->fold.count, 4 * CPU_GRAIN, sort_places, cpu);
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, move_particles, cpu);

    columns_swap(&cpu->sorted, &cpu->now, &cpu->spare);
    cpu->gridded = cpu->count;
    cpu->lists.ready = false;
    if (cpu->copies > 0)
        cpu_copies_place(cpu);
    if (cpu->owned_at)
        cpu_find(cpu);
}

void cpu_grid(void *state)
{
    cpu_cells(state);
    cpu_sort(state);
}

/* Expected rows of a group whose particles have `neighbours` neighbours on average. */
static double rows_expected(double neighbours)
{
    return 1.2 * neighbours + 8;
}

static bool fit(ListMemory *memory, size_t indices)
{
    if (indices > UINT32_MAX)
        return false;
    uint32_t *index = aligned_alloc(64, (indices * sizeof *index + 63) / 64 * 64);
    if (!index)
        return false;
    if (memory->index)
        memcpy(index, memory->index, memory->room * sizeof *index);
    free(memory->index);
    *memory = (ListMemory){index, (uint32_t)indices};
    return true;
}

bool neighbour_lists_create(NeighbourLists *lists, size_t particles, double neighbours)
{
    lists->ranges = particles / LISTS_GRAIN + 1;
    const size_t groups = particles / LANES + 1;
    lists->of_range = calloc(lists->ranges, sizeof *lists->of_range);
    lists->found = calloc(lists->ranges, sizeof *lists->found);
    lists->of_images = calloc(lists->ranges, sizeof *lists->of_images);
    lists->first = calloc(groups, sizeof *lists->first);
    lists->rows = calloc(groups, sizeof *lists->rows);
    lists->images = calloc(groups, sizeof *lists->images);
    bool ok =
        lists->of_range && lists->found && lists->of_images && lists->first && lists->rows && lists->images;
    for (size_t r = 0; ok && r < lists->ranges; r++) {
        const size_t left = particles - r * LISTS_GRAIN, in_range = left < LISTS_GRAIN ? left : LISTS_GRAIN;
        ok = fit(&lists->of_range[r], (size_t)((double)in_range * rows_expected(neighbours)) + LANES * LANES);
    }
    return ok;
}

static void free_ranges(ListMemory *of_range, size_t ranges)
{
    for (size_t r = 0; of_range && r < ranges; r++)
        free(of_range[r].index);
    free(of_range);
}

void neighbour_lists_destroy(NeighbourLists *lists)
{
    free_ranges(lists->of_range, lists->ranges);
    free_ranges(lists->found, lists->ranges);
    free_ranges(lists->of_images, lists->ranges);
    free(lists->first);
    free(lists->rows);
    free(lists->images);
}

size_t neighbour_lists_bytes(const NeighbourLists *lists)
{
    size_t indices = 3 * lists->ranges * (LISTS_GRAIN / LANES);
    for (size_t r = 0; r < lists->ranges; r++)
        indices += (size_t)lists->of_range[r].room + lists->found[r].room + lists->of_images[r].room;
    return indices * sizeof(uint32_t);
}

bool neighbour_lists_fit(NeighbourLists *lists, ListMemory *memory, size_t indices)
{
    if (indices <= memory->room || fit(memory, indices + indices / 2))
        return true;
    __atomic_store_n(&lists->full, true, __ATOMIC_RELAXED);
    return false;
}

#if defined(__x86_64__)
#include <immintrin.h>
#endif

enum {
    TRIES = 8,
    ROUNDS = 1 << 17,    /* of a loop in registers: half a millisecond */
    PIECES = 8,          /* per thread, so that a delayed thread does not delay all */
    COPY_LEAST = 1 << 16 /* bytes: within the first-level cache of a core */
};

PAIR_LOOPS(multiply_add);

static const size_t copied = (size_t)1 << 27; /* least number of bytes copied per try */

typedef struct Loop {
    PairLoop *run;
    float told[4]; /* filled in by sim/cpu/pairs_shared.c */
} Loop;

static void run_piece(void *context, size_t begin, size_t end)
{
    Loop *loop = context;
    float told[4];
    const PairArgs args = {.fx = told};
    loop->run(&args, 0, (end - begin) * ROUNDS);
    if (begin == 0)
        memcpy(loop->told, told, sizeof told);
}

static FlopCeiling flops_of(int threads, PairLoop *run)
{
    FlopCeiling best = {0};
    const size_t pieces = (size_t)threads * PIECES;
    for (int k = 0; k < TRIES; k++) {
        Loop loop = {.run = run};
        const double began = wall_ms();
        parallel_ranges(threads, pieces, 1, run_piece, &loop);
        const double rate = (double)loop.told[0] * (double)pieces * ROUNDS / (1e-3 * (wall_ms() - began));
        best.bits = (int)loop.told[1];
        best.rate = rate > best.rate ? rate : best.rate;
    }
    return best;
}

#if defined(__x86_64__)
/* The same loop with fused multiply-add, outside of the sets: no pair loop is compiled with fused
   operations. */
#define FUSED(name, needs, Wide, set1, fmadd)                                                                \
    __attribute__((target(needs))) static void name(const PairArgs *args, size_t begin, size_t end)          \
    {                                                                                                        \
        enum { CHAINS = 12 };                                                                                \
        const Wide factor = set1(0.999F), term = set1(0.001F);                                               \
        Wide a[CHAINS];                                                                                      \
        for (int k = 0; k < CHAINS; k++)                                                                     \
            a[k] = set1(0.001F * (float)k);                                                                  \
        for (size_t round = begin; round < end; round++)                                                     \
            for (int k = 0; k < CHAINS; k++)                                                                 \
                a[k] = fmadd(a[k], factor, term);                                                            \
        args->fx[2] = 0;                                                                                     \
        for (int k = 0; k < CHAINS; k++)                                                                     \
            args->fx[2] += a[k][0];                                                                          \
        args->fx[0] = 2.0F * CHAINS * sizeof(Wide) / sizeof(float);                                          \
        args->fx[1] = 8.0F * sizeof(Wide);                                                                   \
    }
FUSED(fused_256, "avx2,fma", __m256, _mm256_set1_ps, _mm256_fmadd_ps)
FUSED(fused_512, "avx512f", __m512, _mm512_set1_ps, _mm512_fmadd_ps)
#undef FUSED
#endif

/* Best fused rate; the rate of the sets if the processor has no fused operations. */
static FlopCeiling fused_of(int threads, FlopCeiling best)
{
    FlopCeiling found[2] = {{0}};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        found[0] = flops_of(threads, fused_256);
    if (__builtin_cpu_supports("avx512f"))
        found[1] = flops_of(threads, fused_512);
#else
    (void)threads;
#endif
    for (int k = 0; k < 2; k++)
        best = found[k].rate > best.rate ? found[k] : best;
    return best;
}

typedef struct Copying {
    char *from, *to;
    size_t part; /* bytes per thread */
    int times;
} Copying;

static void copy_part(void *context, size_t begin, size_t end)
{
    const Copying *copying = context;
    for (int k = 0; k < copying->times; k++) {
        memcpy(copying->to + begin * copying->part, copying->from + begin * copying->part,
               (end - begin) * copying->part);
        __asm__ volatile("" ::: "memory"); /* keeps every repetition */
    }
}

static CopyCeiling copy_of(int threads, size_t bytes, char *from, char *to)
{
    Copying copying = {from, to, bytes / 2 / (size_t)threads / 64 * 64, 1};
    CopyCeiling best = {.bytes = bytes};
    parallel_ranges(threads, (size_t)threads, 1, copy_part, &copying);
    copying.times = bytes < copied ? (int)(copied / bytes) : 1;
    for (int k = 0; k < TRIES; k++) {
        const double began = wall_ms();
        parallel_ranges(threads, (size_t)threads, 1, copy_part, &copying);
        const double moved = 2.0 * (double)copying.part * threads * copying.times,
                     rate = moved / (1e-3 * (wall_ms() - began));
        best.rate = rate > best.rate ? rate : best.rate;
    }
    return best;
}

/* Twice the last cache for both arrays together: copied data has left the cache before the next copy. */
static size_t memory_sized(void)
{
    const long cache = sysconf(_SC_LEVEL3_CACHE_SIZE);
    const size_t least = (size_t)1 << 27, twice = cache > 0 ? 2 * (size_t)cache : 0;
    return twice > least ? twice : least;
}

bool ceilings_measure(int threads, PairSet set, Ceilings *out)
{
    const size_t most = memory_sized();
    char *from = aligned_alloc(4096, most), *to = from ? from + most / 2 / 4096 * 4096 : NULL;
    if (!from)
        return false;
    memset(from, 1, most);
    *out = (Ceilings){0};
    for (size_t bytes = (size_t)threads * COPY_LEAST; bytes < most && out->copies < MICRO_COPIES_MAX - 1;
         bytes *= 4)
        out->copy[out->copies++] = copy_of(threads, bytes, from, to);
    out->copy[out->copies++] = copy_of(threads, most, from, to);
    free(from);
    out->multiply_add = flops_of(threads, multiply_add.in[set]);
    out->fused = fused_of(threads, out->multiply_add);
    return true;
}

/* Sums over a column: per cell in double, then exact over cells. So the bits depend neither on threads nor
   on ranks. */

typedef struct ExcessPass {
    Cpu *cpu;
    const float *column;
    ExactSum *sum;
    float most;
} ExcessPass;

static void add_part(ExcessPass *pass, const ExactSum *sum, float most)
{
    parallel_lock();
    exact_merge(pass->sum, sum);
    pass->most = most > pass->most ? most : pass->most;
    parallel_unlock();
}

static void excess_range(void *context, size_t begin, size_t end)
{
    ExcessPass *pass = context;
    ExactSum sum = {.strange = false};
    float most = 0;
    const size_t last = cpu_cell_first(pass->cpu, end);
    for (size_t k = cpu_cell_first(pass->cpu, begin); k < last;) {
        double of_cell = 0;
        do {
            const float value = pass->column[cpu_owned(pass->cpu, k)];
            of_cell += value < 0 ? 0 : (double)value; /* NaN stays */
            most = value > most ? value : most;
        } while (++k < last && cpu_cell_goes_on(pass->cpu, k));
        exact_add(&sum, of_cell);
    }
    add_part(pass, &sum, most);
}

float cpu_excess_part(Cpu *cpu, const ColumnDef *column, ExactSum *sum)
{
    ExcessPass pass = {cpu, *column_array(&cpu->now, column, 0), sum, 0};
    parallel_ranges(cpu->threads, cpu->owned, 8 * CPU_GRAIN, excess_range, &pass);
    return pass.most;
}

Excess cpu_excess(void *state, const ColumnDef *column)
{
    Cpu *cpu = state;
    ExactSum sum = {.strange = false};
    const float most = cpu_excess_part(cpu, column, &sum);
    return (Excess){.mean = exact_value(&sum) / (cpu->owned > 0 ? (double)cpu->owned : 1), .greatest = most};
}

static void sum_range(void *context, size_t begin, size_t end)
{
    ExcessPass *pass = context;
    ExactSum sum = {.strange = false};
    const size_t last = cpu_cell_first(pass->cpu, end);
    for (size_t k = cpu_cell_first(pass->cpu, begin); k < last;) {
        double of_cell = 0;
        do
            of_cell += (double)pass->column[cpu_owned(pass->cpu, k)];
        while (++k < last && cpu_cell_goes_on(pass->cpu, k));
        exact_add(&sum, of_cell);
    }
    add_part(pass, &sum, 0);
}

void cpu_sum_part(Cpu *cpu, const ColumnDef *column, ExactSum *sum)
{
    ExcessPass pass = {cpu, *column_array(&cpu->now, column, 0), sum, 0};
    parallel_ranges(cpu->threads, cpu->owned, 8 * CPU_GRAIN, sum_range, &pass);
}

double cpu_sum(void *state, const ColumnDef *column)
{
    ExactSum sum = {.strange = false};
    cpu_sum_part(state, column, &sum);
    return exact_value(&sum);
}
