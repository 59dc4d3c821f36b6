/* Data of the backend for `slosh bench --micro`: see sim/world/micro.h. */
#include "sim/world/micro.h"

#include "sim/cpu/ceilings.h"
#include "sim/cpu/pass.h"

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

static const CpuPass lists = {.loops = {{nothing, .walks = true}}, .pair = lists_pair};

static const Pass neighbours = {
    .name = "lists", .stage = STAGE_DENSITY, .cpu = &lists, .reads = "position", .writes = ""};

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
