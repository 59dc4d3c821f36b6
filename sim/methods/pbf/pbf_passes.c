#include "sim/methods/pbf/pbf_private.h"

#include "sim/methods/shared/incompressible.h"

#include <math.h>
#include <string.h>

PAIR_LOOPS(pbf_sums);
PAIR_LOOPS(pbf_solids);
PAIR_LOOPS(pbf_push);
PAIR_LOOPS(pbf_friction);

static bool of_fluid(const Cpu *cpu, size_t i)
{
    return cpu->now.fluid[i] < FLUIDS_MAX;
}

/* --- prediction --- */

/* In the middle of the flight, in the axes of that moment. The velocity of a step is the way over dt, so that
   fluid at rest has velocity 0: positions fall by g dt^2, not half of it. A shift alone would turn with the
   box: hence omega. */
static inline void predict_run(const CpuRange *range, const bool wide)
{
    const CpuParticles *p = &range->cpu->now;
    float *const x[3] = {p->x, p->y, p->z};
    const float dt = range->input->dt, *g = range->input->gravity;
    float shift[3], swirl[3];
    for (int k = 0; k < 3; k++)
        shift[k] = 0.5F * dt * dt * g[k];
    box_cross(range->input->apparent->omega, shift, swirl);
    for (size_t i = range->begin; i < range->end; i++) {
        p->vx[i] += dt * g[0] - swirl[0];
        p->vy[i] += dt * g[1] - swirl[1];
        p->vz[i] += dt * g[2] - swirl[2];
        for (int k = 0; k < 3; k++)
            place_move(&x[k][i], wide ? &p->own[COLUMNS_LEFT + k][i] : NULL, shift[k]);
    }
}

static void predict_body(const CpuRange *range)
{
    if (range->cpu->constants->wide)
        predict_run(range, true);
    else
        predict_run(range, false);
}

static const CpuPass predict = {.loops = {{predict_body}}};

const Pass pbf_predict = {
    .name = "predict",
    .stage = STAGE_INTEGRATE,
    .cpu = &predict,
    .shader = "pbf/predict",
    .reads = "position remainder velocity",
    .writes = "position remainder velocity",
};

/* --- begin --- */

/* Columns without sorting, filled for the lists to come. */
static void fill(Cpu *cpu, size_t i)
{
    const CpuParticles *p = &cpu->now;
    const bool fluid = of_fluid(cpu, i);
    p->own[INVERSE_MASS][i] = fluid ? 1 / cpu->constants->mass[p->fluid[i]] : 0;
    p->own[RESIDUAL][i] = p->own[CHANGE][i] = p->own[WAY][i] = 0;
    if (fluid)
        cpu_fill_terms(cpu, i);
    else
        cpu_boundary_terms(cpu, i);
}

static float warm_part(const CpuRange *range)
{
    const float times = pbf_constants(range->cpu->constants)->settle_rate * range->input->dt;
    return 1 - fminf(FORGOTTEN, FORGOTTEN_RATE * times);
}

static void begin_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const float warm = warm_part(range);
    float *const *by = p->own + SOLID + SOLID_BY; /* NULL: a world without solids */
    for (size_t i = range->begin; i < range->end; i++) {
        fill(range->cpu, i);
        p->own[TERM][i] *= of_fluid(range->cpu, i) ? warm : 0;
        p->own[APPLIED][i] = 0;
        for (int k = 0; k < 3; k++) {
            p->own[MOVED + k][i] = 0;
            if (by[k])
                by[k][i] = 0;
        }
    }
}

static void again_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        fill(range->cpu, i);
        p->own[APPLIED][i] = p->own[TERM][i];
    }
}

/* The first walk after a grid makes the lists; meanwhile particles must not move. */
static void list_body(const CpuRange *range)
{
    (void)range;
}

/* Undo the fall of a step at rest in the box, as far as the walls let: the multipliers of the step before
   were found there. In the fluid a fall that all share does not matter. Nearer to a wall images push harder,
   and the pressure of a row next to a floor is 5 % too low in steps of 1/60 s at 4 cm. MOVED has the fall
   until the first move. */
