#include "sim/methods/dfsph/dfsph_private.h"

#include "sim/methods/shared/incompressible.h"

#include <math.h>
#include <string.h>

PAIR_LOOPS(dfsph_factor);
PAIR_LOOPS(dfsph_solids);
PAIR_LOOPS(dfsph_push);
PAIR_LOOPS(dfsph_rate);
PAIR_LOOPS(dfsph_friction);

static bool of_fluid(const Cpu *cpu, size_t i)
{
    return cpu->now.fluid[i] < FLUIDS_MAX;
}

/* --- state --- */

static void terms_body(const CpuRange *range)
{
    Cpu *cpu = range->cpu;
    const CpuParticles *p = &cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        p->pressure_term[i] = 0;
        if (of_fluid(cpu, i)) {
            p->own[INVERSE_MASS][i] = 1 / cpu->constants->mass[p->fluid[i]];
            cpu_fill_terms(cpu, i);
            continue;
        }
        p->own[INVERSE_MASS][i] = 0;
        cpu_boundary_terms(cpu, i);
    }
}

/* What a surface lacks, from |sum F x_ij| and from n / n0: 0 within the fluid, that of a lattice's outermost
   row at most. The bound is twice what n lacks: fluid out of order has some slope where n is whole. */
static float lack_of(const DfsphBlock *block, float slope, float full)
{
    const float part = (slope / block->surface_slope - SURFACE_FROM) / (1 - SURFACE_FROM);
    return fminf(fmaxf(part, 0), 1) * fminf(fmaxf(LACK_OVER_GAP * (1 - full), 0), block->surface_lack);
}

/* 1 / D, from the sums in n, acceleration and squares. Where particles are crowded, many k affect each rate,
   and Jacobi's step is shorter. */
static void finish_factor(const Cpu *cpu, size_t i)
{
    const CpuParticles *p = &cpu->now;
    float *const *solid = p->own + SOLID; /* NULL: a world without solids */
    const float sx = p->ax[i] + (solid[0] ? solid[0][i] : 0), sy = p->ay[i] + (solid[1] ? solid[1][i] : 0),
                sz = p->az[i] + (solid[2] ? solid[2][i] : 0);
    const float d = (sx * sx + sy * sy + sz * sz) * p->own[INVERSE_MASS][i] + p->own[SQUARES][i];
    const float least = dfsph_constants(cpu->constants)->least_squares * p->own[INVERSE_MASS][i];
    const float whole = d > least ? d : least;
    p->own[FACTOR][i] = whole > 0 ? fminf(1, cpu->constants->rest_number_density / p->volume[i]) / whole : 0;
    p->own[LACK][i] = lack_of(dfsph_constants(cpu->constants), p->own[LACK][i],
                              p->volume[i] / cpu->constants->rest_number_density);
    p->volume[i] = 1 / p->volume[i];
    p->pressure[i] = dfsph_constants(cpu->constants)->pressure_of_term * p->own[KEPT][i];
    p->ax[i] = p->ay[i] = p->az[i] = 0;
}

/* {x, 1 / m}, and velocities, used only for solids. */
static void pack_masses(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        memcpy(range->cpu->place[i], (float[]){p->x[i], p->y[i], p->z[i], p->own[INVERSE_MASS][i]}, 16);
        memcpy(range->cpu->motion[i], (float[]){p->vx[i], p->vy[i], p->vz[i], p->volume[i]}, 16);
    }
}

static void factor_body(const CpuRange *range)
{
    cpu_pairs(range, &dfsph_factor);
    if (range->cpu->now.own[SOLID])
        cpu_pairs(range, &dfsph_solids);
    for (size_t i = range->begin; i < range->end; i++)
        finish_factor(range->cpu, i);
}

static const CpuPass state = {
    .loops = {{terms_body, .solids = true}, {factor_body, .walks = true, .pack = pack_masses}}};

