/* Velocity correction for shifts. A shift is not part of the flow, so a shifted particle takes on the
   flow's velocity at the new position, v += (shift . grad) v; otherwise each shift mixes velocities like
   friction. After: P. N. Sun, A. Colagrossi, S. Marrone, M. Antuono, A. M. Zhang, "A consistent approach to
   particle shifting in the delta-Plus-SPH model", 2019; M. Antuono, P. N. Sun, S. Marrone, A. Colagrossi,
   "The delta-ALE-SPH model", 2021; with constant masses. */
#include "sim/methods/wcsph/wcsph_private.h"

#include <math.h>
#include <string.h>

PAIR_LOOPS(wcsph_carried);

static void carry_body(const CpuRange *range)
{
    cpu_pairs(range, &wcsph_carried);
}

/* Per neighbour: {x, p V^2}, {v, V} and kind. */
static PairCost carry_pair(const Constants *constants)
{
    return (PairCost){.gather = 16 + 16 + 4, .flops = 48 + wcsph_shape_flops(constants)};
}

static const CpuPass carry = {.loops = {{carry_body, .walks = true}}, .pair = carry_pair};

const Pass wcsph_carry = {
    .name = "carry",
    .stage = STAGE_FORCE,
    .cpu = &carry,
    .shader = "wcsph/carry",
    .reads = "position velocity fluid kind uneven",
    .writes = "carried",
    .needed = wcsph_carries,
};

/* The carried density and derived quantities. */

PAIR_LOOPS(wcsph_slope);
PAIR_LOOPS(wcsph_rate);
PAIR_LOOPS(wcsph_images_rate);
PAIR_LOOPS(wcsph_corrected_rate);
PAIR_LOOPS(wcsph_interface_rate);

static void fill_rest_densities(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++)
        if (p->fluid[i] < FLUIDS_MAX)
            p->own[REST_DENSITY][i] = range->cpu->constants->density[p->fluid[i]];
}

static float boundary_part(const CpuRange *range, size_t i)
{
    float *const part = range->cpu->now.own[BOUNDARY_PART], *const rate = range->cpu->now.own[BOUNDARY_RATE];
    if (!part)
        return 0;
    part[i] =
        wcsph_boundary_part_after(wcsph_constants(range->cpu->constants), part[i], rate[i], range->input->dt);
    return part[i];
}

/* Density += rate times dt; pressure, and V = V0 rho0 / rho. Diffusion uses the mean of before and after,
   which is stable for steps up to 4 over its rate; the value after alone allows only 2. */
static void state_body(const CpuRange *range)
{
    Cpu *cpu = range->cpu;
    const Constants *s = cpu->constants;
    const WcsphBlock *own = wcsph_constants(s);
    const CpuParticles *p = &cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        const int fluid = p->fluid[i];
        if (fluid >= FLUIDS_MAX) {
            cpu_boundary_terms(cpu, i);
            continue;
        }
        const float before = p->compression[i],
                    e = wcsph_density_after(before, p->own[RATE][i] * range->input->dt),
                    more = boundary_part(range, i), pressure = wcsph_state_of(s, fluid, e + more);
        p->compression[i] = e;
        p->volume[i] = 1 / ((1 + e) * s->rest_number_density);
        p->pressure[i] = s->negative_pressure || pressure > 0 ? pressure : 0;
        p->pressure_term[i] = p->pressure[i] * p->volume[i] * p->volume[i];
        if (p->own[RELATIVE])
            p->own[RELATIVE][i] = 0.5f * (before + e) + more;
        if (p->own[ARTIFICIAL])
            p->own[ARTIFICIAL][i] = own->wcsph_fluids[fluid].artificial_viscosity;
        cpu_fill_terms(cpu, i);
    }
    if (p->own[REST_DENSITY])
        fill_rest_densities(range);
}

static void slope_body(const CpuRange *range)
{
    cpu_pairs(range, &wcsph_slope);
}

/* {x, p V^2}, and {v, 1 for boundary particles}. */
static void pack_flows(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        const float beside = p->fluid[i] < FLUIDS_MAX ? 0 : 1;
        memcpy(range->cpu->place[i], (float[]){p->x[i], p->y[i], p->z[i], p->pressure_term[i]}, 16);
        memcpy(range->cpu->motion[i], (float[]){p->vx[i], p->vy[i], p->vz[i], beside}, 16);
    }
}

static void rate_body(const CpuRange *range)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    const float *flow = p->ax;
    cpu_pairs(range, &wcsph_rate);
    cpu_pairs(range, &wcsph_images_rate);
    if (p->own[CORRECTION])
        cpu_pairs(range, &wcsph_corrected_rate);
    if (p->own[REST_DENSITY])
        cpu_pairs(range, &wcsph_interface_rate);
    for (size_t i = range->begin; i < range->end; i++)
        p->own[RATE][i] = flow[i] / s->rest_number_density;
    for (size_t i = range->begin; p->own[BOUNDARY_PART] && i < range->end; i++)
        p->own[BOUNDARY_RATE][i] = p->ay[i] / s->rest_number_density;
}

