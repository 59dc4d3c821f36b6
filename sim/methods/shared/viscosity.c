#include "sim/def/fluids.h"
#include "sim/methods/shared/terms.h"
#include "sim/step/substep.h"

#include <math.h>
#include <string.h>

PAIR_LOOPS(viscosity_sums);
PAIR_LOOPS(viscosity_products);

/* Inertia over m, 1/s, in a step of no time: nothing changes. */
#define ENDLESS 1e18F

static float inertia_of(const CpuRange *range, size_t i)
{
    const float m = range->cpu->constants->mass[range->cpu->now.fluid[i]], dt = range->input->dt;
    return dt > 0 ? m / dt : ENDLESS * m;
}

/* --- begin --- */

/* Change of velocity with the friction of the step before. */
static void change_before(const CpuRange *range, size_t i, float d[3])
{
    const CpuParticles *p = &range->cpu->now;
    const float *g = range->input->gravity, dt = range->input->dt;
    d[0] = dt * (p->ax[i] + g[0] + p->own[BEFORE][i]);
    d[1] = dt * (p->ay[i] + g[1] + p->own[BEFORE + 1][i]);
    d[2] = dt * (p->az[i] + g[2] + p->own[BEFORE + 2][i]);
}

/* Velocities after that change; velocities of solids stay. */
static void pack_begin(const CpuRange *range)
{
    Cpu *cpu = range->cpu;
    const CpuParticles p = cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        const bool solid = p.fluid[i] >= FLUIDS_MAX;
        const float mu = p.viscosity ? p.viscosity[i] : cpu->constants->viscosity[0],
                    volume = solid ? -p.volume[i] : p.volume[i];
        float d[3] = {0};
        if (!solid)
            change_before(range, i, d);
        const float v[3] = {p.vx[i] + d[0], p.vy[i] + d[1], p.vz[i] + d[2]};
        p.term[MISS][i] = mu;
        memcpy(cpu->place[i], (float[]){p.x[i], p.y[i], p.z[i], mu}, 16);
        memcpy(cpu->motion[i], (float[]){v[0], v[1], v[2], volume}, 16);
    }
}

/* Walls of the box without slip: returns K, kg/s, and adds the walls' force on particle i. */
static float held_by_walls(const CpuRange *range, size_t i, float mu, const float v[3], float force[3])
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    const float x[3] = {p->x[i], p->y[i], p->z[i]}, drag = s->no_slip ? wall_drag_at(&s->drag, x) : 0;
    if (drag == 0)
        return 0;
    const float scale = mu * p->volume[i] / s->rest_number_density,
                lid = s->lid ? scale * wall_drag_lid(&s->drag, x) : 0;
    for (int k = 0; k < 3; k++)
        force[k] += lid * s->lid_velocity[k] - scale * drag * v[k];
    return scale * drag;
}

/* m <- the inverse of the symmetric positive m; in double precision, since some eigenvalues may be a
   millionth of others. */
static void invert(float *const m[6], size_t i)
{
    const double xx = m[0][i], yy = m[1][i], zz = m[2][i], xy = m[3][i], yz = m[4][i], zx = m[5][i];
    const double cxx = yy * zz - yz * yz, cyy = xx * zz - zx * zx, czz = xx * yy - xy * xy;
    const double cxy = yz * zx - xy * zz, cyz = xy * zx - yz * xx, czx = xy * yz - zx * yy;
    const double scale = 1 / (xx * cxx + xy * cxy + zx * czx);
    const double all[6] = {cxx, cyy, czz, cxy, cyz, czx};
    for (int k = 0; k < 6; k++)
        m[k][i] = (float)(scale * all[k]);
}

/* The product with a symmetric matrix. */
static void times(float *const m[6], size_t i, const float v[3], float out[3])
{
    out[0] = m[0][i] * v[0] + m[3][i] * v[1] + m[5][i] * v[2];
    out[1] = m[3][i] * v[0] + m[1][i] * v[1] + m[4][i] * v[2];
    out[2] = m[5][i] * v[0] + m[4][i] * v[1] + m[2][i] * v[2];
}

