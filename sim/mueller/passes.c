/* Density, pressure and forces: the pair sums, then what the walls add. */
#include "sim/mueller/passes.h"

#include <math.h>

PAIR_LOOPS(mueller_density);
PAIR_LOOPS(mueller_force);

/* The sum of the pairs stands in `volume`. */
static void finish_density(Cpu *cpu, const WallsFar *far, size_t i)
{
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const float x[3] = {p->x[i], p->y[i], p->z[i]};
    const float n = p->volume[i] + (walls_near(far, x) ? walls_number_density(&s->walls, x) : 0);
    const float pressure = mueller_state(s, p->fluid[i], n / s->rest_number_density - 1);

    p->volume[i] = 1 / n;
    p->pressure[i] = s->negative_pressure || pressure > 0 ? pressure : 0;
    p->pressure_term[i] = p->pressure[i] * p->volume[i] * p->volume[i];
    cpu_fill_terms(cpu, i);
}

static WallsFar walls_far_of(const CpuRange *range)
{
    const Walls *walls = &range->cpu->constants->walls;
    return walls_far(walls, walls->range);
}

static void density_body(const CpuRange *range)
{
    const WallsFar far = walls_far_of(range);
    cpu_pairs(range, &mueller_density);
    for (size_t i = range->begin; i < range->end; i++)
        finish_density(range->cpu, &far, i);
}

/* The force of the walls on particle i: p_i V_i^2 s - V_i V0 rho0 m g with the sums of sim/box/wall.h. The
   hydrostatic part fades out below the pressure of one layer, so that a drop on a wall falls freely, and must
   not turn a push into a pull; fluid under tension pulls by itself. */
static void wall_force(const Cpu *cpu, size_t i, const float g[3], const WallSums *sums, float out[3])
{
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const float *m = sums->moment, density = s->density[p->fluid[i]];
    const float layer = density * s->spacing * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    const float fade = layer > 0 ? fminf(fmaxf(p->pressure[i] / layer, 0), 1) : 0;
    const float weight = fade * density * p->volume[i] / s->rest_number_density;
    const float moment_g[3] = {m[0] * g[0] + m[3] * g[1] + m[5] * g[2],
                               m[3] * g[0] + m[1] * g[1] + m[4] * g[2],
                               m[5] * g[0] + m[4] * g[1] + m[2] * g[2]};
    for (int k = 0; k < 3; k++) {
        const float push = p->pressure_term[i] * sums->push[k];
        const float hydrostatic = -weight * moment_g[k];
        const bool pulls = p->pressure[i] >= 0 && sums->push[k] * (push + hydrostatic) < 0;
        out[k] = pulls ? 0 : push + hydrostatic;
    }
}

static void add_walls(const CpuRange *range, const float x[3], size_t i)
{
    const Cpu *cpu = range->cpu;
    const CpuParticles *p = &cpu->now;
    WallSums sums;
    if (!walls_at(&cpu->constants->walls, x, &sums))
        return;
    float g[3], force[3];
    apparent_gravity_at(range->input->apparent, x, g);
    wall_force(cpu, i, g, &sums, force);
    p->ax[i] += force[0];
    p->ay[i] += force[1];
    p->az[i] += force[2];
}

static void force_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const WallsFar far = walls_far_of(range);
    cpu_pairs(range, &mueller_force);
    for (size_t i = range->begin; i < range->end; i++) {
        const float x[3] = {p->x[i], p->y[i], p->z[i]};
        if (walls_near(&far, x))
            add_walls(range, x, i);
    }
    cpu_force_end(range);
}

/* Of a neighbour {x, p V^2}. */
static PairCost density_pair(const Constants *constants)
{
    (void)constants;
    return (PairCost){.gather = 16, .flops = 14};
}

/* With a viscosity {v, V} too, and that of its fluid where there are several. */
static PairCost force_pair(const Constants *constants)
{
    const bool viscous = constants->rubs, many = viscous && constants->fluid_count > 1;
    return (PairCost){.gather = 16 + 16 * viscous + 4 * many, .flops = 22 + 11 * viscous + 2 * many};
}

static const CpuPass density = {.loops = {{density_body, .walks = true}}, .pair = density_pair};
/* A pair of force_range in sim/mueller/pairs.c. */
static void solid_force(const SolidPair *pair, float out[3])
{
    const Constants *s = pair->cpu->constants;
    const CpuParticles *p = &pair->cpu->now;
    const size_t i = pair->i, b = pair->b;
    const float t = 1 - pair->r / s->support_radius;
    const float push = s->pressure_scale * t * t * (p->pressure_term[i] + p->pressure_term[b]) / pair->r;
    const float drag =
        s->rubs ? 0.5F * s->viscosity_scale * t * p->volume[i] * p->volume[b] * cpu_pair_viscosity(pair) : 0;
    const float u[3] = {p->vx[b] - p->vx[i], p->vy[b] - p->vy[i], p->vz[b] - p->vz[i]};
    for (int k = 0; k < 3; k++)
        out[k] = push * pair->d[k] + drag * u[k];
}

static const CpuPass force = {
    .loops = {{force_body, .walks = true}}, .pair = force_pair, .solid = solid_force};

const Pass mueller_densities = {
    .name = "density",
    .stage = STAGE_DENSITY,
    .cpu = &density,
    .shader = "mueller/density",
    .reads = "position fluid",
    .writes = "volume pressure pressure_term viscosity tension kind",
};

const Pass mueller_forces = {
    .name = "force",
    .stage = STAGE_FORCE,
    .cpu = &force,
    .shader = "mueller/force",
    .reads = "position velocity id fluid volume pressure pressure_term viscosity tension kind",
    .writes = "acceleration",
    .felt = true,
    .mirrors = true,
};

static bool many_viscous(const Constants *constants)
{
    return constants->viscous && constants->fluid_count > 1;
}

const ColumnDef mueller_columns[] = {
    {"viscosity", "Pa s", .at = offsetof(ParticleColumns, viscosity), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS,
     .needed = many_viscous},
    {0},
};