const Pass dfsph_state = {
    .name = "factor",
    .stage = STAGE_DENSITY,
    .cpu = &state,
    .shader = "dfsph/factor",
    .reads = "position id fluid kept_term",
    .writes =
        "volume pressure pressure_term acceleration viscosity tension kind factor squares lack inverse_mass "
        "solid_slope solid_flow solid_share solid_lift",
};

/* --- accelerations except pressure --- */

static void keep_by_solid(const CpuParticles *p, size_t i, const float a[3])
{
    for (int k = 0; k < 3; k++)
        p->own[SOLID + SOLID_BY + k][i] = a[k];
}

/* Part of a particle's weight held by solids, as by walls: it fades in with the pressure of a layer. */
static void hold_beside_solids(const CpuRange *range)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        float g[3], a[3];
        apparent_gravity_at(range->input->apparent, (float[]){p->x[i], p->y[i], p->z[i]}, g);
        const float layer =
            s->density[p->fluid[i]] * s->spacing * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
        const float fade = layer > 0 ? fminf(fmaxf(p->pressure[i] / layer - LIFT_FROM, 0), 1) : 0;
        solid_hold(p->own + SOLID, i, g, fade, a);
        keep_by_solid(p, i, a);
        p->ax[i] += a[0], p->ay[i] += a[1], p->az[i] += a[2];
    }
}

static void others_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const Constants *s = range->cpu->constants;
    if (s->rubs)
        cpu_pairs(range, &dfsph_friction);
    else
        for (size_t i = range->begin; i < range->end; i++)
            p->ax[i] = p->ay[i] = p->az[i] = 0;
    cpu_force_end(range);
    cpu_wall_lift(range, LIFT_FROM);
    if (p->own[SOLID])
        hold_beside_solids(range);
    for (size_t i = range->begin; i < range->end; i++) {
        p->own[OTHER][i] = p->ax[i];
        p->own[OTHER + 1][i] = p->ay[i];
        p->own[OTHER + 2][i] = p->az[i];
    }
}

static void rub_solid(const SolidPair *pair, float force[3])
{
    const CpuParticles *p = &pair->cpu->now;
    const size_t i = pair->i, b = pair->b;
    float rub[3];
    incompressible_rub(pair, (float[]){p->vx[b] - p->vx[i], p->vy[b] - p->vy[i], p->vz[b] - p->vz[i]}, rub);
    incompressible_by_solid(pair, p->own + SOLID, 1, force);
    for (int k = 0; k < 3; k++)
        force[k] += rub[k];
}

static const CpuPass others = {.loops = {{others_body, .walks = true}}, .solid = rub_solid};

const Pass dfsph_others = {
    .name = "force",
    .stage = STAGE_FORCE,
    .cpu = &others,
    .shader = "dfsph/force",
    .reads = "position velocity id fluid volume pressure viscosity tension kind solid_slope solid_lift",
    .writes = "acceleration other solid_by",
    .acts_on_solids = true,
    .mirrors = true,
};

/* --- terms that need the pressure --- */

static void pressed_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    float *const a[3] = {p->ax, p->ay, p->az}, *const *other = p->own + OTHER;
    for (int k = 0; k < 3; k++)
        for (size_t i = range->begin; i < range->end; i++) {
            const float pressed = a[k][i];
            a[k][i] += other[k][i];
            other[k][i] = -pressed;
        }
}

static void unpressed_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const float *const a[3] = {p->ax, p->ay, p->az};
    for (int k = 0; k < 3; k++)
        for (size_t i = range->begin; i < range->end; i++)
            p->own[OTHER + k][i] += a[k][i];
}

static bool has_terms(const Constants *constants)
{
    return constants->implicit.on;
}

static const CpuPass pressed = {.loops = {{pressed_body}}}, unpressed = {.loops = {{unpressed_body}}};

const Pass dfsph_pressed = {
    .name = "pressed",
    .stage = STAGE_SOLVE,
    .cpu = &pressed,
    .shader = "dfsph/pressed",
    .reads = "acceleration other",
    .writes = "acceleration other",
    .needed = has_terms,
};

