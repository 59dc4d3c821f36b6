#include "sim/cpu/cpu.h"

#include "sim/box/box.h"
#include "sim/cpu/lanes.h"
#include "sim/cpu/pairs.h"
#include "sim/step/method.h"

#include <stdlib.h>
#include <string.h>

enum { SIMD_AUTO, SIMD_AVX2, SIMD_BASELINE };

const SimdKind simd_kinds[] = {
    [SIMD_AUTO] = {"auto", "the widest that the processor has"},
    [SIMD_AVX2] = {"avx2", "256 bits"},
    [SIMD_BASELINE] = {"baseline", "what every x86-64 has, 128 bits; elsewhere whatever the compiler finds"},
    {0},
};

static bool has_avx2(void)
{
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2");
#else
    return false;
#endif
}

/* The kind named by the environment; -1: unknown name. */
static int wanted_by_environment(void)
{
    const char *wanted = getenv("SLOSH_SIMD");
    int kind = SIMD_AUTO;
    while (wanted && simd_kinds[kind].name && strcmp(wanted, simd_kinds[kind].name) != 0)
        kind++;
    return simd_kinds[kind].name ? kind : -1;
}

bool pair_set_choose(int simd, PairSet *set, Error *error)
{
    int kind = simd == SIMD_AUTO ? wanted_by_environment() : simd;
    if (kind < 0)
        return error_set(error, "SLOSH_SIMD is '%.40s'; auto, avx2 and baseline are there",
                         getenv("SLOSH_SIMD"));
    if (simd == SIMD_AVX2 && !has_avx2())
        return error_set(error, "this processor has no %s; leave solver.simd at auto", simd_kinds[simd].name);
    if (kind == SIMD_AUTO || !has_avx2())
        kind = has_avx2() ? SIMD_AVX2 : SIMD_BASELINE;
    *set = kind == SIMD_AVX2 ? PAIR_AVX2 : PAIR_BASELINE;
    return true;
}

const char *pair_set_name(PairSet set)
{
    return simd_kinds[set == PAIR_AVX2 ? SIMD_AVX2 : SIMD_BASELINE].name;
}

PAIR_LOOPS(lists);
PAIR_LOOPS(image_lists);
PAIR_LOOPS(tension);

typedef struct PassJob {
    Cpu *cpu;
    const Pass *pass;
    const CpuLoop *loop;
    const PassInput *input;
} PassJob;

static void run_range(void *context, size_t begin, size_t end)
{
    const PassJob *running = context;
    Cpu *cpu = running->cpu;
    PairArgs args = cpu_pair_args(cpu);
    args.gravity = running->input->apparent;
    CpuRange range = {cpu, &args, running->input, begin, end};
    if (running->loop->walks && !cpu->lists.ready) {
        cpu_pairs(&range, &lists);
        if (cpu->constants->method->keeps_images)
            cpu_pairs(&range, &image_lists);
    }
    if (running->loop->solids)
        running->loop->body(&range);
    else
        for (range.begin = begin; cpu_run(cpu, &range.begin, end, &range.end); range.begin = range.end)
            running->loop->body(&range);
}

static void pack(void *context, size_t begin, size_t end)
{
    const PassJob *running = context;
    Cpu *cpu = running->cpu;
    const CpuParticles *p = &cpu->now;
    if (running->loop->pack) {
        running->loop->pack(&(CpuRange){cpu, NULL, running->input, begin, end});
        return;
    }
    for (size_t i = begin; i < end; i++) {
        memcpy(cpu->place[i], (float[]){p->x[i], p->y[i], p->z[i], p->pressure_term[i]}, 16);
        memcpy(cpu->motion[i], (float[]){p->vx[i], p->vy[i], p->vz[i], p->volume[i]}, 16);
    }
}

static void run_loop(PassJob *running)
{
    Cpu *cpu = running->cpu;
    const bool walks = running->loop->walks;
    if (walks) {
        const size_t none = cpu->count + cpu->copies;
        if (!running->loop->packed)
            parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, pack, running);
        if (cpu->copies > 0) {
            cpu_copies_update(cpu, running->pass);
            cpu_copies_pack(cpu);
        }
        columns_clear(&cpu->all, &cpu->now, none); /* dummy particle that fills up lists */
        memcpy(cpu->place[none], (float[]){PAST, PAST, PAST, 0}, 16);
        memset(cpu->motion[none], 0, 16);
        if (!cpu->lists.ready)
            cpu->lists.full = false;
    }
    parallel_ranges(cpu->threads, cpu->count, walks ? CPU_GRAIN : 4 * CPU_GRAIN, run_range, running);
    cpu->lists.ready |= walks;
    cpu->watch.memory |= cpu->lists.full;
}

