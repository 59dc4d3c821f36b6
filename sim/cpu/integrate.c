#include "sim/cpu/cpu.h"

#include <math.h>

typedef struct Drift {
    Cpu *cpu;
    const FrameStep *step;
} Drift;

static void drift_range(void *context, size_t begin, size_t end)
{
    const Drift *drift = context;
    const CpuParticles *p = &drift->cpu->now;
    size_t held = 0;
    for (size_t i = begin; i < end; i++) {
        float x[3] = {p->x[i], p->y[i], p->z[i]}, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        frame_advance(drift->step, x, v);
        held += walls_guard(&drift->cpu->solver->walls, x, v);
        p->x[i] = x[0];
        p->y[i] = x[1];
        p->z[i] = x[2];
        p->vx[i] = v[0];
        p->vy[i] = v[1];
        p->vz[i] = v[2];
    }
    if (held)
        __atomic_fetch_add(&drift->cpu->guarded, held, __ATOMIC_RELAXED);
}

void cpu_drift(void *state, const FrameStep *step)
{
    Cpu *cpu = state;
    Drift drift = {cpu, step};
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, drift_range, &drift);
}

typedef struct Kick {
    Cpu *cpu;
    const float *gravity;
    float dt;
} Kick;

static void kick_range(void *context, size_t begin, size_t end)
{
    const Kick *kick = context;
    const Cpu *cpu = kick->cpu;
    const CpuParticles *p = &cpu->now;
    const float fastest = cpu->solver->support_radius / kick->dt;
    bool bounded = true; /* false for NaN as well */
    for (size_t i = begin; i < end; i++) {
        const float vx = p->vx[i] + (cpu->ax[i] + kick->gravity[0]) * kick->dt;
        const float vy = p->vy[i] + (cpu->ay[i] + kick->gravity[1]) * kick->dt;
        const float vz = p->vz[i] + (cpu->az[i] + kick->gravity[2]) * kick->dt;
        p->vx[i] = vx;
        p->vy[i] = vy;
        p->vz[i] = vz;
        bounded &= vx * vx + vy * vy + vz * vz <= fastest * fastest;
    }
    if (!bounded)
        __atomic_store_n(&kick->cpu->unbounded, true, __ATOMIC_RELAXED);
}

bool cpu_kick(void *state, const float gravity[3], float dt)
{
    Cpu *cpu = state;
    Kick kick = {cpu, gravity, dt};
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, kick_range, &kick);
    return !cpu->unbounded;
}