#define STATE                                                                                                \
    {                                                                                                        \
        state_body, .solids = true                                                                           \
    }

static const CpuPass state = {.loops = {STATE}};
/* Per neighbour: {x, p V^2}, fluid and relative density. */
static PairCost slope_pair(const Constants *constants)
{
    return (PairCost){.gather = 16 + 4 + 4, .flops = 32 + wcsph_shape_flops(constants)};
}

/* Per neighbour: {x, p V^2} and {v, V}; with diffusion also the data of the slope's pass, and the slope. */
static PairCost continuity_pair(const Constants *constants)
{
    const bool diffuses = wcsph_diffuses(constants);
    return (PairCost){.gather = 32 + 20 * diffuses + 4 * wcsph_layers(constants),
                      .flops = 20 + 13 * diffuses + wcsph_shape_flops(constants)};
}

static const CpuPass slope_cpu_pass = {.loops = {{slope_body, .walks = true}}, .pair = slope_pair};
static const CpuPass continuity = {.loops = {{rate_body, .walks = true, .pack = pack_flows}, STATE},
                                   .pair = continuity_pair};

const Pass wcsph_state = {
    .name = "state",
    .stage = STAGE_DENSITY,
    .cpu = &state,
    .shader = "wcsph/state",
    .reads = "fluid compression rate boundary_part boundary_rate",
    .writes =
        "compression boundary_part volume pressure pressure_term relative kind viscosity artificial tension "
        "rest_density",
};

const Pass wcsph_gradient = {
    .name = "slope",
    .stage = STAGE_DENSITY,
    .cpu = &slope_cpu_pass,
    .shader = "wcsph/slope",
    .reads = "position fluid relative kind",
    .writes = "slope",
    .needed = wcsph_diffuses,
};

const Pass wcsph_continuity = {
    .name = "continuity",
    .stage = STAGE_DENSITY,
    .cpu = &continuity,
    .shader = "wcsph/continuity",
    .reads =
        "position velocity fluid relative kind slope compression boundary_part correction correction_mixed "
        "rest_density",
    .writes =
        "rate boundary_rate compression boundary_part volume pressure pressure_term relative kind viscosity artificial tension "
        "rest_density acceleration",
};

/* Corrected gradients (solver.corrected_gradient): sums of wcsph that are exact for linear fields, for any
   arrangement of particles. After: J. Bonet, T.-S. L. Lok, "Variational and momentum preservation aspects
   of Smooth Particle Hydrodynamic formulations", 1999. The divergence of velocity uses the particle's own
   correction, and pressure uses both corrections of a pair. So both operators are adjoint: energy and
   momentum are conserved, angular momentum is not. */

PAIR_LOOPS(wcsph_matrix);

typedef struct Matrix {
    float xx, yy, zz, xy, yz, zx;
} Matrix;

static float ramp(float x, float from, float to)
{
    return fminf(fmaxf((x - from) / (to - from), 0), 1);
}

/* C = (M^-1 - 1) times a share. The share is 0 in spray, where less than 0.4 of the surrounding space is
   full, and 1 from 0.6 on, as at a flat surface. It is also 0 where neighbours hardly span the space. */
static Matrix correction(const Matrix m, int dimensions)
{
    const float cxx = m.yy * m.zz - m.yz * m.yz, cyy = m.xx * m.zz - m.zx * m.zx,
                czz = m.xx * m.yy - m.xy * m.xy;
    const float cxy = m.yz * m.zx - m.xy * m.zz, cyz = m.xy * m.zx - m.yz * m.xx,
                czx = m.xy * m.yz - m.zx * m.yy;
    const float det = m.xx * cxx + m.xy * cxy + m.zx * czx, mean = (m.xx + m.yy + m.zz) / 3;
    const float share = ramp(mean, 0.4f, 0.6f) * ramp(det / (mean * mean * mean), 0.5f, 0.75f);
    if (!(share > 0))
        return (Matrix){0};
    const float s = share / det, plane = dimensions == 2 ? 0 : 1;
    return (Matrix){s * cxx - share, s * cyy - share, plane * (s * czz - share), s * cxy, s * cyz, s * czx};
}

static void correct_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const int dimensions = range->cpu->constants->dimensions;
    const float n0 = range->cpu->constants->rest_number_density;
    float *const *c = p->own + CORRECTION;
    cpu_pairs(range, &wcsph_matrix);
    for (size_t i = range->begin; i < range->end; i++) {
        const float v = p->volume[i] * n0;
        Matrix m = {v * c[0][i], v * c[1][i], v * c[2][i], v * c[3][i], v * c[4][i], v * c[5][i]};
        if (dimensions == 2)
            m.zz = 0.5f * (m.xx + m.yy);
        m = correction(m, dimensions);
        c[0][i] = m.xx, c[1][i] = m.yy, c[2][i] = m.zz, c[3][i] = m.xy, c[4][i] = m.yz, c[5][i] = m.zx;
    }
}

