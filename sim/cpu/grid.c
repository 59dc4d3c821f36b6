/* Counting sort by places of the cell fold (sim/step/backend.h). Atomic counters hand out the places
   within a cell in any order; a sort by cell and id follows. So the result depends on positions and ids
   only, not on threads or history. */
#include "sim/cpu/cpu.h"

#include "sim/base/base.h"
#include "sim/cpu/lanes.h"
#include "sim/world.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct CellMap {
    float origin[3], inverse[3], first[3], last[3]; /* cells inside the border */
    int size[3];
} CellMap;

static CellMap cell_map(const Constants *constants)
{
    const CellGrid *cells = &constants->cells;
    CellMap map;
    for (int k = 0; k < 3; k++) {
        map.origin[k] = cells->origin[k];
        map.inverse[k] = cells->inverse[k];
        map.first[k] = (float)(cells->first[k] + 1);
        map.last[k] = (float)(cells->first[k] + cells->size[k] - 2);
        map.size[k] = cells->size[k];
    }
    return map;
}

/* The cells along axis k, clamped, so that a non-finite position does no harm before the report. */
static inline i4 cell_along(const CellMap *map, int k, f4 x)
{
    const f4 first = f4_splat(map->first[k]), last = f4_splat(map->last[k]);
    const f4 held =
        f4_lesser(f4_greater((x - f4_splat(map->origin[k])) * f4_splat(map->inverse[k]), first), last);
    const i4 towards_zero = __builtin_convertvector(held, i4),
             whole = towards_zero + (__builtin_convertvector(towards_zero, f4) > held);
    return whole - ((int)map->first[k] - 1);
}

static inline u4 cell_at(const CellMap *map, f4 x, f4 y, f4 z)
{
    const u4 ix = (u4)cell_along(map, 0, x), iy = (u4)cell_along(map, 1, y), iz = (u4)cell_along(map, 2, z);
    return (iz * (uint32_t)map->size[1] + iy) * (uint32_t)map->size[0] + ix;
}

uint32_t cpu_cell_of(const Constants *constants, const float x[3])
{
    const CellMap map = cell_map(constants);
    return cell_at(&map, f4_splat(x[0]), f4_splat(x[1]), f4_splat(x[2]))[0];
}

/* Particles in sequence mostly share a cell: an atomic per run, not per particle. */
static void take_places(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    const uint32_t *cell = cpu->spare_cell;
    for (size_t i = begin, stop; i < end; i = stop) {
        for (stop = i + 1; stop < end && cell[stop] == cell[i];)
            stop++;
        const uint32_t place = cell_fold_of(&cpu->fold, &cpu->constants->cells, cell[i]);
        uint32_t rank =
            __atomic_fetch_add(&cpu->cell_start[place + 1], (uint32_t)(stop - i), __ATOMIC_RELAXED);
        for (size_t k = i; k < stop; k++)
            cpu->rank[k] = rank++;
        for (size_t k = i; cpu->fold.shared && k < stop; k++)
            cpu->cell[k] = place;
    }
}

static void find_cells(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    const CellMap map = cell_map(cpu->constants);
    const CpuParticles *p = &cpu->now;
    for (size_t i = begin; i < end; i += FOUR)
        four_put(cpu->spare_cell, i, end,
                 (f4)cell_at(&map, f4_load(p->x, i), f4_load(p->y, i), f4_load(p->z, i)));
    for (size_t i = begin; cpu->boundary_at && i < end; i++)
        if (p->x[i] == ASIDE) /* in an extra cell that is never read */
            cpu->spare_cell[i] = (uint32_t)cpu->constants->cells.count;
}

static void place_particles(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    const uint32_t *place = cpu->fold.shared ? cpu->cell : cpu->spare_cell;
    for (size_t i = begin; i < end; i++)
        cpu->order[cpu->cell_start[place[i]] + cpu->rank[i]] = (uint32_t)i;
}

/* Insertion sort by id, since a cell holds some ten particles, mostly in order. `cell`: given if cells
   share a place; sorts by cell first, so that each cell's particles are contiguous. */
static inline void sort_place(uint32_t *order, size_t count, const ParticleId *id, const uint32_t *cell)
{
    for (size_t i = 1; i < count; i++) {
        const uint32_t moved = order[i];
        size_t j = i;
        for (; j > 0; j--) {
            const uint32_t before = order[j - 1];
            if (cell && cell[before] != cell[moved] ? cell[before] < cell[moved] : id[before] <= id[moved])
                break;
            order[j] = before;
        }
        order[j] = moved;
    }
}

static void sort_places(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    for (size_t place = begin; place < end; place++) {
        const uint32_t first = cpu->cell_start[place], count = cpu->cell_start[place + 1] - first;
        if (cpu->fold.shared)
            sort_place(cpu->order + first, count, cpu->now.id, cpu->spare_cell);
        else
            sort_place(cpu->order + first, count, cpu->now.id, NULL);
    }
}

static void move_particles(void *state, size_t begin, size_t end)
{
    Cpu *cpu = state;
    for (size_t i = begin; i < end; i++)
        cpu->cell[i] = cpu->spare_cell[cpu->order[i]];
    for (size_t i = begin; cpu->foreign && i < end; i++)
        cpu->ghost[i] = cpu->foreign[cpu->cell[i]];
    columns_copy(&cpu->sorted, &cpu->now, &cpu->spare, cpu->order, begin, end);
}

void cpu_cells(Cpu *cpu)
{
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, find_cells, cpu);
}

static void count_cells(Cpu *cpu)
{
    const size_t places = cpu->fold.count;
    memset(cpu->cell_start, 0, (places + 2) * sizeof *cpu->cell_start);
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, take_places, cpu);
    for (size_t place = 0; place <= places; place++)
        cpu->cell_start[place + 1] += cpu->cell_start[place];
}

void cpu_sort(Cpu *cpu)
{
    count_cells(cpu);
    if (cpu->copy_start && !cpu_copies_fit(cpu)) {
        if (cpu_copies_grow(cpu)) {
            cpu_cells(cpu);
            count_cells(cpu);
            cpu_copies_fit(cpu);
        } else {
            cpu_copies_drop(cpu);
        }
    }
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, place_particles, cpu);
    parallel_ranges(cpu->threads, cpu->fold.count, 4 * CPU_GRAIN, sort_places, cpu);
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, move_particles, cpu);

    columns_swap(&cpu->sorted, &cpu->now, &cpu->spare);
    cpu->gridded = cpu->count;
    cpu->lists.ready = false;
    cpu->thin = false;
    if (cpu->copies > 0)
        cpu_copies_place(cpu);
    if (cpu->owned_at)
        cpu_find(cpu);
}

void cpu_grid(void *state)
{
    cpu_cells(state);
    cpu_sort(state);
}
