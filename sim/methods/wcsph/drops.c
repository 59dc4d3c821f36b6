/* Surface tension by curvature keeps momentum. On a body of connected fluid the sum of its forces is zero
   along each axis without a wall next to the body, so the mean is taken off each particle. Bodies are found
   by union of neighbours of a fluid, after J. Jaiganesh and M. Burtscher, "A high-performance connected
   components implementation for GPUs", 2018. Roots are the least index of a body and sums are integers: no
   bit depends on threads. */
#include "shaders/sim/wcsph/drops_block.h"
#include "sim/box/box.h"
#include "sim/methods/wcsph/wcsph_private.h"

#include <math.h>

/* Columns as integers; `sum` and `tally` of roots alone. */
typedef struct Drops {
    ParticleId *label, *sum[3], *tally;
} Drops;

static Drops drops_of(const Cpu *cpu)
{
    float *const *own = cpu->now.own;
    Drops drops = {.label = (ParticleId *)(void *)own[DROP], .tally = (ParticleId *)(void *)own[DROP_TALLY]};
    for (int k = 0; k < 3; k++)
        drops.sum[k] = (ParticleId *)(void *)own[DROP_SUM + k];
    return drops;
}

static void begin_body(const CpuRange *range)
{
    const Drops drops = drops_of(range->cpu);
    for (size_t i = range->begin; i < range->end; i++) {
        drops.label[i] = i;
        drops.tally[i] = 0;
        for (int k = 0; k < 3; k++)
            drops.sum[k][i] = 0;
    }
}

/* The root of i; halves the way there. */
static size_t root_of(ParticleId *label, size_t i)
{
    for (;;) {
        const size_t next = __atomic_load_n(&label[i], __ATOMIC_RELAXED);
        if (next == i)
            return i;
        const size_t after = __atomic_load_n(&label[next], __ATOMIC_RELAXED);
        if (after != next)
            __atomic_store_n(&label[i], after, __ATOMIC_RELAXED);
        i = next;
    }
}

/* The root of i once all bodies are joined; changes no label. */
static size_t root_at(const ParticleId *label, size_t i)
{
    while (label[i] != i)
        i = label[i];
    return i;
}

