/* Shifting of particles: down the gradient of their number density, so that a flow does not line them up.

   After: S. J. Lind, R. Xu, P. K. Stansby, B. D. Rogers, "Incompressible smoothed particle hydrodynamics for
   free-surface flows", 2012, eq. 22 to 25; P. N. Sun, A. Colagrossi, S. Marrone, A. M. Zhang, "The
   delta-plus-SPH model", 2017. */
#include "sim/cpu/cpu.h"

#include <math.h>

/* 0 where less than 0.8 of the space around is full, at a surface; 1 from 0.95 on. */
static float share_of(float full)
{
    return fminf(fmaxf((full - 0.8f) / 0.15f, 0), 1);
}

void cpu_shift_share(Cpu *cpu, size_t i)
{
    const Constants *s = cpu->constants;
    const float share = share_of(cpu->full[i] / ((float)s->dimensions * s->rest_number_density));
    for (int k = 0; k < 3; k++)
        cpu->uneven[k][i] *= share;
    cpu->dense[i] = cpu->dense[i] / s->rest_number_density - 1;
    cpu->full[i] = share;
}

typedef struct Shift {
    Cpu *cpu;
    float dt;
} Shift;

/* By chi c (h / 2) dt V0 sum F x_ij. */
static void shift_range(void *context, size_t begin, size_t end)
{
    const Shift *pass = context;
    const Cpu *cpu = pass->cpu;
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    float *const x[3] = {p->x, p->y, p->z};
    const float most = 0.1f * s->spacing, scale = s->shifting * pass->dt / s->rest_number_density;
    const float part = fminf(pass->dt * s->sound_speed / (SHIFT_RETURN * s->support_radius), 1);
    for (size_t i = begin, stop; cpu_run(cpu, &i, end, &stop);)
        for (; i < stop; i++) {
            for (int k = 0; k < 3; k++)
                x[k][i] += fminf(fmaxf(scale * cpu->uneven[k][i], -most), most);
            p->compression[i] += part * cpu->full[i] * (cpu->dense[i] - p->compression[i]);
        }
}

void cpu_shift(void *state, float dt)
{
    Cpu *cpu = state;
    Shift pass = {cpu, dt};
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, shift_range, &pass);
}
