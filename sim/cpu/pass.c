#include "sim/cpu/pass.h"

PAIR_LOOPS(tension);

typedef struct Running {
    Cpu *cpu;
    const CpuLoop *loop;
    const PassInput *input;
} Running;

static void run_range(void *context, size_t begin, size_t end)
{
    const Running *running = context;
    Cpu *cpu = running->cpu;
    PairArgs args = cpu_pair_args(cpu);
    args.gravity = running->input->apparent;
    CpuRange range = {cpu, &args, running->input, begin, end};
    if (running->loop->solids)
        running->loop->body(&range);
    else
        for (range.begin = begin; cpu_run(cpu, &range.begin, end, &range.end); range.begin = range.end)
            running->loop->body(&range);
}

void cpu_run_pass(void *state, const Pass *pass, const PassInput *input)
{
    Cpu *cpu = state;
    const bool mirrors = pass->mirrors && cpu->boundary_at;
    if (mirrors)
        cpu_boundary_fill(cpu, input->apparent);
    for (const CpuLoop *loop = pass->cpu->loops; loop->body; loop++) {
        Running running = {cpu, loop, input};
        parallel_ranges(cpu->threads, cpu->count, loop->grain, run_range, &running);
    }
    if (mirrors)
        cpu_boundary_restore(cpu);
}

void cpu_force_end(const CpuRange *range)
{
    const Cpu *cpu = range->cpu;
    const CpuParticles *p = &cpu->now;
    if (p->tension)
        cpu_pairs(range, &tension);
    for (size_t i = range->begin; i < range->end; i++) {
        const float inverse_mass = 1 / cpu->constants->mass[p->fluid[i]];
        p->ax[i] *= inverse_mass;
        p->ay[i] *= inverse_mass;
        p->az[i] *= inverse_mass;
    }
}