static inline void rise_run(const CpuRange *range, const bool wide)
{
    const CpuParticles *p = &range->cpu->now;
    const WallsFar box = walls_far(&range->cpu->constants->walls, 0);
    float *const x[3] = {p->x, p->y, p->z};
    const float dt2 = range->input->dt * range->input->dt;
    for (size_t i = range->begin; i < range->end; i++) {
        float g[3];
        apparent_gravity_at(range->input->apparent, (float[]){p->x[i], p->y[i], p->z[i]}, g);
        for (int k = 0; k < 3; k++) {
            const float before = x[k][i], fall = dt2 * g[k], to = before - fall;
            const bool open = to > box.low[k] && to < box.high[k];
            if (open)
                place_move(&x[k][i], wide ? &p->own[COLUMNS_LEFT + k][i] : NULL, -fall);
            p->own[MOVED + k][i] = !open ? 0 : wide ? fall : before - x[k][i];
        }
    }
}

static void rise_body(const CpuRange *range)
{
    if (range->cpu->constants->wide)
        rise_run(range, true);
    else
        rise_run(range, false);
}

/* {x, 1 / m}. */
static void pack_place(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++)
        memcpy(range->cpu->place[i], (float[]){p->x[i], p->y[i], p->z[i], p->own[INVERSE_MASS][i]}, 16);
}

/* Beside solids {v, V} too. */
static void pack_for_sums(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    pack_place(range);
    for (size_t i = range->begin; p->own[SOLID] && i < range->end; i++)
        memcpy(range->cpu->motion[i], (float[]){p->vx[i], p->vy[i], p->vz[i], p->volume[i]}, 16);
}

static void pack_for_solids(const CpuRange *range)
{
    if (range->cpu->now.own[SOLID])
        pack_for_sums(range);
}

static void pack_nothing(const CpuRange *range)
{
    (void)range;
}

static const CpuPass begins[] = {
    {.loops = {{begin_body, .solids = true}, {list_body, .walks = true, .pack = pack_nothing}, {rise_body}}},
    {.loops = {{again_body, .solids = true}}},
};

#define FILL_WRITES  "viscosity tension kind inverse_mass change applied way"
#define SOLID_WRITES "solid_slope solid_share solid_lift solid_flow"

const Pass pbf_begin = {
    .name = "begin",
    .stage = STAGE_SOLVE,
    .cpu = &begins[0],
    .shader = "pbf/begin",
    .reads = "position remainder id fluid term",
    .writes = "position remainder " FILL_WRITES " residual term moved solid_by",
};

const Pass pbf_again = {
    .name = "again",
    .stage = STAGE_SOLVE,
    .cpu = &begins[1],
    .shader = "pbf/again",
    .reads = "id fluid term",
    .writes = FILL_WRITES " residual",
};

/* --- an iteration: places --- */

/* k by Jacobi's step plus a part of the last change. */
static float grown(const CpuParticles *p, size_t i, float scale, float least)
{
    const float before = p->own[TERM][i];
    const float k =
        before + scale * p->own[RESIDUAL][i] * p->own[FACTOR][i] + PBF_MOMENTUM * p->own[CHANGE][i];
    return k > least ? k : least;
}

/* {x, dk}. */
static void pack_growth(const CpuRange *range)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    const float dt = range->input->dt, square = dt * dt;
    const float scale = dt > 0 ? pbf_constants(s)->relaxation * s->rest_number_density / square : 0,
                least = s->negative_pressure ? -INFINITY : 0;
    for (size_t i = range->begin; i < range->end; i++) {
        float growth = 0;
        if (of_fluid(range->cpu, i)) {
            const float k = grown(p, i, scale, least);
            p->own[CHANGE][i] = k - p->own[TERM][i];
            growth = square * (k - p->own[APPLIED][i]);
            p->own[TERM][i] = p->own[APPLIED][i] = k;
        }
        memcpy(range->cpu->place[i], (float[]){p->x[i], p->y[i], p->z[i], growth}, 16);
    }
}