/* Joins the bodies of roots that may have changed meanwhile; returns the root. */
static size_t join(ParticleId *label, size_t a, size_t b)
{
    for (;;) {
        a = root_of(label, a);
        b = root_of(label, b);
        const size_t low = a < b ? a : b, high = a < b ? b : a;
        ParticleId seen = high;
        if (low == high ||
            __atomic_compare_exchange_n(&label[high], &seen, low, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
            return low;
    }
}

/* Joins i with the first `most` particles of its list. */
static void join_listed(const Cpu *cpu, ParticleId *label, size_t i, size_t most)
{
    const NeighbourLists *lists = &cpu->lists;
    const size_t rows = lists->rows[i / LANES] & ~(uint32_t)LISTS_FLAGS;
    const uint32_t none = list_entry(cpu->count + cpu->copies),
                   *list = lists->of_range[i / LISTS_GRAIN].index + lists->first[i / LANES] + i % LANES,
                   *end = list + LANES * (rows < most ? rows : most);
    size_t root = root_of(label, i);
    for (; list < end && *list < none; list += LANES) {
        const size_t at = list_particle(*list), j = at < cpu->count ? at : cpu->copy_of[at];
        if (__atomic_load_n(&label[j], __ATOMIC_RELAXED) != root && cpu->now.fluid[j] == cpu->now.fluid[i] &&
            cpu_owns(cpu, j))
            root = join(label, root, j);
    }
}

/* Two neighbours each join most of a large body. After Sutton, Ben-Nun and Barak, "Optimizing parallel graph
   connectivity computation via subgraph sampling", 2018. */
void wcsph_join_few(const CpuRange *range)
{
    ParticleId *label = drops_of(range->cpu).label;
    for (size_t i = range->begin; i < range->end; i++)
        join_listed(range->cpu, label, i, 2);
}

/* Of one body, most likely the largest, no particle need walk its list: lists of others name the particle
   too. Not so across a periodic side, where the distances of a pair may differ by rounding. */
void wcsph_join(const CpuRange *range)
{
    const Cpu *cpu = range->cpu;
    ParticleId *label = drops_of(cpu).label;
    const size_t large = cpu->copies > 0 ? SIZE_MAX : root_of(label, cpu_owned(cpu, cpu->owned / 2));
    for (size_t i = range->begin; i < range->end; i++)
        if (root_of(label, i) != large)
            join_listed(cpu, label, i, SIZE_MAX);
}

/* Bits of the axes with a wall within the support of i. */
static ParticleId walls_at(const Cpu *cpu, const WallsFar *far, size_t i)
{
    const float x[3] = {cpu->now.x[i], cpu->now.y[i], cpu->now.z[i]};
    ParticleId bits = 0;
    for (int k = 0; k < 3; k++)
        bits |= (ParticleId)((x[k] < far->low[k]) | (x[k] > far->high[k])) << k;
    return bits;
}

static float sum_scale(const Constants *s, int fluid)
{
    const float most = s->tension[fluid] * s->curvature.most;
    return most > 0 ? DROP_STEPS / most : 0;
}

static ParticleId steps_of(float force, float scale)
{
    return (ParticleId)(int64_t)rintf(fminf(fmaxf(force * scale, -DROP_MOST), DROP_MOST));
}

typedef struct DropPart {
    ParticleId sum[3], count, walls;
} DropPart;

static void add_part(const Drops *drops, size_t root, const DropPart *part)
{
    for (int k = 0; k < 3; k++)
        if (part->sum[k] != 0)
            __atomic_fetch_add(&drops->sum[k][root], part->sum[k], __ATOMIC_RELAXED);
    __atomic_fetch_add(&drops->tally[root], DROP_ONE * part->count, __ATOMIC_RELAXED);
    __atomic_fetch_or(&drops->tally[root], part->walls, __ATOMIC_RELAXED);
}

static void sum_body(const CpuRange *range)
{
    const Cpu *cpu = range->cpu;
    const Drops drops = drops_of(cpu);
    const WallsFar far = walls_far(&cpu->constants->walls, cpu->constants->support_radius);
    for (size_t i = range->begin; i < range->end;) {
        const size_t root = root_at(drops.label, i);
        const float scale = sum_scale(cpu->constants, cpu->now.fluid[i]);
        DropPart part = {0};
        for (; i < range->end && root_at(drops.label, i) == root; i++) {
            for (int k = 0; k < 3; k++)
                part.sum[k] += steps_of(cpu->now.own[PULL + k][i], scale);
            part.count++;
            part.walls |= walls_at(cpu, &far, i);
        }
        add_part(&drops, root, &part);
    }
}

static void end_body(const CpuRange *range)
{
    const Cpu *cpu = range->cpu;
    const Constants *s = cpu->constants;
    const Drops drops = drops_of(cpu);
    float *const a[3] = {cpu->now.ax, cpu->now.ay, cpu->now.az};
    if (cpu->foreign) /* bodies go over the ranks */
        return;
    for (size_t i = range->begin; i < range->end; i++) {
        const size_t root = root_at(drops.label, i);
        const int fluid = cpu->now.fluid[i];
        const ParticleId particles = drops.tally[root] / DROP_ONE;
        const float scale = sum_scale(s, fluid) * s->mass[fluid] * (float)particles;
        for (int k = 0; k < 3; k++)
            if (scale > 0 && !(drops.tally[root] >> k & 1))
                a[k][i] -= (float)(int64_t)drops.sum[k][root] / scale;
    }
}

static const CpuPass begin = {.loops = {{begin_body}}}, end = {.loops = {{sum_body}, {end_body}}};

const Pass wcsph_drops = {
    .name = "drops",
    .stage = STAGE_FORCE,
    .cpu = &begin,
    .shader = "wcsph/drops",
    .reads = "",
    .writes = "drop drop_sum drop_tally",
    .needed = wcsph_curves,
};

const Pass wcsph_balance = {
    .name = "balance",
    .stage = STAGE_FORCE,
    .cpu = &end,
    .shader = "wcsph/balance",
    .reads = "position fluid pull drop drop_sum drop_tally",
    .writes = "acceleration drop_sum drop_tally",
    .needed = wcsph_curves,
};
