/* What is plotted of the state, where it is asked for. */
#include "sim/world/gauge.h"
#include "sim/cpu/cpu.h"

typedef struct GaugePass {
    const Cpu *cpu;
    const double *gravity;
    WorldGauge *partial; /* one a range */
} GaugePass;

static void gauge_range(void *context, size_t begin, size_t end)
{
    const GaugePass *pass = context;
    const Cpu *cpu = pass->cpu;
    const CpuParticles *p = &cpu->now;
    WorldGauge *gauge = &pass->partial[begin / CPU_GRAIN];
    *gauge = (WorldGauge){0};
    for (size_t k = begin; k < end; k++) {
        const size_t i = cpu_owned(cpu, k);
        const float x[3] = {p->x[i], p->y[i], p->z[i]}, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        gauge_add(gauge, cpu->constants, pass->gravity, p->fluid[i],
                  (double)particle_compression(p, cpu->constants, i), x, v);
    }
}

/* Sums in an order that does not depend on the number of threads, in the same memory as `sums`. */
void cpu_energy(void *state, const double gravity[3], WorldGauge *gauge)
{
    Cpu *cpu = state;
    _Static_assert(sizeof(WorldGauge) <= sizeof(WorldSums), "their memory is shared");
    GaugePass pass = {cpu, gravity, (WorldGauge *)(void *)cpu->partial};
    parallel_ranges(cpu->threads, cpu->owned, CPU_GRAIN, gauge_range, &pass);
    *gauge = (WorldGauge){0};
    for (size_t r = 0; r < (cpu->owned + CPU_GRAIN - 1) / CPU_GRAIN; r++) {
        const WorldGauge *part = &pass.partial[r];
        gauge->density_error_mean += part->density_error_mean;
        gauge->density_error_max = fmax(gauge->density_error_max, part->density_error_max);
        gauge->kinetic_energy += part->kinetic_energy;
        gauge->potential_energy += part->potential_energy;
        gauge->compression_energy += part->compression_energy;
    }
    gauge->density_error_mean /= cpu->owned > 0 ? (double)cpu->owned : 1;
}

bool cpu_gauge(void *state, const double gravity[3])
{
    Cpu *cpu = state;
    cpu_energy(cpu, gravity, &cpu->gauge);
    return true;
}

bool cpu_gauged(void *state, WorldGauge *gauge)
{
    const Cpu *cpu = state;
    const double time = gauge->time;
    *gauge = cpu->gauge;
    gauge->time = time;
    return true;
}