const Pass dfsph_unpressed = {
    .name = "unpressed",
    .stage = STAGE_SOLVE,
    .cpu = &unpressed,
    .shader = "dfsph/unpressed",
    .reads = "acceleration other",
    .writes = "other",
    .needed = has_terms,
};

/* --- solvers: begin and end --- */

static void forget(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++)
        p->own[RESIDUAL][i] = p->own[CHANGE][i] = 0;
}

static void divergence_begin(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    forget(range);
    for (size_t i = range->begin; i < range->end; i++)
        p->pressure_term[i] = p->own[KEPT][i];
}

static void divergence_end(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        p->own[KEPT][i] = p->pressure_term[i];
        p->pressure[i] = dfsph_constants(range->cpu->constants)->pressure_of_term * p->pressure_term[i];
        p->ax[i] += p->own[OTHER][i];
        p->ay[i] += p->own[OTHER + 1][i];
        p->az[i] += p->own[OTHER + 2][i];
    }
}

/* Effect of the box on a particle until the middle of the next step, and the kick's gravity, m/s2. */
static void apparent_at(const PassInput *input, bool before_kick, const float x[3], float g[3])
{
    apparent_gravity_at(input->apparent, x, g);
    for (int k = 0; k < 3; k++)
        g[k] = 0.5F * (g[k] - input->gravity[k]) + (before_kick ? input->gravity[k] : 0);
}

static bool turning(const ApparentGravity *apparent)
{
    const float *a = apparent->alpha, *w = apparent->omega;
    return a[0] != 0 || a[1] != 0 || a[2] != 0 || w[0] != 0 || w[1] != 0 || w[2] != 0;
}

/* Velocities of the particles on the way to the middle of the next step, without the solver. They include
   half of the box's effect in the halves of the drift, and before the kick all accelerations except
   pressure. */
static void begin_motion(const CpuRange *range, bool before_kick)
{
    const CpuParticles p =
        range->cpu->now; /* a copy: for the compiler a write may change any pointer in memory */
    const PassInput *input = range->input;
    const bool turns = turning(input->apparent);
    float *const *base = p.own + BASE, *const *more = before_kick ? p.own + OTHER : NULL, g[3];
    apparent_at(input, before_kick, (float[]){0, 0, 0}, g); /* the same everywhere if the box does not turn */
    for (size_t i = range->begin; i < range->end; i++) {
        const bool solid = p.fluid[i] >= FLUIDS_MAX; /* keeps its velocity */
        const float v[3] = {p.vx[i], p.vy[i], p.vz[i]}, t = solid ? 0 : input->dt;
        if (turns)
            apparent_at(input, before_kick, (float[]){p.x[i], p.y[i], p.z[i]}, g);
        for (int k = 0; k < 3; k++)
            range->cpu->motion[i][k] = base[k][i] = v[k] + t * (g[k] + (more && !solid ? more[k][i] : 0));
        range->cpu->motion[i][3] = p.volume[i];
    }
}

/* Start from no move: a part of the last step's move would lift fluid at rest, again and again.
   OTHER keeps the accelerations meanwhile. */
static void density_begin(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    forget(range);
    for (size_t i = range->begin; i < range->end; i++) {
        p->pressure_term[i] = 0;
        p->own[OTHER][i] = p->ax[i];
        p->own[OTHER + 1][i] = p->ay[i];
        p->own[OTHER + 2][i] = p->az[i];
        p->ax[i] = p->ay[i] = p->az[i] = 0;
    }
}

static void divergence_motion(const CpuRange *range)
{
    begin_motion(range, true);
}

static void density_motion(const CpuRange *range)
{
    begin_motion(range, false);
}

/* The second part of boundary particles in the rate, up to the middle of the next step; 0 away from solids.
 */
