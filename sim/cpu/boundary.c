/* Copies of particles across periodic sides. The outermost grid cells are outside of the box. Along a
   periodic axis each outermost cell shows a cell of the opposite side: copies of its particles, shifted by
   the box size. Neighbour lists contain the copies, so pair sums need no code for periodic sides. */
#include "sim/cpu/cpu.h"

#include <math.h>
#include <string.h>

/* Positions of the copies of a box cell: across a periodic side, or across several sides in a corner. */
typedef struct PeriodicCopies {
    int count;
    uint32_t place[7]; /* places of the fold for outermost cells */
    int sides[7][3];   /* crossed sides: the copies' shift in box sizes */
} PeriodicCopies;

/* Moves a cell across the sides of the axes set in `axes`; false if the cell is not next to each of these
   sides. */
static bool cross(const Constants *s, int axes, int at[3], int sides[3])
{
    for (int k = 0; k < 3; k++) {
        const int last = s->cells.size[k] - 1;
        sides[k] = 0;
        if (!(axes >> k & 1))
            continue;
        if (!s->periodic.axis[k] || (at[k] > 1 && at[k] < last - 1))
            return false;
        sides[k] = at[k] == 1 ? 1 : -1;
        at[k] = at[k] == 1 ? last : 0;
    }
    return true;
}

static void shown(const Cpu *cpu, uint32_t cell, PeriodicCopies *out)
{
    const int *size = cpu->constants->cells.size;
    const uint32_t width = (uint32_t)size[0], height = (uint32_t)size[1];
    out->count = 0;
    for (int axes = 1; axes < 8 && cell < cpu->constants->cells.count; axes++) {
        int at[3] = {(int)(cell % width), (int)(cell / width % height), (int)(cell / width / height)};
        if (cross(cpu->constants, axes, at, out->sides[out->count]))
            out->place[out->count++] =
                cell_fold_at(&cpu->fold, (uint32_t)at[0], (uint32_t)at[1], (uint32_t)at[2]);
    }
}

static uint8_t side_code(const int sides[3])
{
    return (uint8_t)(sides[0] + 1 + 3 * (sides[1] + 1) + 9 * (sides[2] + 1));
}

static void shift_of(const Constants *s, uint8_t code, float shift[3])
{
    for (int k = 0; k < 3; k++, code /= 3)
        shift[k] = (float)(code % 3 - 1) * (s->periodic.axis[k] ? s->periodic.size[k] : 0);
}

/* Call after cpu_cells, before the sort. Writes the begin of the copies of each place, shifted by an entry
   until placement. Returns the number of copies. */
static size_t count_copies(Cpu *cpu)
{
    const size_t places = cpu->fold.count;
    const uint32_t *cell = cpu->spare_cell;
    uint32_t *start = cpu->copy_start;
    PeriodicCopies across;
    memset(start, 0, (places + 2) * sizeof *start);
    for (size_t i = 0, stop; i < cpu->count; i = stop) {
        for (stop = i + 1; stop < cpu->count && cell[stop] == cell[i];)
            stop++;
        shown(cpu, cell[i], &across);
        for (int k = 0; k < across.count; k++)
            start[across.place[k] + 2] += (uint32_t)(stop - i);
    }
    for (size_t place = 1; place <= places; place++)
        start[place + 1] += start[place];
    return start[places + 1];
}

bool cpu_copies_fit(Cpu *cpu)
{
    cpu->copies = count_copies(cpu);
    return cpu->copies <= cpu->copy_capacity;
}

void cpu_copies_drop(Cpu *cpu)
{
    memset(cpu->copy_start, 0, (cpu->fold.count + 2) * sizeof *cpu->copy_start);
    cpu->copies = 0;
    cpu->watch.memory = true;
}

/* Places the copies in the order of the originals. */
static void place_copies(Cpu *cpu)
{
    PeriodicCopies across = {.count = 0};
    uint32_t last = UINT32_MAX;
    for (size_t i = 0; i < cpu->count; i++) {
        if (cpu->cell[i] != last)
            shown(cpu, last = cpu->cell[i], &across);
        for (int k = 0; k < across.count; k++) {
            const uint32_t copy = cpu->copy_start[across.place[k] + 1]++;
            cpu->copy_of[cpu->count + copy] = (uint32_t)i;
            cpu->copy_side[copy] = side_code(across.sides[k]);
        }
    }
}

/* Columns named in either list. */
static ColumnRows rows_among(const Cpu *cpu, const char *list, const char *other)
{
    ColumnRows rows = {0};
    for (int r = 0; r < cpu->all.count; r++)
        if (cpu_name_among(list, cpu->all.row[r]->name) || cpu_name_among(other, cpu->all.row[r]->name))
            rows.row[rows.count++] = cpu->all.row[r];
    return rows;
}

typedef struct ColumnCopyJob {
    Cpu *cpu;
    const ColumnRows *rows;
} ColumnCopyJob;

