/* wcsph: the density that particles carry, and what follows from it. */
#include "sim/cpu/cpu.h"

/* p = B ((rho / rho0)^7 - 1), Monaghan 1994, of e = rho / rho0 - 1: its powers, without the difference. */
static float tait(float b, float e)
{
    return b * e * (7 + e * (21 + e * (35 + e * (35 + e * (21 + e * (7 + e))))));
}

/* Pressure, and V = V0 rho0 / rho. */
static void state_range(void *context, size_t begin, size_t end)
{
    Cpu *cpu = context;
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    for (size_t i = begin; i < end; i++) {
        const int fluid = p->fluid[i];
        if (fluid >= FLUIDS_MAX) {
            cpu_boundary_terms(cpu, i);
            continue;
        }
        const float e = p->compression[i], pressure = tait(s->tait[fluid], e);
        cpu->volume[i] = 1 / ((1 + e) * s->rest_number_density);
        cpu->pressure[i] = s->negative_pressure || pressure > 0 ? pressure : 0;
        cpu->pressure_term[i] = cpu->pressure[i] * cpu->volume[i] * cpu->volume[i];
        if (cpu->relative) /* a copy: neighbours read it while `continuity` changes theirs */
            cpu->relative[i] = e;
        cpu_fill_terms(cpu, i);
    }
}

void cpu_equation_of_state(Cpu *cpu)
{
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, state_range, cpu);
}

typedef struct Continuity {
    Cpu *cpu;
    float dt;
} Continuity;

static void continuity_range(void *context, size_t begin, size_t end)
{
    const Continuity *pass = context;
    Cpu *cpu = pass->cpu;
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const PairArgs args = cpu_pair_args(cpu);
    for (size_t i = begin, stop; cpu_run(cpu, &i, end, &stop);) {
        cpu->pairs->wcsph_rate(&args, i, stop);
        cpu->pairs->images_rate(&args, i, stop);
        for (; i < stop; i++)
            p->compression[i] += args.rate[i] / s->rest_number_density * pass->dt;
    }
}

static void slope_range(void *context, size_t begin, size_t end)
{
    Cpu *cpu = context;
    const PairArgs args = cpu_pair_args(cpu);
    for (size_t i = begin, stop; cpu_run(cpu, &i, end, &stop); i = stop)
        cpu->pairs->wcsph_slope(&args, i, stop);
}

/* What diffusion needs: densities in the order of the last sort, and once a step, for both of its halves,
   their gradients, which change little meanwhile. */
static void prepare_diffusion(Cpu *cpu)
{
    cpu_equation_of_state(cpu);
    if (cpu->slopes_due)
        parallel_ranges(cpu->threads, cpu->count, CPU_GRAIN, slope_range, cpu);
    cpu->slopes_due = false;
}

void cpu_continuity(void *state, float dt)
{
    Cpu *cpu = state;
    Continuity pass = {cpu, dt};
    if (cpu->relative)
        prepare_diffusion(cpu);
    parallel_ranges(cpu->threads, cpu->count, CPU_GRAIN, continuity_range, &pass);
    cpu_equation_of_state(cpu);
}