static void fill_boundary_part(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const DfsphBlock *block = dfsph_constants(range->cpu->constants);
    float *const *slope = p->own + SOLID + SOLID_SLOPE, *part = p->own[BOUNDARY_PART];
    const float dt = range->input->dt, change = dt / range->cpu->constants->rest_number_density,
                kept = 1 / (1 + dt * block->boundary_fades);
    for (size_t i = range->begin; i < range->end; i++) {
        const float *v = range->cpu->motion[i], x = slope[0][i], y = slope[1][i], z = slope[2][i];
        const float flow = p->own[SOLID_FLOW][i] - v[0] * x - v[1] * y - v[2] * z;
        const float now = kept * (part[i] + change * flow);
        part[i] = x * x + y * y + z * z > 0 ? fminf(fmaxf(now, -BOUNDARY_MOST), BOUNDARY_MOST) : 0;
    }
}

/* A step's move is a part of a spacing: without the guard of solids. */
static inline void density_end_run(const CpuRange *range, const bool wide)
{
    const CpuParticles *p = &range->cpu->now;
    float *const x[3] = {p->x, p->y, p->z};
    const float dt2 = range->input->dt * range->input->dt, most = MOVE_MOST * range->cpu->constants->spacing;
    for (size_t i = range->begin; i < range->end; i++) {
        const float move[3] = {p->ax[i] * dt2, p->ay[i] * dt2, p->az[i] * dt2};
        const float length = sqrtf(move[0] * move[0] + move[1] * move[1] + move[2] * move[2]);
        const float share = length > most ? most / length : 1;
        for (int k = 0; k < 3; k++)
            place_move(&x[k][i], wide ? &p->own[COLUMNS_LEFT + k][i] : NULL, share * move[k]);
        p->ax[i] = p->own[OTHER][i];
        p->ay[i] = p->own[OTHER + 1][i];
        p->az[i] = p->own[OTHER + 2][i];
    }
}

static void density_end(const CpuRange *range)
{
    if (range->cpu->now.own[SOLID])
        fill_boundary_part(range);
    if (range->cpu->constants->wide)
        density_end_run(range, true);
    else
        density_end_run(range, false);
}

/* --- solvers: an iteration --- */

/* k by Jacobi's step plus a part of the last change. The first change of a k counts by the factor `begins`.
 */
static void step_terms(const CpuRange *range, float went_on, float begins)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    const float dt = range->input->dt;
    const float relaxed = dfsph_constants(s)->relaxation * s->rest_number_density;
    const float scale = dt > 0 ? relaxed / (dt * dt) : 0;
    const bool pulls = s->negative_pressure;
    const float momentum = dt > 0 ? went_on : 0;
    for (size_t i = range->begin; i < range->end; i++) {
        if (!of_fluid(range->cpu, i))
            continue;
        const float before = p->pressure_term[i];
        const float k =
            before + scale * p->own[RESIDUAL][i] * p->own[FACTOR][i] + momentum * p->own[CHANGE][i];
        p->pressure_term[i] = k > 0 || pulls ? k : 0;
        p->own[CHANGE][i] = (p->own[CHANGE][i] == 0 ? begins : 1) * (p->pressure_term[i] - before);
    }
}

/* {x, k} after the step of k; a coarse correction has taken the step already. */
static void pack_place(const CpuRange *range, float went_on, float begins)
{
    const CpuParticles *p = &range->cpu->now;
    if (!range->input->corrected)
        step_terms(range, went_on, begins);
    for (size_t i = range->begin; i < range->end; i++) {
        const float k = of_fluid(range->cpu, i) ? p->pressure_term[i] : 0; /* particles of solids have none */
        memcpy(range->cpu->place[i], (float[]){p->x[i], p->y[i], p->z[i], k}, 16);
    }
}

static void pack_density(const CpuRange *range)
{
    pack_place(range, DENSITY_MOMENTUM, 1);
}

static void pack_divergence(const CpuRange *range)
{
    pack_place(range, DIVERGENCE_MOMENTUM, DIVERGENCE_BEGINS);
}

static void go_on(const CpuRange *range)
{
    const CpuParticles p = range->cpu->now;
    float(*motion)[4] = range->cpu->motion;
    const float dt = range->input->dt;
    for (size_t i = range->begin; i < range->end; i++) {
        motion[i][0] = p.own[BASE][i] + dt * p.ax[i];
        motion[i][1] = p.own[BASE + 1][i] + dt * p.ay[i];
        motion[i][2] = p.own[BASE + 2][i] + dt * p.az[i];
    }
}