static float length(const float v[3])
{
    return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* The first residual, at the first d; z, the first direction, into PRODUCT. */
static void begin_one(const CpuRange *range, size_t i)
{
    const CpuParticles *p = &range->cpu->now;
    float *const *t = p->term;
    const float *g = range->input->gravity, dt = range->input->dt,
                m = range->cpu->constants->mass[p->fluid[i]], mu = t[MISS][i];
    const float v[3] = {p->vx[i], p->vy[i], p->vz[i]},
                a[3] = {p->ax[i] + g[0], p->ay[i] + g[1], p->az[i] + g[2]}, rate = dt > 0 ? m / dt : 0;
    float d[3], force[3] = {t[RESIDUAL][i], t[RESIDUAL + 1][i], t[RESIDUAL + 2][i]}, held[3] = {0}, z[3];
    change_before(range, i, d);
    t[INERTIA][i] = inertia_of(range, i) + held_by_walls(range, i, mu, v, force);
    if (t[HELD])
        times(t + HELD, i, d, held);
    for (int k = 0; k < 3; k++) {
        /* the sums have half of `held` */
        force[k] += m * a[k] + rate * p->own[LEFT + k][i] - t[INERTIA][i] * d[k] - 0.5F * held[k];
        t[RESIDUAL + k][i] = force[k];
        t[CHANGE + k][i] = d[k];
        t[DIRECTION + k][i] = t[ALONG + k][i] = 0;
        t[INVERSE + k][i] += t[INERTIA][i] + (t[HELD] ? 0.5F * t[HELD + k][i] : 0);
        t[INVERSE + 3 + k][i] += t[HELD] ? 0.5F * t[HELD + 3 + k][i] : 0; /* the sum has half of HELD */
    }
    invert(t + INVERSE, i);
    times(t + INVERSE, i, force, z);
    for (int k = 0; k < 3; k++)
        t[PRODUCT + k][i] = z[k];
    t[MISS][i] = dt / m * length(force);
    t[SCALE][i] = length(v) + dt * (length(a) + length(g));
}

static void begin_body(const CpuRange *range)
{
    cpu_pairs(range, &viscosity_sums);
    for (size_t i = range->begin; i < range->end; i++)
        begin_one(range, i);
}

/* For products: boundary particles have change 0 and no volume here; their part is in B. */
static void motion_body(const CpuRange *range)
{
    Cpu *cpu = range->cpu;
    const CpuParticles *p = &cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        const bool solid = p->fluid[i] >= FLUIDS_MAX;
        for (int k = 0; k < 3; k++)
            cpu->motion[i][k] = solid ? 0 : p->term[PRODUCT + k][i];
        cpu->motion[i][3] = solid ? 0 : p->volume[i];
    }
}

static const CpuPass begin = {
    .loops = {{begin_body, .walks = true, .pack = pack_begin}, {motion_body, .solids = true}}};

const Pass viscosity_begin = {
    .name = "viscosity begin",
    .stage = STAGE_SOLVE,
    .cpu = &begin,
    .shader = "viscosity/begin",
    .reads = "position velocity fluid volume viscosity acceleration friction_before friction_left",
    .writes = "velocity_change residual direction along product inverse held inertia miss scale",
    .mirrors = true,
};

/* --- an iteration --- */

static void step_body(const CpuRange *range)
{
    float *const *t = range->cpu->now.term;
    const float go = range->input->go, turn = range->input->turn;
    for (size_t i = range->begin; i < range->end; i++) {
        float *z = range->cpu->motion[i], r[3];
        for (int k = 0; k < 3; k++) {
            const float p = z[k] + turn * t[DIRECTION + k][i], s = t[PRODUCT + k][i] + turn * t[ALONG + k][i];
            t[DIRECTION + k][i] = p;
            t[ALONG + k][i] = s;
            t[CHANGE + k][i] += go * p;
            r[k] = t[RESIDUAL + k][i] -= go * s;
        }
        times(t + INVERSE, i, r, z);
        t[MISS][i] = length(r) * range->input->dt / range->cpu->constants->mass[range->cpu->now.fluid[i]];
    }
}

static void product_body(const CpuRange *range)
{
    float *const *t = range->cpu->now.term;
    cpu_pairs(range, &viscosity_products);
    for (size_t i = range->begin; i < range->end; i++) {
        const float *z = range->cpu->motion[i];
        float held[3] = {0}, power = 0, curvature = 0;
        if (t[HELD])
            times(t + HELD, i, z, held);
        for (int k = 0; k < 3; k++) {
            t[PRODUCT + k][i] += t[INERTIA][i] * z[k] + held[k];
            power += t[RESIDUAL + k][i] * z[k];
            curvature += t[PRODUCT + k][i] * z[k];
        }
        t[POWER][i] = power;
        t[CURVATURE][i] = curvature;
    }
}

/* Per neighbour {x, mu} and {z, V}. */
static PairCost product_pair(const Constants *constants)
{
    (void)constants;
    return (PairCost){.gather = 32, .flops = 33};
}

static const CpuPass step_pass = {.loops = {{step_body}}};
static const CpuPass product = {.loops = {{product_body, .walks = true, .packed = true}},
                                .pair = product_pair};

const Pass viscosity_step = {
    .name = "viscosity step",
    .stage = STAGE_SOLVE,
    .cpu = &step_pass,
    .shader = "viscosity/step",
    .reads = "fluid direction along product velocity_change residual inverse",
    .writes = "direction along velocity_change residual miss",
};

const Pass viscosity_product = {
    .name = "viscosity product",
    .stage = STAGE_SOLVE,
    .cpu = &product,
    .shader = "viscosity/product",
    .reads = "position fluid volume residual held inertia",
    .writes = "product power curvature",
};

/* --- end --- */

static void end_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const float *g = range->input->gravity, rate = range->input->dt > 0 ? 1 / range->input->dt : 0;
    const Constants *s = range->cpu->constants;
    float *const a[3] = {p->ax, p->ay, p->az}, *const *before = p->own + BEFORE, *const *left = p->own + LEFT;
    for (int k = 0; k < 3; k++)
        for (size_t i = range->begin; i < range->end && rate > 0; i++) {
            const float change = rate * p->term[CHANGE + k][i];
            before[k][i] = change - (a[k][i] + g[k]);
            left[k][i] = p->term[RESIDUAL + k][i] * range->input->dt / s->mass[p->fluid[i]];
            a[k][i] = change - g[k];
        }
}

