/* The memory of the backend: columns, arrays of the grid, neighbour lists; and how pair sums see them. */
#include "sim/cpu/cpu.h"
#include "sim/cpu/pairs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- neighbour lists ---- */

/* Expected rows of a group whose particles have `neighbours` neighbours on average. */
static double rows_expected(double neighbours)
{
    return 1.2 * neighbours + 8;
}

static bool fit(ListMemory *memory, size_t indices)
{
    if (indices > UINT32_MAX)
        return false;
    uint32_t *index = aligned_alloc(64, (indices * sizeof *index + 63) / 64 * 64);
    if (!index)
        return false;
    if (memory->index)
        memcpy(index, memory->index, memory->capacity * sizeof *index);
    free(memory->index);
    *memory = (ListMemory){index, (uint32_t)indices};
    return true;
}

/* Makes room for lists of `particles` particles with about `neighbours` neighbours each. Returns false if
   memory is short. */
static bool lists_create(NeighbourLists *lists, size_t particles, double neighbours)
{
    lists->ranges = particles / LISTS_GRAIN + 1;
    const size_t groups = particles / LANES + 1;
    lists->of_range = calloc(lists->ranges, sizeof *lists->of_range);
    lists->found = calloc(lists->ranges, sizeof *lists->found);
    lists->of_images = calloc(lists->ranges, sizeof *lists->of_images);
    lists->first = calloc(groups, sizeof *lists->first);
    lists->rows = calloc(groups, sizeof *lists->rows);
    lists->images = calloc(groups, sizeof *lists->images);
    bool ok =
        lists->of_range && lists->found && lists->of_images && lists->first && lists->rows && lists->images;
    for (size_t r = 0; ok && r < lists->ranges; r++) {
        const size_t left = particles - r * LISTS_GRAIN, in_range = left < LISTS_GRAIN ? left : LISTS_GRAIN;
        ok = fit(&lists->of_range[r], (size_t)((double)in_range * rows_expected(neighbours)) + LANES * LANES);
    }
    return ok;
}

static void free_ranges(ListMemory *of_range, size_t ranges)
{
    for (size_t r = 0; of_range && r < ranges; r++)
        free(of_range[r].index);
    free(of_range);
}

static void lists_destroy(NeighbourLists *lists)
{
    free_ranges(lists->of_range, lists->ranges);
    free_ranges(lists->found, lists->ranges);
    free_ranges(lists->of_images, lists->ranges);
    free(lists->first);
    free(lists->rows);
    free(lists->images);
}

size_t neighbour_lists_bytes(const NeighbourLists *lists)
{
    size_t indices = 3 * lists->ranges * (LISTS_GRAIN / LANES);
    for (size_t r = 0; r < lists->ranges; r++)
        indices +=
            (size_t)lists->of_range[r].capacity + lists->found[r].capacity + lists->of_images[r].capacity;
    return indices * sizeof(uint32_t);
}

bool neighbour_lists_fit(NeighbourLists *lists, ListMemory *memory, size_t indices)
{
    if (indices <= memory->capacity || fit(memory, indices + indices / 2))
        return true;
    __atomic_store_n(&lists->full, true, __ATOMIC_RELAXED);
    return false;
}

/* ---- columns and arrays ---- */

/* Zeroed memory aligned to a cache line, with room for lanes past the end. */
static void *array(Cpu *cpu, size_t count, size_t size)
{
    const size_t bytes = ((count + LANES) * size + 63) / 64 * 64;
    void *memory = aligned_alloc(64, bytes);
    if (memory)
        memset(memory, 0, bytes);
    cpu->bytes += bytes;
    return memory;
}