/* Push by the boundary particles' own k, and the part along the solid. */
static void push_solids(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        float a[3] = {p->ax[i], p->ay[i], p->az[i]}, by[3];
        solid_push(p->own + SOLID, i, p->pressure_term[i] * p->own[INVERSE_MASS][i], a, by);
        keep_by_solid(p, i, by);
        p->ax[i] = a[0], p->ay[i] = a[1], p->az[i] = a[2];
    }
}

static void push(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    cpu_pairs(range, &dfsph_push);
    for (size_t i = range->begin; i < range->end; i++) {
        p->ax[i] *= p->own[INVERSE_MASS][i];
        p->ay[i] *= p->own[INVERSE_MASS][i];
        p->az[i] *= p->own[INVERSE_MASS][i];
    }
    if (p->own[SOLID])
        push_solids(range);
    go_on(range);
}

/* Add the second half of the rate by boundary particles, whose velocities are mirrored. */
static void rate_solids(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    float *const *slope = p->own + SOLID + SOLID_SLOPE;
    for (size_t i = range->begin; i < range->end; i++) {
        const float *v = range->cpu->motion[i];
        p->own[RESIDUAL][i] +=
            p->own[SOLID_FLOW][i] - v[0] * slope[0][i] - v[1] * slope[1][i] - v[2] * slope[2][i];
    }
}

/* n / n0 + LACK + BOUNDARY_PART - 1 after the step. For divergence an excess of density at the begin counts
   as 0, and a lack counts: such a particle is free to come together. Where pressure pulls, a lack counts as 0
   too: no velocity may close a gap in one step; positions do. */
static void rate(const CpuRange *range, bool of_density)
{
    const CpuParticles *p = &range->cpu->now;
    const float dt = range->input->dt, n0 = range->cpu->constants->rest_number_density;
    const bool pulls = range->cpu->constants->negative_pressure;
    float *residual = p->own[RESIDUAL];
    cpu_pairs(range, &dfsph_rate);
    if (p->own[SOLID])
        rate_solids(range);
    const float *volume = p->volume, *k = p->pressure_term, change = dt / n0;
    const float above = of_density, below = of_density || !pulls,
                free = pulls; /* factors: excess, lack, no k */
    const float *lack = p->own[LACK], *solids = p->own[BOUNDARY_PART];
    float *miss = p->own[MISS];
#pragma omp simd
    for (size_t i = range->begin; i < range->end; i++) {
        const float now = 1 / (volume[i] * n0) + lack[i] + (solids ? solids[i] : 0) - 1,
                    counts = now > 0 ? above : below;
        const float left = now * counts + change * residual[i], held = k[i] > 0 ? 1 : free;
        const float other = -held * left;
        residual[i] = left;
        miss[i] = left > other ? left : other;
    }
}

static void density_rate(const CpuRange *range)
{
    rate(range, true);
}

static void divergence_rate(const CpuRange *range)
{
    rate(range, false);
}

/* --- the coarse level of the solver of divergence, without solids --- */

/* For k_i = v(x_i) where k > 0, a force sum (k_i + k_j) F x_ij is u v - C grad v: u is the force of k = 1, C
   is pressure_of_term / n0, half as much at a surface. The level adds the squares of both parts, over the
   mass. The product of the parts is left out: the sum is too small by a factor of two at most, and a surface
   across a coarse cell leaves no v free of force. */

/* The iteration's own step of k comes first: it holds a support radius more than k before, of a start from 0
 * too. */
static void coarse_step(const CpuRange *range)
{
    step_terms(range, DIVERGENCE_MOMENTUM, DIVERGENCE_BEGINS);
}

static float held(const Cpu *cpu, size_t i)
{
    return of_fluid(cpu, i) && (cpu->constants->negative_pressure || cpu->now.pressure_term[i] > 0);
}