/* Shorten a way to `most`, m; a way that is not a number becomes 0. */
static void shorten(float way[3], float most)
{
    const float length2 = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
    if (length2 <= most * most)
        return;
    const float scale = length2 < INFINITY ? most / sqrtf(length2) : 0;
    for (int k = 0; k < 3; k++)
        way[k] = scale > 0 ? scale * way[k] : 0;
}

/* Obstacles on a particle's way: the walls, and solids as placed at the step's end. */
typedef struct PositionGuard {
    const Cpu *cpu;
    WallsFar inside, box;
    bool solids;
    SolidStep standing[SOLIDS_MAX];
} PositionGuard;

static void hold_make(const Cpu *cpu, PositionGuard *hold)
{
    const Constants *s = cpu->constants;
    hold->cpu = cpu;
    hold->inside = walls_far(&s->walls, WALL_LEAST * s->spacing);
    hold->box = walls_far(&s->walls, 0);
    hold->solids = s->solid_count > 0;
    for (int k = 0; k < s->solid_count; k++)
        solid_step_stand(&s->solids[k], &cpu->solid[k].end, &hold->standing[k]);
}

/* Move x out of walls and solids; true if x changed. A particle at a solid's surface is moved no further than
   into the box: the distance from a wall would push the particle into the solid. */
static bool held(const PositionGuard *hold, const float from[3], float x[3])
{
    float v[3] = {0};
    const bool by_solid = hold->solids && cpu_guard_solids(hold->cpu, hold->standing, from, x, v);
    const WallsFar *walls = by_solid ? &hold->box : &hold->inside;
    const bool by_wall = walls_near(walls, x);
    for (int k = 0; by_wall && k < 3; k++)
        x[k] = fminf(fmaxf(x[k], walls->low[k]), walls->high[k]);
    return by_solid || by_wall;
}

/* Move particle i by the sum over pairs, kg m. */
static inline __attribute__((always_inline)) void move_one(const PositionGuard *hold, size_t i,
                                                           const bool wide)
{
    const CpuParticles *p = &hold->cpu->now;
    const float w = p->own[INVERSE_MASS][i], from[3] = {p->x[i], p->y[i], p->z[i]},
                spacing = hold->cpu->constants->spacing;
    float way[3] = {w * p->ax[i], w * p->ay[i], w * p->az[i]};
    shorten(way, WAY_LONGEST * spacing);
    float x[3] = {from[0], from[1], from[2]}, left[3] = {0};
    for (int k = 0; k < 3; k++) {
        if (wide)
            left[k] = p->own[COLUMNS_LEFT + k][i];
        place_move(&x[k], wide ? &left[k] : NULL, way[k]);
    }
    const float free[3] = {x[0], x[1], x[2]};
    if (held(hold, from, x)) {
        place_put(free, x, wide ? left : NULL);
        for (int k = 0; k < 3; k++) /* a difference of places has fewer digits */
            way[k] = x[k] != free[k] ? x[k] - from[k] : way[k];
    }
    for (int k = 0; wide && k < 3; k++)
        p->own[COLUMNS_LEFT + k][i] = left[k];
    p->x[i] = x[0], p->y[i] = x[1], p->z[i] = x[2];
    for (int k = 0; k < 3; k++)
        p->own[MOVED + k][i] += way[k];
    p->own[WAY][i] += sqrtf(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]) / spacing;
}

static void move_all(const CpuRange *range)
{
    PositionGuard hold;
    hold_make(range->cpu, &hold);
    if (range->cpu->constants->wide)
        for (size_t i = range->begin; i < range->end; i++)
            move_one(&hold, i, true);
    else
        for (size_t i = range->begin; i < range->end; i++)
            move_one(&hold, i, false);
}