/* Per neighbour: {x, p V^2}. */
static PairCost correct_pair(const Constants *constants)
{
    return (PairCost){.gather = 16, .flops = 23 + wcsph_shape_flops(constants)};
}

static const CpuPass correct = {.loops = {{correct_body, .walks = true}}, .pair = correct_pair};

const Pass wcsph_correct = {
    .name = "correct",
    .stage = STAGE_DENSITY,
    .cpu = &correct,
    .shader = "wcsph/correct",
    .reads = "position fluid kind volume",
    .writes = "correction correction_mixed",
    .needed = wcsph_corrects,
};

/* Normals of free surfaces and interfaces. */

PAIR_LOOPS(wcsph_normals);

static void normals_body(const CpuRange *range)
{
    cpu_pairs(range, &wcsph_normals);
    wcsph_join_few(range);
}

static const CpuPass normals = {.loops = {{normals_body, .walks = true}, {wcsph_join}}};

const Pass wcsph_surface = {
    .name = "surface",
    .stage = STAGE_FORCE,
    .cpu = &normals,
    .shader = "wcsph/surface",
    .reads = "position kind",
    .writes = "outward drop",
    .needed = wcsph_curves,
};

/* Shifting of particles down the gradient of their number density, to prevent particles from lining up.
   After: S. J. Lind, R. Xu, P. K. Stansby, B. D. Rogers, "Incompressible smoothed particle hydrodynamics
   for free-surface flows", 2012, eq. 22 to 25; P. N. Sun, A. Colagrossi, S. Marrone, A. M. Zhang, "The
   delta-plus-SPH model", 2017. */

/* Shift of chi c (h / 2) dt V0 sum F x_ij, with corrected gradients sum (1 + (S_i + S_j) / 2) F x_ij of
   sim/methods/wcsph/pairs_corrected.c, limited to a tenth of a spacing along each axis. */
static inline void shift_run(const CpuRange *range, const bool wide)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    float *const x[3] = {p->x, p->y, p->z}, *const v[3] = {p->vx, p->vy, p->vz};
    const float dt = range->input->dt;
    const float most = 0.1f * s->spacing,
                scale = wcsph_constants(s)->shift_speed * dt / s->rest_number_density;
    const float part = fminf(dt * wcsph_constants(s)->density_return, 1);
    for (size_t i = range->begin; i < range->end; i++) {
        float longest = 0;
        for (int k = 0; k < 3; k++)
            longest = fmaxf(longest, fabsf(scale * p->own[UNEVEN + k][i]));
        const float times = longest > most ? scale * (most / longest) : scale;
        for (int k = 0; k < 3; k++)
            place_move(&x[k][i], wide ? &p->own[COLUMNS_LEFT + k][i] : NULL, times * p->own[UNEVEN + k][i]);
        for (int k = 0; p->own[CARRIED] && k < 3; k++)
            v[k][i] += times * p->own[CARRIED + k][i];
        p->compression[i] += part * p->own[FULL][i] * (p->own[DENSE][i] - p->compression[i]);
    }
}

static void shift_body(const CpuRange *range)
{
    if (range->cpu->constants->wide)
        shift_run(range, true);
    else
        shift_run(range, false);
}

static const CpuPass shift = {.loops = {{shift_body}}};

const Pass wcsph_shift = {
    .name = "shift",
    .stage = STAGE_FORCE,
    .cpu = &shift,
    .shader = "wcsph/shift",
    .reads = "position remainder velocity compression uneven full dense carried",
    .writes = "position remainder velocity compression",
    .needed = wcsph_returns,
};

/* Accelerations, and with shifting the direction of shifts. */

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

/* C_i d of corrected gradients: sim/methods/wcsph/pairs_corrected.c; boundary particles have no correction.
 */
static void corrected(const CpuParticles *p, size_t i, const float d[3], float out[3])
{
    float *const *c = p->own + CORRECTION;
    out[0] = c[0][i] * d[0] + c[3][i] * d[1] + c[5][i] * d[2];
    out[1] = c[3][i] * d[0] + c[1][i] * d[1] + c[4][i] * d[2];
    out[2] = c[5][i] * d[0] + c[4][i] * d[1] + c[2][i] * d[2];
}

/* Force of a pair as in wcsph_range of sim/methods/wcsph/pairs_wcsph.c. */
static void solid_force(const SolidPair *pair, float out[3])
{
    const Constants *s = pair->cpu->constants;
    const WcsphBlock *own = wcsph_constants(s);
    const CpuParticles *p = &pair->cpu->now;
    const size_t i = pair->i, b = pair->b;
    const float *d = pair->d, most = 1 / (THINNEST * s->rest_number_density), h = s->support_radius;
    const float slope = cpu_slope(&shape_kernels[own->kernel_shape], pair, s->lattice.gradient_scale);
    const float both = fminf(p->volume[i], most) * fminf(pair->volume, most);
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
    .acts_on_solids = true,
    .mirrors = true,
};