void cpu_arrays_destroy(Cpu *cpu)
{
    cpu_coarse_destroy(cpu->coarse);
    columns_destroy(&cpu->now);
    columns_destroy(&cpu->spare);
    if (cpu->fluid_at != cpu->owned_at)
        free(cpu->fluid_at);
    void *const all[] = {cpu->cell,     cpu->spare_cell,  cpu->rank,         cpu->order,     cpu->cell_start,
                         cpu->owned_at, cpu->boundary_at, cpu->fluid_before, cpu->partial,   cpu->place,
                         cpu->motion,   cpu->ghost,       cpu->copy_of,      cpu->copy_side, cpu->copy_start};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        free(all[k]);
    lists_destroy(&cpu->lists);
}

bool cpu_columns_fit(Cpu *cpu)
{
    const ColumnDef *own = cpu->constants->method->columns;
    cpu->all = column_rows(own, 0, cpu->constants);
    cpu->saved = column_rows(own, COLUMN_SAVED, cpu->constants);
    cpu->sorted = column_rows(own, COLUMN_SORTED, cpu->constants);
    cpu->of_fluids = column_rows(own, COLUMN_FLUIDS, NULL);
    const size_t capacity = cpu->capacity + cpu->copy_capacity;
    return columns_create(&cpu->now, &cpu->all, capacity, &cpu->bytes) &&
           columns_create(&cpu->spare, &cpu->sorted, capacity, &cpu->bytes);
}

/* Number of neighbours of a particle on a lattice at the spacing. */
static double neighbours_expected(const Constants *s)
{
    const double reach = (double)s->support_radius / (double)s->spacing;
    return s->dimensions == 2 ? M_PI * reach * reach : 4.0 / 3 * M_PI * reach * reach * reach;
}

bool cpu_arrays_create(Cpu *cpu, Error *error)
{
    const Constants *s = cpu->constants;
    uint32_t **const integers[] = {&cpu->cell, &cpu->spare_cell, &cpu->rank, &cpu->order};
    bool ok = cpu_columns_fit(cpu);
    cpu->fold = cell_fold(s, cpu->capacity);
    for (size_t k = 0; k < sizeof integers / sizeof *integers; k++)
        ok &= (*integers[k] = array(cpu, cpu->capacity, sizeof(uint32_t))) != NULL;
    ok &= (cpu->partial = array(cpu, cpu->capacity / CPU_GRAIN + 1, sizeof *cpu->partial)) != NULL;
    const size_t read = cpu->capacity + cpu->copy_capacity + 1;
    ok &= (cpu->place = array(cpu, read, sizeof *cpu->place)) != NULL;
    ok &= (cpu->motion = array(cpu, read, sizeof *cpu->motion)) != NULL;
    if (s->periodic.any) {
        ok &= (cpu->copy_of = array(cpu, read, sizeof *cpu->copy_of)) != NULL;
        ok &= (cpu->copy_side = array(cpu, cpu->copy_capacity, sizeof *cpu->copy_side)) != NULL;
        ok &= (cpu->copy_start = array(cpu, cpu->fold.count + 2, sizeof *cpu->copy_start)) != NULL;
    }
    ok &= lists_create(&cpu->lists, cpu->capacity, neighbours_expected(s));
    if (s->boundary.count > 0 || cpu->foreign) {
        ok &= (cpu->owned_at = array(cpu, cpu->capacity, sizeof(uint32_t))) != NULL;
        ok &= (cpu->fluid_before = array(cpu, cpu->capacity + 1, sizeof(uint32_t))) != NULL;
        cpu->fluid_at = cpu->owned_at;
    }
    if (s->boundary.count > 0)
        ok &= (cpu->boundary_at = array(cpu, s->boundary.count, sizeof(uint32_t))) != NULL;
    if (cpu->foreign) {
        ok &= (cpu->ghost = array(cpu, cpu->capacity, sizeof *cpu->ghost)) != NULL;
        ok &= (cpu->fluid_at = array(cpu, cpu->capacity, sizeof(uint32_t))) != NULL;
    }
    ok &= (cpu->cell_start = array(cpu, cpu->fold.count + 2, sizeof(uint32_t))) != NULL;
    return ok || error_set(error,
                           "no memory for %zu particles and %zu cells; use a larger spacing or a smaller box",
                           cpu->capacity - s->boundary.count, cpu->fold.count);
}

