/* Density, pressure and forces: pair sums, then additions by walls. */
#include "sim/mueller/passes.h"

#include <math.h>

PAIR_LOOPS(mueller_density);
PAIR_LOOPS(mueller_force);

/* `volume` holds the pair sum on entry. */
static void finish_density(Cpu *cpu, size_t i)
{
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const float n = p->volume[i], pressure = mueller_state(s, p->fluid[i], n / s->rest_number_density - 1);

    p->volume[i] = 1 / n;
    p->pressure[i] = s->negative_pressure || pressure > 0 ? pressure : 0;
    p->pressure_term[i] = p->pressure[i] * p->volume[i] * p->volume[i];
    cpu_fill_terms(cpu, i);
}

static void density_body(const CpuRange *range)
{
    cpu_pairs(range, &mueller_density);
    for (size_t i = range->begin; i < range->end; i++)
        finish_density(range->cpu, i);
}

/* Hydrostatic continuation of pressure behind walls: the share of a particle's weight held by the walls.
   Fades out below the pressure of a layer, so that a drop on a wall falls freely. */
static void add_lift(const CpuRange *range, const float x[3], size_t i)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    float g[3], lift[3];
    apparent_gravity_at(range->input->apparent, x, g);
    const float layer = s->density[p->fluid[i]] * s->spacing * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    const float fade = layer > 0 ? fminf(fmaxf(p->pressure[i] / layer, 0), 1) : 0;
    walls_lift(&mueller_constants(s)->lift, &s->walls, x, lift);
    p->ax[i] -= fade * lift[0] * g[0];
    p->ay[i] -= fade * lift[1] * g[1];
    p->az[i] -= fade * lift[2] * g[2];
}

static void force_body(const CpuRange *range)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    const WallsFar far = walls_far(&s->walls, s->support_radius);
    cpu_pairs(range, &mueller_force);
    cpu_force_end(range);
    cpu_cushion(range);
    for (size_t i = range->begin; i < range->end; i++) {
        const float x[3] = {p->x[i], p->y[i], p->z[i]};
        if (walls_near(&far, x))
            add_lift(range, x, i);
    }
}

/* Per neighbour: {x, p V^2}. */
static PairCost density_pair(const Constants *constants)
{
    (void)constants;
    return (PairCost){.gather = 16, .flops = 14};
}

/* With viscosity also {v, V}, and with several fluids the neighbour's viscosity. */
static PairCost force_pair(const Constants *constants)
{
    const bool viscous = constants->rubs, many = viscous && constants->fluid_count > 1;
    return (PairCost){.gather = 16 + 16 * viscous + 4 * many, .flops = 22 + 11 * viscous + 2 * many};
}

static const CpuPass density = {.loops = {{density_body, .walks = true}}, .pair = density_pair};
/* Force of a pair as in force_range of sim/mueller/pairs.c. */
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
