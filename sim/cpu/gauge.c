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
bool cpu_gauge(void *state, const double gravity[3])
{
    Cpu *cpu = state;
    WorldGauge *gauge = &cpu->gauge;
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

typedef struct EnergyPass {
    const Cpu *cpu;
    bool turning;
    EnergySums *partial; /* one a range */
} EnergyPass;

/* In two loops: the sums of the second would not stay in registers over the calls of the first. */
static void energy_range(void *context, size_t begin, size_t end)
{
    const EnergyPass *pass = context;
    const Cpu *cpu = pass->cpu;
    const CpuParticles *p = &cpu->now;
    EnergySums sums = {0};
    for (size_t k = begin; k < end; k++) {
        const size_t i = cpu_owned(cpu, k);
        const float x[3] = {p->x[i], p->y[i], p->z[i]}, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        energy_add(&sums, cpu->constants, p->fluid[i], (double)particle_compression(p, cpu->constants, i), x,
                   v);
    }
    for (size_t k = begin; pass->turning && k < end; k++) {
        const size_t i = cpu_owned(cpu, k);
        const float x[3] = {p->x[i], p->y[i], p->z[i]}, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        energy_add_turning(&sums, cpu->constants, p->fluid[i], x, v);
    }
    pass->partial[begin / CPU_GRAIN] = sums;
}

void cpu_energy(void *state, bool turning, EnergySums *sums)
{
    Cpu *cpu = state;
    _Static_assert(sizeof(EnergySums) <= sizeof(WorldSums), "their memory is shared");
    EnergyPass pass = {cpu, turning, (EnergySums *)(void *)cpu->partial};
    parallel_ranges(cpu->threads, cpu->owned, CPU_GRAIN, energy_range, &pass);
    *sums = (EnergySums){0};
    for (size_t r = 0; r < (cpu->owned + CPU_GRAIN - 1) / CPU_GRAIN; r++) {
        const EnergySums *part = &pass.partial[r];
        sums->own += part->own;
        for (int k = 0; k < 6; k++)
            sums->second[k] += part->second[k];
        for (int k = 0; k < 3; k++) {
            sums->first[k] += part->first[k];
            sums->turn[k] += part->turn[k];
        }
    }
}
