#include "sim/cpu/pass.h"

#include "sim/box/wall_cushion.h"

#include <string.h>

PAIR_LOOPS(lists);
PAIR_LOOPS(image_lists);
PAIR_LOOPS(tension);

bool cpu_name_among(const char *list, const char *name)
{
    const size_t size = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += size)
        if ((at == list || at[-1] == ' ') && (at[size] == ' ' || at[size] == 0))
            return true;
    return false;
}

typedef struct Running {
    Cpu *cpu;
    const Pass *pass;
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
    const Running *running = context;
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

static void run_loop(Running *running)
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
        Running running = {cpu, pass, loop, input};
        run_loop(&running);
    }
    if (cpu->forces && cpu->boundary_at && pass->cpu->solid && input->dt > 0)
        cpu_feel_solids(cpu, pass->cpu->solid, input->dt);
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

void cpu_cushion(const CpuRange *range)
{
    const Constants *s = range->cpu->constants;
    const Walls *walls = &s->walls;
    const CpuParticles *p = &range->cpu->now;
    const WallsFar far = walls_far(walls, CUSHION_REACH * walls->spacing);
    for (size_t i = range->begin; i < range->end; i++) {
        const float x[3] = {p->x[i], p->y[i], p->z[i]};
        if (!walls_near(&far, x))
            continue;
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