static void copy_rows(void *state, size_t begin, size_t end)
{
    const ColumnCopyJob *copying = state;
    const Cpu *cpu = copying->cpu;
    columns_copy(copying->rows, &cpu->now, &cpu->now, cpu->copy_of, cpu->count + begin, cpu->count + end);
}

static void shift_places(void *state, size_t begin, size_t end)
{
    const Cpu *cpu = state;
    for (size_t k = begin, i = cpu->count + begin; k < end; k++, i++) {
        float shift[3];
        shift_of(cpu->constants, cpu->copy_side[k], shift);
        cpu->now.x[i] += shift[0];
        cpu->now.y[i] += shift[1];
        cpu->now.z[i] += shift[2];
    }
}

static void copies_of_rows(Cpu *cpu, const ColumnRows *rows)
{
    ColumnCopyJob copying = {cpu, rows};
    parallel_ranges(cpu->threads, cpu->copies, 4 * CPU_GRAIN, copy_rows, &copying);
}

void cpu_copies_place(Cpu *cpu)
{
    place_copies(cpu);
    const ColumnRows rows = rows_among(cpu, "position id fluid viscosity tension kind", "");
    copies_of_rows(cpu, &rows);
    parallel_ranges(cpu->threads, cpu->copies, 4 * CPU_GRAIN, shift_places, cpu);
}

void cpu_copies_update(Cpu *cpu, const Pass *pass)
{
    const ColumnRows rows = rows_among(cpu, pass->reads, pass->writes);
    ColumnRows wanted = {0};
    for (int r = 0; r < rows.count;
         r++) /* without columns placed by the grid or read of the particle alone */
        if (!cpu_name_among("position id fluid remainder", rows.row[r]->name))
            wanted.row[wanted.count++] = rows.row[r];
    copies_of_rows(cpu, &wanted);
}

static void copy_packed(void *state, size_t begin, size_t end)
{
    const Cpu *cpu = state;
    for (size_t k = begin, i = cpu->count + begin; k < end; k++, i++) {
        float shift[3];
        const uint32_t from = cpu->copy_of[i];
        shift_of(cpu->constants, cpu->copy_side[k], shift);
        for (int a = 0; a < 3; a++)
            cpu->place[i][a] = cpu->place[from][a] + shift[a];
        cpu->place[i][3] = cpu->place[from][3];
        memcpy(cpu->motion[i], cpu->motion[from], sizeof cpu->motion[i]);
    }
}

void cpu_copies_pack(Cpu *cpu)
{
    parallel_ranges(cpu->threads, cpu->copies, 4 * CPU_GRAIN, copy_packed, cpu);
}

/* Boundary particles: they move with the solids and take their values from the fluid around. */

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

typedef struct BoundaryPoseJob {
    Cpu *cpu;
    bool which[SOLIDS_MAX];
} BoundaryPoseJob;

static void place_range(void *context, size_t begin, size_t end)
{
    const BoundaryPoseJob *place = context;
    Cpu *cpu = place->cpu;
    for (size_t k = begin; k < end; k++) {
        const size_t i = cpu->boundary_at[k];
        if (place->which[cpu->now.fluid[i] - FLUIDS_MAX])
            place_one(cpu, i);
    }
}

static void place_solids(const BoundaryPoseJob *place)
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
    BoundaryPoseJob place = {.cpu = cpu};
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
    BoundaryPoseJob place = {.cpu = cpu};
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
typedef struct FluidSums {
    float weight, pressure, viscosity, density_x[3], v[3];
} FluidSums;

static void see(const Cpu *cpu, const PairArgs *args, const float x[3], uint32_t j, FluidSums *seen)
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
typedef struct CellRowList {
    uint32_t cell;
    int count; /* of rows; 0: no cell yet */
    CellRow rows[CELL_ROWS];
} CellRowList;

static void look_around(const PairArgs *args, uint32_t cell, CellRowList *around)
{
    if (around->count > 0 && around->cell == cell)
        return;
    around->cell = cell;
    around->count = cell_rows(args->constants, args->fold, args->cell_start, cell, around->rows);
}

/* Adami, Hu, Adams, "A generalized wall boundary condition for smoothed particle hydrodynamics", 2012, eq.
   27 and 23: the fluid's pressure continues hydrostatically; with no slip, the fluid's velocity is mirrored
   at the wall's velocity. With slip the volume is 0, so that friction ignores the particle. */
static void fill_one(const BoundaryPass *pass, const PairArgs *args, CellRowList *around, size_t i)
{
    Cpu *cpu = pass->cpu;
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const int solid = p->fluid[i] - FLUIDS_MAX;
    if (cpu->cell[i] == s->cells.count)
        return;
    const float x[3] = {p->x[i], p->y[i], p->z[i]}, volume = 1 / s->rest_number_density;
    const bool sticks = s->holds && s->solids[solid].slip == SLIP_NONE;
    FluidSums seen = {0};
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
    CellRowList around = {.count = 0};
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
    const BoundaryPoseJob *place = context;
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
    BoundaryPoseJob place = {.cpu = cpu};
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