void cpu_find(Cpu *cpu)
{
    const bool ghosts = cpu->ghost;
    size_t owned = 0, fluid = 0, boundary = 0;
    for (size_t i = 0; i < cpu->count; i++) {
        cpu->fluid_before[i] = (uint32_t)fluid;
        if (cpu->now.fluid[i] >= FLUIDS_MAX) {
            cpu->boundary_at[boundary++] = (uint32_t)i;
            continue;
        }
        cpu->fluid_at[fluid++] = (uint32_t)i;
        if (ghosts && !cpu->ghost[i])
            cpu->owned_at[owned++] = (uint32_t)i;
    }
    cpu->fluid_before[cpu->count] = (uint32_t)fluid;
}

/* A copy of the state without arrays. */
static Cpu bare(const Cpu *cpu)
{
    return (Cpu){
        .constants = cpu->constants,
        .pairs = cpu->pairs,
        .threads = cpu->threads,
        .count = cpu->count,
        .owned = cpu->owned,
        .capacity = cpu->capacity,
        .copy_capacity = cpu->copy_capacity,
        .foreign = cpu->foreign,
        .gauge = cpu->gauge,
        .guarded = cpu->guarded,
        .forces = cpu->forces,
        .force_sums = cpu->force_sums,
        .sum_all = cpu->sum_all,
        .add_all = cpu->add_all,
        .watch = cpu->watch,
    };
}

/* Moves the state into new arrays sized by `to`. False if memory is short, with nothing changed. */
static bool move_into(Cpu *cpu, Cpu *to)
{
    Error none;
    if (!cpu_arrays_create(to, &none)) {
        cpu_arrays_destroy(to);
        return false;
    }
    columns_copy(&cpu->sorted, &cpu->now, &to->now, NULL, 0, cpu->count);
    memcpy(to->solid, cpu->solid, sizeof to->solid);
    cpu_arrays_destroy(cpu);
    *cpu = *to;
    if (cpu->owned_at)
        cpu_find(cpu);
    return true;
}

bool cpu_share(Cpu *cpu, const uint8_t *foreign)
{
    Cpu to = bare(cpu);
    to.foreign = foreign;
    return move_into(cpu, &to);
}

bool cpu_copies_grow(Cpu *cpu)
{
    Cpu to = bare(cpu);
    to.copy_capacity = cpu->copies + cpu->copies / 4 + CPU_GRAIN;
    return move_into(cpu, &to);
}

bool cpu_grow(Cpu *cpu, size_t capacity)
{
    Cpu to = bare(cpu);
    to.capacity = capacity;
    return move_into(cpu, &to);
}

PairArgs cpu_pair_args(Cpu *cpu)
{
    const CpuParticles *p = &cpu->now;
    PairArgs args = {
        .constants = cpu->constants,
        .count = cpu->count,
        .none = (uint32_t)(cpu->count + cpu->copies),
        .fold = &cpu->fold,
        .cell_start = cpu->cell_start,
        .copy_start = cpu->copy_start,
        .cell = cpu->cell,
        .foreign = cpu->foreign,
        .id = p->id,
        .fluid = p->fluid,
        .x = p->x,
        .y = p->y,
        .z = p->z,
        .vx = p->vx,
        .vy = p->vy,
        .vz = p->vz,
        .place = cpu->place,
        .motion = cpu->motion,
        .lists = &cpu->lists,
        .volume = p->volume,
        .pressure_term = p->pressure_term,
        .viscosity = p->viscosity,
        .kind = p->kind,
        .tension = p->tension,
        .number_density = p->volume,
        .fx = p->ax,
        .fy = p->ay,
        .fz = p->az,
        .term = p->term,
    };
    memcpy(args.own, p->own, sizeof args.own);
    return args;
}

bool cpu_name_among(const char *list, const char *name)
{
    const size_t size = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += size)
        if ((at == list || at[-1] == ' ') && (at[size] == ' ' || at[size] == 0))
            return true;
    return false;
}