static void add_by_solid(const CpuParticles *p, size_t i, float scale, const float way[3])
{
    for (int k = 0; k < 3; k++)
        p->own[SOLID + SOLID_BY + k][i] += scale * way[k];
}

static void push(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    cpu_pairs(range, &pbf_push);
    for (size_t i = range->begin; p->own[SOLID] && i < range->end; i++) {
        float way[3] = {p->ax[i], p->ay[i], p->az[i]}, by[3];
        solid_push(p->own + SOLID, i, range->cpu->place[i][3], way, by);
        p->ax[i] = way[0], p->ay[i] = way[1], p->az[i] = way[2];
        add_by_solid(p, i, p->own[INVERSE_MASS][i], by);
    }
}

static void move_body(const CpuRange *range)
{
    push(range);
    move_all(range);
}

static float within_one(float part)
{
    return fminf(fmaxf(part, 0), 1);
}

/* The way over dt, m, by which walls and solids hold particle i: images have their particle's multiplier,
   without the slope that gravity gives pressure (WallLift). Beside walls, under less than four layers the way
   fades: pressure is noise there, and a dam's thin front would be held back. Beside solids such a fade stirs
   fluid on slopes below a surface. */
static void held_way(const CpuRange *range, const WallsFar *far, size_t i, float way[3])
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    const float x[3] = {p->x[i], p->y[i], p->z[i]}, dt2 = range->input->dt * range->input->dt;
    float g[3], share[3] = {0}, held[3] = {0};
    way[0] = way[1] = way[2] = 0;
    const bool near = walls_near(far, x);
    if (!near && !p->own[SOLID])
        return;
    apparent_gravity_at(range->input->apparent, x, g);
    const float pressure = pbf_constants(s)->pressure_of_term * p->own[TERM][i] / warm_part(range),
                layer = s->density[p->fluid[i]] * s->spacing * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]),
                layers = layer > 0 ? pressure / layer : 0, part = within_one(PBF_WALL_FADE(layers));
    if (near)
        walls_lift(&s->lift, &s->walls, x, share);
    if (p->own[SOLID]) {
        solid_hold(p->own + SOLID, i, g, within_one(PBF_SOLID_FADE(layers)), held);
        add_by_solid(p, i, dt2, held);
    }
    for (int k = 0; k < 3; k++)
        way[k] = dt2 * (held[k] - part * share[k] * g[k]);
}

/* Fall again, but for what the walls hold. */
static inline void fall_run(const CpuRange *range, const bool wide)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    const WallsFar far = walls_far(&s->walls, s->support_radius);
    float *const x[3] = {p->x, p->y, p->z};
    for (size_t i = range->begin; i < range->end; i++) {
        float way[3];
        held_way(range, &far, i, way);
        for (int k = 0; k < 3; k++) {
            float *const moved = &p->own[MOVED + k][i];
            place_move(&x[k][i], wide ? &p->own[COLUMNS_LEFT + k][i] : NULL, *moved + way[k]);
            *moved = way[k];
        }
    }
}

/* Before the first move, where the iterations' densities do not see particles. */
static void solids_body(const CpuRange *range)
{
    if (range->cpu->now.own[SOLID])
        cpu_pairs(range, &pbf_solids);
}

static void first_body(const CpuRange *range)
{
    push(range);
    if (range->cpu->constants->wide)
        fall_run(range, true);
    else
        fall_run(range, false);
    move_all(range);
}

/* Per neighbour {x, k}; for sums 1 / m too. */
static PairCost push_pair(const Constants *constants)
{
    (void)constants;
    return (PairCost){.gather = 16, .flops = 23};
}

static PairCost sums_pair(const Constants *constants)
{
    (void)constants;
    return (PairCost){.gather = 20, .flops = 31};
}

static const CpuPass moves[] = {
    {.loops = {{solids_body, .walks = true, .pack = pack_for_solids},
               {first_body, .walks = true, .pack = pack_growth}},
     .pair = push_pair},
    {.loops = {{move_body, .walks = true, .pack = pack_growth}}, .pair = push_pair},
};