static void pack_held(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++)
        memcpy(range->cpu->place[i], (float[]){p->x[i], p->y[i], p->z[i], held(range->cpu, i)}, 16);
}

/* Beside a solid the level leaves pressures that move a floating solid wrong (docs/labbook/methods.md). */
bool dfsph_has_coarse(const Constants *constants)
{
    return dfsph_solvers(constants)->coarse && constants->solid_count == 0;
}

/* Places of what cpu_coarse_correct reads, in the accelerations. */
enum { COARSE_WEIGHT, COARSE_HOLD, COARSE_RESIDUAL };

static void coarse_body(const CpuRange *range)
{
    const Cpu *cpu = range->cpu;
    const CpuParticles *p = &cpu->now;
    const DfsphBlock *block = dfsph_constants(cpu->constants);
    const float mass = block->lightest, unit = 1 / block->coarse_slope,
                over_lack = block->surface_lack > 0 ? 1 / block->surface_lack : 0;
    if (cpu->thin)
        return;
    cpu_pairs(range, &dfsph_push);
    for (size_t i = range->begin; i < range->end; i++) {
        const float holds = held(cpu, i), light = mass * p->own[INVERSE_MASS][i],
                    whole = 1 - 0.5F * over_lack * p->own[LACK][i];
        float *const a[3] = {&p->ax[i], &p->ay[i], &p->az[i]};
        float square = 0;
        for (int k = 0; k < 3; k++) {
            const float push = unit * *a[k];
            square += push * push;
        }
        *a[COARSE_WEIGHT] = holds * light * whole * whole;
        *a[COARSE_HOLD] = light * square;
        *a[COARSE_RESIDUAL] = holds * p->own[RESIDUAL][i];
    }
}

static void coarse_end(Cpu *cpu, const PassInput *input)
{
    if (cpu->thin)
        return;
    const Constants *s = cpu->constants;
    float *const a[3] = {cpu->now.ax, cpu->now.ay, cpu->now.az};
    const float slope = dfsph_constants(s)->coarse_slope, dt2 = input->dt * input->dt;
    const CoarseTerms terms = {
        .weight = a[COARSE_WEIGHT],
        .hold = a[COARSE_HOLD],
        .residual = a[COARSE_RESIDUAL],
        .value = cpu->now.pressure_term,
        .scale = dt2 > 0 ? s->rest_number_density * dfsph_constants(s)->lightest / (dt2 * slope * slope) : 0,
        .negative = s->negative_pressure,
        .left = (double)COARSE_LEFT,
    };
    cpu_coarse_correct(cpu, &terms);
}

static const CpuPass coarse = {.loops = {{coarse_step}, {coarse_body, .walks = true, .pack = pack_held}},
                               .end = coarse_end};

/* The motion of solids' particles stays through all iterations. */
static const CpuPass begins[] = {
    {.loops = {{divergence_begin}, {divergence_motion, .solids = true}}},
    {.loops = {{density_begin}, {density_motion, .solids = true}}},
};
static void push_solid(const SolidPair *pair, float force[3])
{
    incompressible_by_solid(pair, pair->cpu->now.own + SOLID, 1, force);
}

static const CpuPass ends[] = {{.loops = {{divergence_end}}, .solid = push_solid},
                               {.loops = {{density_end}}}};

/* Per neighbour {x, k}; for a rate {v, V} too. */
static PairCost push_pair(const Constants *constants)
{
    (void)constants;
    return (PairCost){.gather = 16, .flops = 23};
}

static PairCost rate_pair(const Constants *constants)
{
    (void)constants;
    return (PairCost){.gather = 32, .flops = 26};
}

static const CpuPass pushes[] = {
    {.loops = {{push, .walks = true, .pack = pack_divergence}}, .pair = push_pair},
    {.loops = {{push, .walks = true, .pack = pack_density}}, .pair = push_pair},
};
static const CpuPass rates[] = {
    {.loops = {{divergence_rate, .walks = true, .packed = true}}, .pair = rate_pair},
    {.loops = {{density_rate, .walks = true, .packed = true}}, .pair = rate_pair},
};