void cpu_run_pass(void *state, const Pass *pass, const PassInput *input)
{
    Cpu *cpu = state;
    const bool mirrors = pass->mirrors && cpu->boundary_at;
    if (mirrors)
        cpu_boundary_fill(cpu, input->apparent);
    for (const CpuLoop *loop = pass->cpu->loops; loop->body; loop++) {
        PassJob running = {cpu, pass, loop, input};
        run_loop(&running);
    }
    if (pass->cpu->end)
        pass->cpu->end(cpu, input);
    if (cpu->forces && cpu->boundary_at && pass->cpu->solid && input->dt > 0)
        cpu_add_solid_forces(cpu, pass->cpu->solid, input->dt);
    if (mirrors)
        cpu_boundary_restore(cpu);
}

void cpu_force_end(const CpuRange *range)
{
    const Cpu *cpu = range->cpu;
    const CpuParticles *p = &cpu->now;
    if (p->tension && cpu->constants->tension_model != TENSION_CURVATURE) /* the method has its own */
        cpu_pairs(range, &tension);
    for (size_t i = range->begin; i < range->end; i++) {
        const float inverse_mass = 1 / cpu->constants->mass[p->fluid[i]];
        p->ax[i] *= inverse_mass;
        p->ay[i] *= inverse_mass;
        p->az[i] *= inverse_mass;
    }
}

/* The first particle from i on near a wall, or `end`. */
static inline size_t next_near(const WallsFar *far, const CpuParticles *p, size_t i, size_t end)
{
    for (; i < end; i += FOUR) {
        const i4 near = four_near_walls(far, f4_load(p->x, i), f4_load(p->y, i), f4_load(p->z, i));
        const unsigned bits = i4_bits(near & four_before(i, end));
        if (bits != 0)
            return i + (size_t)__builtin_ctz(bits);
    }
    return end;
}

void cpu_cushion(const CpuRange *range)
{
    const Constants *s = range->cpu->constants;
    const Walls *walls = &s->walls;
    const CpuParticles *p = &range->cpu->now;
    const WallsFar far = walls_far(walls, CUSHION_REACH * walls->spacing);
    const size_t end = range->end;
    for (size_t i = range->begin; (i = next_near(&far, p, i, end)) < end; i++) {
        const float x[3] = {p->x[i], p->y[i], p->z[i]};
        const float v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        float g[3], a[3] = {0};
        apparent_gravity_at(range->input->apparent, x, g);
        walls_cushion(walls, range->input->dt, g, x, v, a);
        const float share = cushion_share(p->pressure[i], s->density[p->fluid[i]] * s->spacing, g);
        p->ax[i] += share * a[0];
        p->ay[i] += share * a[1];
        p->az[i] += share * a[2];
    }
}

void cpu_wall_lift(const CpuRange *range, float from)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    const WallsFar far = walls_far(&s->walls, s->support_radius);
    const size_t end = range->end;
    for (size_t i = range->begin; (i = next_near(&far, p, i, end)) < end; i++) {
        const float x[3] = {p->x[i], p->y[i], p->z[i]};
        float g[3], lift[3];
        apparent_gravity_at(range->input->apparent, x, g);
        const float layer =
            s->density[p->fluid[i]] * s->spacing * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
        const float fade = layer > 0 ? fminf(fmaxf(p->pressure[i] / layer - from, 0), 1) : 0;
        walls_lift(&s->lift, &s->walls, x, lift);
        p->ax[i] -= fade * lift[0] * g[0];
        p->ay[i] -= fade * lift[1] * g[1];
        p->az[i] -= fade * lift[2] * g[2];
    }
}

/* Data of the backend for `slosh bench --micro`: see sim/step/method.h. */

static void nothing(const CpuRange *range)
{
    (void)range;
}

/* An empty walk: its time is the time to make the lists. */
static PairCost lists_pair(const Constants *constants)
{
    (void)constants;
    return (PairCost){.flops = 8}; /* distance of each neighbour found; rejected candidates are not counted */
}

static const CpuPass lists_pass = {.loops = {{nothing, .walks = true}}, .pair = lists_pair};

static const Pass neighbours = {
    .name = "lists", .stage = STAGE_DENSITY, .cpu = &lists_pass, .reads = "position", .writes = ""};

/* Bytes per particle: each sorted column is read and written once, as are cell, rank and order. */
static double grid_stream(const void *state)
{
    const Cpu *cpu = state;
    double sum = 2 * 3 * sizeof(uint32_t);
    for (int k = 0; k < cpu->sorted.count; k++)
        sum += 2.0 * cpu->sorted.row[k]->components * (double)column_size(cpu->sorted.row[k]);
    return sum;
}

static bool pair(const Pass *pass, const Constants *constants, PairCost *cost)
{
    if (!pass->cpu->pair)
        return false;
    *cost = pass->cpu->pair(constants);
    return true;
}

static bool ceilings(const void *state, Ceilings *out)
{
    const Cpu *cpu = state;
    return ceilings_measure(cpu->threads, cpu->pairs, out);
}

const BackendMicro cpu_micro = {
    .neighbours = &neighbours,
    .stream_a_pair = sizeof(uint32_t),
    .grid_stream = grid_stream,
    .pair = pair,
    .ceilings = ceilings,
};