static const CpuPass end = {.loops = {{end_body}}};

const Pass viscosity_end = {
    .name = "viscosity end",
    .stage = STAGE_SOLVE,
    .cpu = &end,
    .shader = "viscosity/end",
    .reads = "fluid velocity_change residual acceleration",
    .writes = "acceleration friction_before friction_left",
};

static bool is_implicit(const Constants *constants)
{
    return constants->implicit.on;
}

static bool is_named(const Constants *constants)
{
    return constants->implicit.named;
}

static bool by_solids(const Constants *constants)
{
    return constants->implicit.on && constants->solid_count > 0;
}

#define TERM(name, unit, k, components)                                                                      \
    {                                                                                                        \
        name, unit, .at = COLUMN_TERM(k), components, COLUMN_FLOAT, .flags = COLUMN_SHADERS,                 \
                    .needed = is_implicit                                                                    \
    }

const ColumnDef viscosity_columns[] = {
    {"friction_before", "m/s2", .at = COLUMN_OWN(BEFORE), 3, COLUMN_FLOAT,
     .flags = COLUMN_SAVED | COLUMN_SORTED, .needed = is_named},
    {"friction_left", "m/s", .at = COLUMN_OWN(LEFT), 3, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED,
     .needed = is_named},
    TERM("velocity_change", "m/s", CHANGE, 3),
    TERM("residual", "N", RESIDUAL, 3),
    TERM("direction", "m/s", DIRECTION, 3),
    TERM("along", "N", ALONG, 3),
    TERM("product", "N", PRODUCT, 3),
    TERM("inverse", "s/kg", INVERSE, 3),
    TERM("inverse_mixed", "s/kg", INVERSE + 3, 3),
    {"held", "kg/s", .at = COLUMN_TERM(HELD), 3, COLUMN_FLOAT, .flags = COLUMN_SHADERS, .needed = by_solids},
    {"held_mixed", "kg/s", .at = COLUMN_TERM(HELD + 3), 3, COLUMN_FLOAT, .flags = COLUMN_SHADERS,
     .needed = by_solids},
    TERM("inertia", "kg/s", INERTIA, 1),
    TERM("miss", "m/s", MISS, 1),
    TERM("scale", "m/s", SCALE, 1),
    TERM("power", "W", POWER, 1),
    TERM("curvature", "W", CURVATURE, 1),
    {0},
};

/* The term of friction at the end of a step, for all methods: sim/methods/shared/terms.h. */

static bool needed(const Constants *constants)
{
    return constants->implicit.on;
}

static bool named(const WorldDef *def)
{
    return def->viscosity_solver == VISCOSITY_IMPLICIT;
}

static bool by_wendland(const Constants *constants)
{
    return needed(constants) && constants->implicit.kernel == KERNEL_WENDLAND_C2;
}

static bool by_quintic(const Constants *constants)
{
    return needed(constants) && constants->implicit.kernel == KERNEL_QUINTIC;
}

static const ShaderTerm shader_terms[] = {
    {"FRICTION_WENDLAND_C2", by_wendland}, {"FRICTION_QUINTIC", by_quintic}, {0}};

/* Elements are vec4: z, mu. */
static const ShaderBuffer trials = {"Trials", 16, needed};

static const ColumnDef *column_at(int k)
{
    const ColumnDef *column = viscosity_columns;
    while (column->at != COLUMN_TERM(k))
        column++;
    return column;
}

static void solve(const Substep *step)
{
    const ImplicitViscosity *own = &step->constants->implicit;
    const Iteration iteration = {.passes = {&viscosity_step, &viscosity_product},
                                 .residual = column_at(MISS),
                                 .scale = column_at(SCALE),
                                 .power = column_at(POWER),
                                 .curvature = column_at(CURVATURE),
                                 .tolerance = own->tolerance,
                                 .few = 1, /* at least one iteration if any residual is above 0 */
                                 .most = own->most,
                                 .begun = true,
                                 .allowed = own->tolerance};
    substep_run(step, &viscosity_begin, step->dt);
    substep_run(step, &viscosity_product, step->dt);
    substep_iterate(step, &iteration, SOLVE_VISCOSITY, step->dt);
    substep_run(step, &viscosity_end, step->dt);
}

static const Pass *const passes[] = {&viscosity_begin, &viscosity_step, &viscosity_product, &viscosity_end,
                                     NULL};

const Term term_viscosity = {
    .name = "viscosity",
    .words = "implicit viscosity",
    .named = named,
    .needed = needed,
    .columns = viscosity_columns,
    .passes = passes,
    .terms = shader_terms,
    .buffer = &trials,
    .solve = SOLVE_VISCOSITY,
    .solver = {"viscosity", "solver.viscosity_tolerance", "solver.viscosity_iterations"},
    .substep = solve,
};
