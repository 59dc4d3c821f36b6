/* Density, pressure and forces: the pair sums, then what the walls add. */
#include "sim/cpu/cpu.h"

#include <math.h>

/* p = c^2 (rho - rho0), Müller 2003, eq. 12, with rho as cpu_read gives it; the sum of the pairs stands in
   `volume`. */
static void finish_density(Cpu *cpu, size_t i)
{
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const float x[3] = {p->x[i], p->y[i], p->z[i]};
    const float n = cpu->volume[i] + walls_number_density(&s->walls, x);
    const float pressure = s->stiffness[p->fluid[i]] * (n / s->rest_number_density - 1);

    cpu->volume[i] = 1 / n;
    cpu->pressure[i] = s->negative_pressure ? pressure : fmaxf(pressure, 0);
    cpu->pressure_term[i] = cpu->pressure[i] * cpu->volume[i] * cpu->volume[i];
    cpu_fill_terms(cpu, i);
}

static void density_range(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    const PairArgs args = cpu_pair_args(cpu);
    for (size_t i = begin, stop; cpu_run(cpu, &i, end, &stop);) {
        cpu->pairs->density(&args, i, stop);
        for (; i < stop; i++)
            finish_density(cpu, i);
    }
}

void cpu_density(void *state)
{
    Cpu *cpu = state;
    if (cpu->constants->continuity)
        cpu_equation_of_state(cpu);
    else
        parallel_ranges(cpu->threads, cpu->count, CPU_GRAIN, density_range, cpu);
}

typedef struct ForcePass {
    Cpu *cpu;
    const ApparentGravity *gravity;
} ForcePass;

/* The force of the walls on particle i: p_i V_i^2 s - V_i V0 rho0 m g with the sums of sim/box/wall.h. The
   hydrostatic part fades out below the pressure of one layer, so that a drop on a wall falls freely, and must
   not turn a push into a pull; fluid under tension pulls by itself. */
static void wall_force(const Cpu *cpu, size_t i, const float g[3], const WallSums *sums, float out[3])
{
    const Constants *s = cpu->constants;
    const float *m = sums->moment, density = s->density[cpu->now.fluid[i]];
    const float layer = density * s->spacing * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    const float fade = layer > 0 ? fminf(fmaxf(cpu->pressure[i] / layer, 0), 1) : 0;
    const float weight = fade * density * cpu->volume[i] / s->rest_number_density;
    const float moment_g[3] = {m[0] * g[0] + m[3] * g[1] + m[5] * g[2],
                               m[3] * g[0] + m[1] * g[1] + m[4] * g[2],
                               m[5] * g[0] + m[4] * g[1] + m[2] * g[2]};
    for (int k = 0; k < 3; k++) {
        const float push = cpu->pressure_term[i] * sums->push[k];
        const float hydrostatic = -weight * moment_g[k];
        const bool pulls = cpu->pressure[i] >= 0 && sums->push[k] * (push + hydrostatic) < 0;
        out[k] = pulls ? 0 : push + hydrostatic;
    }
}

static void add_walls(const ForcePass *pass, size_t i)
{
    Cpu *cpu = pass->cpu;
    const CpuParticles *p = &cpu->now;
    const float x[3] = {p->x[i], p->y[i], p->z[i]};
    WallSums sums;
    if (!walls_at(&cpu->constants->walls, x, &sums))
        return;
    float g[3], force[3];
    apparent_gravity_at(pass->gravity, x, g);
    wall_force(cpu, i, g, &sums, force);
    cpu->ax[i] += force[0];
    cpu->ay[i] += force[1];
    cpu->az[i] += force[2];
}

/* Pairs, and walls: of mueller the tables', of wcsph the images in them. */
static void force_run(const ForcePass *pass, const PairArgs *args, size_t begin, size_t end)
{
    const Cpu *cpu = pass->cpu;
    if (cpu->constants->continuity) {
        cpu->pairs->wcsph_force(args, begin, end);
        cpu->pairs->images_force(args, begin, end);
    } else {
        cpu->pairs->force(args, begin, end);
        for (size_t i = begin; i < end; i++)
            add_walls(pass, i);
    }
    if (cpu->tension)
        cpu->pairs->tension(args, begin, end);
}

static void force_range(void *context, size_t begin, size_t end)
{
    const ForcePass *pass = context;
    Cpu *cpu = pass->cpu;
    const Constants *s = cpu->constants;
    PairArgs args = cpu_pair_args(cpu);
    args.gravity = pass->gravity;
    for (size_t i = begin, stop; cpu_run(cpu, &i, end, &stop);) {
        force_run(pass, &args, i, stop);
        for (; i < stop; i++) {
            const float inverse_mass = 1 / s->mass[cpu->now.fluid[i]];
            if (cpu->full)
                cpu_shift_share(cpu, i);
            cpu->ax[i] *= inverse_mass;
            cpu->ay[i] *= inverse_mass;
            cpu->az[i] *= inverse_mass;
        }
    }
}

void cpu_force(void *state, const ApparentGravity *gravity)
{
    Cpu *cpu = state;
    ForcePass pass = {cpu, gravity};
    if (cpu->boundary_at)
        cpu_boundary_fill(cpu, gravity);
    parallel_ranges(cpu->threads, cpu->count, CPU_GRAIN, force_range, &pass);
    if (cpu->boundary_at)
        cpu_boundary_restore(cpu);
}
