/* Boundary particles: they move with the solids and take their values from the fluid around. */
#include "sim/cpu/cpu.h"

#include <math.h>

static size_t rest_of(const Cpu *cpu, size_t i)
{
    return cpu->now.id[i] - BOUNDARY_ID;
}

/* Matter of overlapping solids counts once, for the first solid. */
static bool in_earlier_solid(const Cpu *cpu, int solid, const float x[3])
{
    const Constants *s = cpu->constants;
    for (int k = 0; k < solid; k++)
        if (solid_clearance(&s->solids[k], &cpu->solid[k].end, s->dimensions, x, 0) < 0)
            return true;
    return false;
}

static void place_one(Cpu *cpu, size_t i)
{
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const size_t b = rest_of(cpu, i);
    const int solid = s->boundary.solid[b];
    const SolidPose *pose = &cpu->solid[solid].end;
    float x[3], v[3];
    solid_to_box(pose, s->boundary.rest + 3 * b, x);
    solid_velocity_at(pose, x, v);
    if (!walls_contain(&s->walls, x) || in_earlier_solid(cpu, solid, x))
        x[0] = ASIDE; /* invisible to the fluid; beyond walls, the walls act */
    p->x[i] = x[0], p->y[i] = x[1], p->z[i] = x[2];
    p->vx[i] = v[0], p->vy[i] = v[1], p->vz[i] = v[2];
}

typedef struct Place {
    Cpu *cpu;
    bool which[SOLIDS_MAX];
} Place;

static void place_range(void *context, size_t begin, size_t end)
{
    const Place *place = context;
    Cpu *cpu = place->cpu;
    for (size_t k = begin; k < end; k++) {
        const size_t i = cpu->boundary_at[k];
        if (place->which[cpu->now.fluid[i] - FLUIDS_MAX])
            place_one(cpu, i);
    }
}

static void place_solids(const Place *place)
{
    Cpu *cpu = place->cpu;
    bool any = false;
    for (int k = 0; k < cpu->constants->solid_count; k++)
        any |= place->which[k];
    if (any)
        parallel_ranges(cpu->threads, cpu->constants->boundary.count, 4 * CPU_GRAIN, place_range,
                        (void *)place);
}

void cpu_boundary_move(Cpu *cpu, const SolidStep *steps)
{
    Place place = {.cpu = cpu};
    bool moves = false; /* true if the solid or an earlier solid moves, which may uncover particles of the
                           solid */
    for (int k = 0; k < cpu->constants->solid_count; k++) {
        cpu->solid[k] = steps[k];
        moves |= !steps[k].still;
        place.which[k] = moves;
    }
    place_solids(&place);
}

void cpu_boundary_append(Cpu *cpu)
{
    const Boundary *boundary = &cpu->constants->boundary;
    for (size_t b = 0; b < boundary->count; b++) {
        const size_t i = cpu->owned + b;
        cpu->now.id[i] = BOUNDARY_ID + b;
        cpu->now.fluid[i] = (uint8_t)(FLUIDS_MAX + boundary->solid[b]);
        cpu->boundary_at[b] = (uint32_t)i;
    }
    cpu->count = cpu->owned + boundary->count;
}

void cpu_pose(void *state, const SolidPose *pose)
{
    Cpu *cpu = state;
    Place place = {.cpu = cpu};
    for (int k = 0; k < cpu->constants->solid_count; k++) {
        cpu->solid[k] = (SolidStep){.begin = pose[k], .end = pose[k]};
        place.which[k] = true;
    }
    place_solids(&place);
}

void cpu_boundary_terms(Cpu *cpu, size_t i)
{
    columns_clear(&cpu->of_fluids, &cpu->now, i);
    if (cpu->now.kind)
        cpu->now.kind[i] = cpu->now.fluid[i];
}

/* Weighted sums over the fluid around a boundary particle. */
typedef struct Seen {
    float weight, pressure, viscosity, density_x[3], v[3];
} Seen;

static void see(const Cpu *cpu, const PairArgs *args, const float x[3], uint32_t j, Seen *seen)
{
    const Constants *s = cpu->constants;
    const float d[3] = {x[0] - args->x[j], x[1] - args->y[j], x[2] - args->z[j]};
    const float q2 = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / (s->support_radius * s->support_radius);
    const int fluid = cpu->now.fluid[j];
    if (q2 >= 1)
        return;
    const float w = (1 - q2) * (1 - q2) * (1 - q2), v[3] = {args->vx[j], args->vy[j], args->vz[j]};
    seen->weight += w;
    seen->pressure += w * cpu->now.pressure[j];
    seen->viscosity += w * s->viscosity[fluid];
    for (int k = 0; k < 3; k++) {
        seen->density_x[k] += w * s->density[fluid] * d[k];
        seen->v[k] += w * v[k];
    }
}

typedef struct BoundaryPass {
    Cpu *cpu;
    const ApparentGravity *gravity;
} BoundaryPass;

/* The rows of cells around `cell`, kept for the next boundary particle in the same cell. */
typedef struct Around {
    uint32_t cell;
    int count; /* of rows; 0: no cell yet */
    CellRow rows[CELL_ROWS];
} Around;