#define MOVE(NAME, CPU, SHADER, MORE)                                                                                        \
    {                                                                                                                        \
        .name = NAME, .stage = STAGE_SOLVE, .cpu = &(CPU), .shader = "pbf/" SHADER,                                          \
        .reads =                                                                                                             \
            "position remainder id fluid term residual factor inverse_mass change applied moved way solid_by " SOLID_WRITES, \
        .writes = "position remainder term acceleration change applied moved way solid_by" MORE,                             \
    }

const Pass pbf_first = MOVE("first move", moves[0], "first", " " SOLID_WRITES);
const Pass pbf_move = MOVE("move", moves[1], "move", "");

/* --- an iteration: number density --- */

/* MIRRORED: change of n / n0 by boundary particles that mirror the way of particle i, as images in walls
   do. In n boundary particles stand still, but push twice, as images do. Pushes are the least change of
   velocities that keeps n (an orthogonal projection) only with the mirrored way. Else pushes do work, and
   fluid at rest stirs itself beside solids. */
static float mirrored(const CpuRange *range, size_t i)
{
    const CpuParticles *p = &range->cpu->now;
    const float dt = range->input->dt, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
    float *const *slope = p->own + SOLID + SOLID_SLOPE, sum = dt * p->own[SOLID_FLOW][i];
    const float near = fabsf(slope[0][i]) + fabsf(slope[1][i]) + fabsf(slope[2][i]);
    for (int k = 0; k < 3; k++)
        sum -= slope[k][i] * (dt * v[k] + p->own[MOVED + k][i]);
    const float change =
        near > 0 ? p->own[BOUNDARY_PART][i] + sum / range->cpu->constants->rest_number_density : 0;
    p->own[MIRRORED][i] = fminf(fmaxf(change, -PBF_MIRRORED), PBF_MIRRORED);
    return p->own[MIRRORED][i];
}

/* `later`: the part of the step's first compression left to later steps; of gaps too where pressure pulls.
   `more`: of n / n0, beside n itself. */
static void finish_density(const Cpu *cpu, size_t i, float later, float more)
{
    const CpuParticles *p = &cpu->now;
    const Constants *s = cpu->constants;
    float *const *solid = p->own + SOLID; /* NULL: a world without solids */
    const float sx = p->ax[i] + (solid[0] ? solid[0][i] : 0), sy = p->ay[i] + (solid[1] ? solid[1][i] : 0),
                sz = p->az[i] + (solid[2] ? solid[2][i] : 0), w = p->own[INVERSE_MASS][i];
    const float d = (sx * sx + sy * sy + sz * sz) * w + p->own[SQUARES][i],
                ratio = p->volume[i] / s->rest_number_density;
    p->own[FACTOR][i] = 1 / (d + pbf_constants(s)->least_squares * w);
    const float before = p->own[BEFORE][i] - 1;
    const float e = ratio + more - 1 - later * (s->negative_pressure ? before : fmaxf(before, 0));
    p->own[COMPRESSED][i] = ratio - 1;
    p->own[RESIDUAL][i] = e;
    p->own[MISS][i] = p->own[TERM][i] > 0 || s->negative_pressure ? fabsf(e) : fmaxf(e, 0);
    p->volume[i] = 1 / p->volume[i];
}

static void sum_up(const CpuRange *range)
{
    cpu_pairs(range, &pbf_sums);
    if (range->cpu->now.own[SOLID])
        cpu_pairs(range, &pbf_solids);
}

/* k n^2: sum (k_i + k_j) F x_ij is -grad (k n^2) / n, with n at the end of a step. */
static float pressure_of(const Constants *constants, const CpuParticles *p, size_t i)
{
    const float ratio = 1 + p->own[COMPRESSED][i];
    return pbf_constants(constants)->pressure_of_term * ratio * ratio * p->own[TERM][i];
}

