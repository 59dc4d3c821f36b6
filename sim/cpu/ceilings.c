/* The most that the machine can do: products and sums of pair loops, and bytes copied. */
#include "sim/cpu/cpu.h"

#include "sim/base/base.h"
#include "sim/cpu/pairs.h"
#include "sim/world.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

typedef struct FlopRateJob {
    PairLoop *run;
    float result[4]; /* filled in by sim/cpu/pairs_shared.c */
} FlopRateJob;

static void run_piece(void *context, size_t begin, size_t end)
{
    FlopRateJob *loop = context;
    float result[4];
    const PairArgs args = {.fx = result};
    loop->run(&args, 0, (end - begin) * ROUNDS);
    if (begin == 0)
        memcpy(loop->result, result, sizeof result);
}

static FlopCeiling flops_of(int threads, PairLoop *run)
{
    FlopCeiling best = {0};
    const size_t pieces = (size_t)threads * PIECES;
    for (int k = 0; k < TRIES; k++) {
        FlopRateJob loop = {.run = run};
        const double began = wall_ms();
        parallel_ranges(threads, pieces, 1, run_piece, &loop);
        const double rate = (double)loop.result[0] * (double)pieces * ROUNDS / (1e-3 * (wall_ms() - began));
        best.bits = (int)loop.result[1];
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

typedef struct CopyRateJob {
    char *from, *to;
    size_t part; /* bytes per thread */
    int times;
} CopyRateJob;

static void copy_part(void *context, size_t begin, size_t end)
{
    const CopyRateJob *copying = context;
    for (int k = 0; k < copying->times; k++) {
        memcpy(copying->to + begin * copying->part, copying->from + begin * copying->part,
               (end - begin) * copying->part);
        __asm__ volatile("" ::: "memory"); /* keeps every repetition */
    }
}

static CopyCeiling copy_of(int threads, size_t bytes, char *from, char *to)
{
    CopyRateJob copying = {from, to, bytes / 2 / (size_t)threads / 64 * 64, 1};
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