static void look_around(const PairArgs *args, uint32_t cell, Around *around)
{
    if (around->count > 0 && around->cell == cell)
        return;
    around->cell = cell;
    around->count = cell_rows(args->constants, args->fold, args->cell_start, cell, around->rows);
}

/* Adami, Hu, Adams, "A generalized wall boundary condition for smoothed particle hydrodynamics", 2012, eq.
   27 and 23: the fluid's pressure continues hydrostatically; with no slip, the fluid's velocity is mirrored
   at the wall's velocity. With slip the volume is 0, so that friction ignores the particle. */
static void fill_one(const BoundaryPass *pass, const PairArgs *args, Around *around, size_t i)
{
    Cpu *cpu = pass->cpu;
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const int solid = p->fluid[i] - FLUIDS_MAX;
    if (cpu->cell[i] == s->cells.count)
        return;
    const float x[3] = {p->x[i], p->y[i], p->z[i]}, volume = 1 / s->rest_number_density;
    const bool sticks = s->holds && s->solids[solid].slip == SLIP_NONE;
    Seen seen = {0};
    look_around(args, cpu->cell[i], around);
    for (const CellRow *row = around->rows; row < around->rows + around->count; row++) {
        const float *shift = row->shift, from[3] = {x[0] + shift[0], x[1] + shift[1], x[2] + shift[2]};
        for (uint32_t k = cpu->fluid_before[row->begin]; k < cpu->fluid_before[row->end]; k++)
            see(cpu, args, from, cpu->fluid_at[k], &seen);
    }
    float pressure = 0, g[3], a[3];
    if (seen.weight > 0) {
        apparent_gravity_at(pass->gravity, x, g);
        solid_acceleration_at(&cpu->solid[solid], x, a);
        for (int k = 0; k < 3; k++)
            pressure += (g[k] - a[k]) * seen.density_x[k];
        pressure = (seen.pressure + pressure) / seen.weight;
    }
    cpu->now.pressure[i] = s->negative_pressure ? pressure : fmaxf(pressure, 0);
    cpu->now.pressure_term[i] = cpu->now.pressure[i] * volume * volume;
    cpu->now.volume[i] = sticks && seen.weight > 0 ? volume : 0;
    cpu_boundary_terms(cpu, i);
    if (cpu->now.viscosity && seen.weight > 0)
        cpu->now.viscosity[i] = seen.viscosity / seen.weight;
    if (sticks && seen.weight > 0) {
        p->vx[i] = 2 * p->vx[i] - seen.v[0] / seen.weight;
        p->vy[i] = 2 * p->vy[i] - seen.v[1] / seen.weight;
        p->vz[i] = 2 * p->vz[i] - seen.v[2] / seen.weight;
    }
}

static void fill_range(void *context, size_t begin, size_t end)
{
    const BoundaryPass *pass = context;
    const PairArgs args = cpu_pair_args(pass->cpu);
    Around around = {.count = 0};
    for (size_t k = begin; k < end; k++)
        fill_one(pass, &args, &around, pass->cpu->boundary_at[k]);
}

void cpu_boundary_fill(Cpu *cpu, const ApparentGravity *gravity)
{
    BoundaryPass pass = {cpu, gravity};
    parallel_ranges(cpu->threads, cpu->constants->boundary.count, CPU_GRAIN, fill_range, &pass);
}

/* Restore the boundary particles' own velocities. */
static void restore_range(void *context, size_t begin, size_t end)
{
    const Place *place = context;
    const Cpu *cpu = place->cpu;
    const CpuParticles *p = &cpu->now;
    for (size_t k = begin; k < end; k++) {
        const size_t i = cpu->boundary_at[k];
        const int solid = p->fluid[i] - FLUIDS_MAX;
        const float x[3] = {p->x[i], p->y[i], p->z[i]};
        float v[3];
        if (!place->which[solid] || x[0] == ASIDE)
            continue;
        solid_velocity_at(&cpu->solid[solid].end, x, v);
        p->vx[i] = v[0], p->vy[i] = v[1], p->vz[i] = v[2];
    }
}

void cpu_boundary_restore(Cpu *cpu)
{
    const Constants *s = cpu->constants;
    Place place = {.cpu = cpu};
    bool any = false;
    for (int k = 0; k < s->solid_count; k++)
        any |= place.which[k] = s->holds && s->solids[k].slip == SLIP_NONE;
    if (any)
        parallel_ranges(cpu->threads, s->boundary.count, 4 * CPU_GRAIN, restore_range, &place);
}

bool cpu_guard_solids(const Cpu *cpu, const SolidStep *steps, const float before[3], float x[3], float v[3])
{
    const Constants *s = cpu->constants;
    WayBounds way = way_bounds(before, x);
    bool held = false;
    for (int k = 0; k < s->solid_count; k++) {
        if (solid_step_beside(&steps[k], s->dimensions, &way) ||
            !solid_guard(&s->solids[k], &steps[k], s->dimensions, before, x, v))
            continue;
        held = true;
        way = way_bounds(before, x);
    }
    return held;
}