/* A new particle starts with the first density found by a step. Values for the next step change only in real
   steps: passes also run with dt = 0, to be timed. */
static void density_body(const CpuRange *range)
{
    const Cpu *cpu = range->cpu;
    float *before = cpu->now.own[BEFORE];
    const float later = 1 - PBF_SHARE(pbf_constants(cpu->constants)->settle_rate * range->input->dt);
    const bool solids = cpu->now.own[SOLID];
    sum_up(range);
    for (size_t i = range->begin; i < range->end; i++) {
        if (before[i] == 0 && range->input->dt > 0)
            before[i] = cpu->now.volume[i] / cpu->constants->rest_number_density;
        finish_density(cpu, i, later, solids ? mirrored(range, i) : 0);
    }
}

static const CpuPass density = {.loops = {{density_body, .walks = true, .pack = pack_for_sums}},
                                .pair = sums_pair};

#define DENSITY_WRITES "volume acceleration squares factor compressed residual miss " SOLID_WRITES

const Pass pbf_density = {
    .name = "density",
    .stage = STAGE_SOLVE,
    .cpu = &density,
    .shader = "pbf/density",
    .reads = "position velocity id fluid term before inverse_mass moved boundary_part",
    .writes = DENSITY_WRITES " before mirrored",
};

/* --- settle --- */

static void settle_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    sum_up(range);
    for (size_t i = range->begin; i < range->end; i++) {
        finish_density(range->cpu, i, 0, 0);
        p->pressure[i] = pressure_of(range->cpu->constants, p, i);
        p->ax[i] = p->ay[i] = p->az[i] = 0;
    }
}

static const CpuPass settle = {
    .loops = {{again_body, .solids = true}, {settle_body, .walks = true, .pack = pack_for_sums}}};

const Pass pbf_settle = {
    .name = "settle",
    .stage = STAGE_DENSITY,
    .cpu = &settle,
    .shader = "pbf/settle",
    .reads = "position velocity id fluid term before",
    .writes = FILL_WRITES " " DENSITY_WRITES " pressure",
};

/* --- force --- */

/* {v, V} at the step's end. */
static void pack_motion(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const float rate = range->input->dt > 0 ? 1 / range->input->dt : 0;
    pack_place(range);
    for (size_t i = range->begin; i < range->end; i++)
        memcpy(range->cpu->motion[i],
               (float[]){p->vx[i] + rate * p->own[MOVED][i], p->vy[i] + rate * p->own[MOVED + 1][i],
                         p->vz[i] + rate * p->own[MOVED + 2][i], p->volume[i]},
               16);
}

/* The part of friction within the stable limit of the step, at most 1. */
static float part_of(const Constants *constants, float dt)
{
    const float stands = pbf_constants(constants)->viscous_dt;
    return dt > stands ? stands / dt : 1;
}

static void rub(const CpuRange *range)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    const float part = part_of(s, range->input->dt);
    if (s->rubs)
        cpu_pairs(range, &pbf_friction);
    for (size_t i = range->begin; i < range->end; i++) {
        p->ax[i] = s->rubs ? part * p->ax[i] : 0;
        p->ay[i] = s->rubs ? part * p->ay[i] : 0;
        p->az[i] = s->rubs ? part * p->az[i] : 0;
    }
}

static void keep_boundary_part(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const float kept = 1 / (1 + range->input->dt * pbf_constants(range->cpu->constants)->boundary_fades);
    for (size_t i = range->begin; i < range->end; i++)
        p->own[BOUNDARY_PART][i] = fminf(fmaxf(kept * p->own[MIRRORED][i], -BOUNDARY_MOST), BOUNDARY_MOST);
}

/* The kick adds all of a step's change to velocities, gravity included; so gravity of the flight is taken out
   first. */
