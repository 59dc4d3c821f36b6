/* Accelerations, and with shifting the direction of shifts. */
#include "sim/wcsph/passes.h"

#include <math.h>

PAIR_LOOPS(wcsph_force);
PAIR_LOOPS(wcsph_images_force);
PAIR_LOOPS(wcsph_curvature);
PAIR_LOOPS(wcsph_corrected_force);
PAIR_LOOPS(wcsph_corrected_friction);
PAIR_LOOPS(wcsph_interface_force);

/* 0 at a surface, where less than 0.8 of the surrounding space is full; 1 from 0.95 on. */
static float share_of(float full)
{
    return fminf(fmaxf((full - 0.8f) / 0.15f, 0), 1);
}

static void complete_shift(const Cpu *cpu, size_t i)
{
    const Constants *s = cpu->constants;
    float *const *own = cpu->now.own;
    const float share = share_of(own[FULL][i] / ((float)s->dimensions * s->rest_number_density));
    for (int k = 0; k < 3; k++)
        own[UNEVEN + k][i] *= share;
    own[DENSE][i] = own[DENSE][i] / s->rest_number_density - 1;
    own[FULL][i] = share;
}

/* Near a wall, no shift goes out through a surface with tension: such shifts would fill the notch between
   the wall and an overhanging surface (Lind 2012 shifts along surfaces only). */
static void keep_notches(const Cpu *cpu, const WallsFar *far, size_t i)
{
    const CpuParticles *p = &cpu->now;
    const float *const n[3] = {p->own[OUTWARD], p->own[OUTWARD + 1], p->own[OUTWARD + 2]};
    if (!walls_near(far, (float[3]){p->x[i], p->y[i], p->z[i]}))
        return;
    float squared = 0, out = 0;
    for (int k = 0; k < 3; k++) {
        squared += n[k][i] * n[k][i];
        out += n[k][i] * p->own[UNEVEN + k][i];
    }
    if (squared > 0 && out > 0)
        for (int k = 0; k < 3; k++)
            p->own[UNEVEN + k][i] -= n[k][i] * out / squared;
}

static void add_corrected(const CpuRange *range)
{
    const Constants *s = range->cpu->constants;
    cpu_pairs(range, &wcsph_corrected_force);
    if (s->rubs && wcsph_constants(s)->radial_friction > 0)
        cpu_pairs(range, &wcsph_corrected_friction);
}

static void force_body(const CpuRange *range)
{
    cpu_pairs(range, &wcsph_force);
    cpu_pairs(range, &wcsph_images_force);
    if (wcsph_curves(range->cpu->constants))
        cpu_pairs(range, &wcsph_curvature);
    if (range->cpu->now.own[CORRECTION])
        add_corrected(range);
    if (range->cpu->now.own[REST_DENSITY])
        cpu_pairs(range, &wcsph_interface_force);
    if (range->cpu->now.own[FULL])
        for (size_t i = range->begin; i < range->end; i++)
            complete_shift(range->cpu, i);
    if (range->cpu->now.own[FULL] && range->cpu->now.own[OUTWARD]) {
        const Constants *s = range->cpu->constants;
        const WallsFar far = walls_far(&s->walls, s->support_radius);
        for (size_t i = range->begin; i < range->end; i++)
            keep_notches(range->cpu, &far, i);
    }
    cpu_force_end(range);
    cpu_cushion(range);
}

/* Per neighbour: {x, p V^2}; with friction {v, V}, and viscosities that differ between fluids. */
static PairCost force_pair(const Constants *constants)
{
    static const int heights[] = {[KERNEL_CUBIC] = 8, [KERNEL_WENDLAND_C2] = 6, [KERNEL_QUINTIC] = 18};
    const WcsphBlock *own = wcsph_constants(constants);
    const bool many = constants->fluid_count > 1, viscous = constants->rubs,
               artificial = wcsph_is_artificial(constants);
    PairCost cost = {.gather = 16, .flops = 18 + wcsph_shape_flops(constants)};
    if (viscous || artificial) {
        cost.gather += 16 + 4 * (viscous && many) + 4 * (artificial && many);
        cost.flops += 4 + (viscous ? (own->radial_friction > 0 ? 10 : 9) : 0) + 11 * artificial;
    }
    cost.gather += 4 * wcsph_layers(constants);
    if (wcsph_returns(constants))
        cost.flops += 9 + heights[own->kernel_shape];
    return cost;
}

/* C_i d of corrected gradients: sim/wcsph/pairs_corrected.c; boundary particles have no correction. */
static void corrected(const CpuParticles *p, size_t i, const float d[3], float out[3])
{
    float *const *c = p->own + CORRECTION;
    out[0] = c[0][i] * d[0] + c[3][i] * d[1] + c[5][i] * d[2];
    out[1] = c[3][i] * d[0] + c[1][i] * d[1] + c[4][i] * d[2];
    out[2] = c[5][i] * d[0] + c[4][i] * d[1] + c[2][i] * d[2];
}

/* Force of a pair as in wcsph_range of sim/wcsph/pairs.c. */
static void solid_force(const SolidPair *pair, float out[3])
{
    const Constants *s = pair->cpu->constants;
    const WcsphBlock *own = wcsph_constants(s);
    const CpuParticles *p = &pair->cpu->now;
    const size_t i = pair->i, b = pair->b;
    const float *d = pair->d, most = 1 / (THINNEST * s->rest_number_density), h = s->support_radius;
    const float slope = cpu_slope(&shape_kernels[own->kernel_shape], pair, s->lattice.gradient_scale);
    const float both = fminf(p->volume[i], most) * fminf(p->volume[b], most);
    const float u[3] = {p->vx[b] - p->vx[i], p->vy[b] - p->vy[i], p->vz[b] - p->vz[i]};
    const float along = u[0] * d[0] + u[1] * d[1] + u[2] * d[2], mu = cpu_pair_viscosity(pair);
    const float a = p->own[ARTIFICIAL] ? p->own[ARTIFICIAL][i] + p->own[ARTIFICIAL][b]
                                       : 2 * own->wcsph_fluids[0].artificial_viscosity;
    const bool radial = s->rubs && own->radial_friction > 0;
    const float drag = s->rubs && !radial ? both * mu : 0;
    float push = p->pressure_term[i] + p->pressure_term[b];
    push += radial ? both * mu * own->radial_friction * along : 0;
    push += wcsph_is_artificial(s) ? both * a * along / (pair->r * pair->r + h * h / 400) : 0;
    float more[3] = {0};
    if (p->own[CORRECTION])
        corrected(p, i, d, more);
    for (int k = 0; k < 3; k++)
        out[k] = slope * (push * d[k] + drag * u[k] + p->pressure_term[i] * more[k]);
}

static const CpuPass force = {
    .loops = {{force_body, .walks = true}}, .pair = force_pair, .solid = solid_force};

const Pass wcsph_forces = {
    .name = "force",
    .stage = STAGE_FORCE,
    .cpu = &force,
    .shader = "wcsph/force",
    .reads =
        "position velocity id fluid volume pressure pressure_term viscosity artificial tension kind outward correction "
        "correction_mixed rest_density",
    .writes = "acceleration uneven full dense pull",
    .felt = true,
    .mirrors = true,
};