#define SOLVE(NAME, CPU, SHADER, READS, WRITES)                                                              \
    {                                                                                                        \
        .name = NAME, .stage = STAGE_SOLVE, .cpu = &(CPU), .shader = "dfsph/" SHADER, .reads = READS,        \
        .writes = WRITES                                                                                     \
    }

#define PUSH_READS                                                                                           \
    "position id fluid base pressure_term residual factor inverse_mass change solid_slope solid_share"
#define RATE_READS "position id fluid volume lack pressure_term solid_slope solid_flow boundary_part"

const Pass dfsph_divergence_begin =
    SOLVE("divergence begin", begins[0], "divergence_begin", "position velocity fluid volume other kept_term",
          "pressure_term residual change base");
const Pass dfsph_divergence_push = SOLVE("divergence push", pushes[0], "divergence_push", PUSH_READS,
                                         "pressure_term acceleration change solid_by");
const Pass dfsph_divergence_rate =
    SOLVE("divergence rate", rates[0], "divergence_rate", RATE_READS, "residual miss");
const Pass dfsph_coarse = {
    .name = "coarse",
    .stage = STAGE_SOLVE,
    .cpu = &coarse,
    .shader = "dfsph/coarse",
    .corrects = true,
    .needed = dfsph_has_coarse,
    .reads = "position id fluid pressure_term residual lack factor inverse_mass change",
    .writes = "pressure_term acceleration change",
};
const Pass dfsph_divergence_end = {
    .name = "divergence end",
    .stage = STAGE_SOLVE,
    .cpu = &ends[0],
    .shader = "dfsph/divergence_end",
    .reads = "pressure_term acceleration other",
    .writes = "kept_term pressure acceleration",
    .acts_on_solids = true,
};
const Pass dfsph_density_begin =
    SOLVE("density begin", begins[1], "density_begin", "position velocity fluid volume acceleration",
          "pressure_term residual change other acceleration base");
const Pass dfsph_density_push = SOLVE("density push", pushes[1], "density_push", PUSH_READS,
                                      "pressure_term acceleration change solid_by");
const Pass dfsph_density_rate = SOLVE("density rate", rates[1], "density_rate", RATE_READS, "residual miss");
const Pass dfsph_density_end =
    SOLVE("density end", ends[1], "density_end",
          "position remainder acceleration other solid_slope solid_flow boundary_part",
          "position remainder acceleration boundary_part");

static bool many_viscous(const Constants *constants)
{
    return constants->viscous && (constants->fluid_count > 1 || constants->solid_count > 0);
}

#define OWN(k) .at = COLUMN_OWN(k)

const ColumnDef dfsph_columns[] = {
    {"kept_term", "Pa", OWN(KEPT), 1, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED},
    {"factor", "kg/m", OWN(FACTOR), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS},
    {"squares", "m/kg", OWN(SQUARES), 1, COLUMN_FLOAT},
    {"lack", "", OWN(LACK), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS},
    {"inverse_mass", "m3/kg", OWN(INVERSE_MASS), 1, COLUMN_FLOAT},
    {"residual", "", OWN(RESIDUAL), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS},
    {"miss", "", OWN(MISS), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS},
    {"change", "Pa", OWN(CHANGE), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS},
    {"other", "m/s2", OWN(OTHER), 3, COLUMN_FLOAT},
    {"base", "m/s", OWN(BASE), 3, COLUMN_FLOAT},
    SOLID_COLUMN_ROWS(SOLID, COLUMN_SHADERS),
    {"solid_flow", "1/s", OWN(SOLID_FLOW), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS,
     .needed = incompressible_has_solids},
    {"boundary_part", "", OWN(BOUNDARY_PART), 1, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED,
     .needed = incompressible_has_solids},
    {"viscosity", "Pa s", .at = offsetof(ParticleColumns, viscosity), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS,
     .needed = many_viscous},
    {0},
};

const ColumnDef *const dfsph_miss = &dfsph_columns[MISS];