static void force_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const float dt = range->input->dt, *g = range->input->gravity, rate = 1 / dt;
    rub(range);
    cpu_force_end(range);
    for (size_t i = range->begin; i < range->end; i++) {
        p->vx[i] -= dt * g[0];
        p->vy[i] -= dt * g[1];
        p->vz[i] -= dt * g[2];
        p->ax[i] += rate * rate * p->own[MOVED][i];
        p->ay[i] += rate * rate * p->own[MOVED + 1][i];
        p->az[i] += rate * rate * p->own[MOVED + 2][i];
        p->pressure[i] = pressure_of(range->cpu->constants, p, i);
        p->own[BEFORE][i] = dt > 0 ? p->own[COMPRESSED][i] + 1 : p->own[BEFORE][i];
    }
    if (p->own[BOUNDARY_PART] && dt > 0)
        keep_boundary_part(range);
}

/* By the ways of the whole step. */
static void solid_force(const SolidPair *pair, float force[3])
{
    const CpuParticles *p = &pair->cpu->now;
    const float(*motion)[4] = (const float(*)[4])pair->cpu->motion;
    const float *vi = motion[pair->i], *vb = motion[pair->b];
    const float part = part_of(pair->cpu->constants, pair->dt);
    float drag[3];
    incompressible_by_solid(pair, p->own + SOLID, 1 / (pair->dt * pair->dt), force);
    incompressible_rub(pair, (float[]){vb[0] - vi[0], vb[1] - vi[1], vb[2] - vi[2]}, drag);
    for (int k = 0; k < 3; k++)
        force[k] += part * drag[k];
}

static const CpuPass force = {.loops = {{force_body, .walks = true, .pack = pack_motion}},
                              .solid = solid_force};

const Pass pbf_force = {
    .name = "force",
    .stage = STAGE_FORCE,
    .cpu = &force,
    .shader = "pbf/force",
    .reads =
        "position velocity id fluid volume viscosity tension kind moved term compressed solid_slope solid_by mirrored",
    .writes = "velocity acceleration pressure before boundary_part",
    .acts_on_solids = true,
    .mirrors = true,
};

static bool many_viscous(const Constants *constants)
{
    return constants->viscous && (constants->fluid_count > 1 || constants->solid_count > 0);
}

#define OWN(k) .at = COLUMN_OWN(k)

const ColumnDef pbf_columns[] = {
    {"term", "Pa", OWN(TERM), 1, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED},
    {"before", "", OWN(BEFORE), 1, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED},
    {"factor", "kg/m", OWN(FACTOR), 1, COLUMN_FLOAT},
    {"squares", "m/kg", OWN(SQUARES), 1, COLUMN_FLOAT},
    {"inverse_mass", "m3/kg", OWN(INVERSE_MASS), 1, COLUMN_FLOAT},
    {"compressed", "", OWN(COMPRESSED), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS},
    {"residual", "", OWN(RESIDUAL), 1, COLUMN_FLOAT},
    {"miss", "", OWN(MISS), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS},
    {"change", "Pa", OWN(CHANGE), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS},
    {"applied", "Pa", OWN(APPLIED), 1, COLUMN_FLOAT},
    {"way", "", OWN(WAY), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS},
    {"moved", "m", OWN(MOVED), 3, COLUMN_FLOAT, .flags = COLUMN_SORTED},
    SOLID_COLUMN_ROWS(SOLID, COLUMN_SORTED),
    {"solid_flow", "1/s", OWN(SOLID_FLOW), 1, COLUMN_FLOAT, .needed = incompressible_has_solids},
    {"mirrored", "", OWN(MIRRORED), 1, COLUMN_FLOAT, .flags = COLUMN_SHADERS,
     .needed = incompressible_has_solids},
    {"boundary_part", "", OWN(BOUNDARY_PART), 1, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED,
     .needed = incompressible_has_solids},
    {"viscosity", "Pa s", .at = offsetof(ParticleColumns, viscosity), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS,
     .needed = many_viscous},
    {0},
};

const ColumnDef *const pbf_miss = &pbf_columns[MISS], *const pbf_compressed = &pbf_columns[COMPRESSED],
                       *const pbf_way = &pbf_columns[WAY];
