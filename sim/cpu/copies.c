/* Copies of particles across periodic sides. The outermost grid cells are outside of the box. Along a
   periodic axis each outermost cell shows a cell of the opposite side: copies of its particles, shifted by
   the box size. Neighbour lists contain the copies, so pair sums need no code for periodic sides. */
#include "sim/cpu/pass.h"

#include <string.h>

/* Positions of the copies of a box cell: across a periodic side, or across several sides in a corner. */
typedef struct Shown {
    int count;
    uint32_t place[7]; /* places of the fold for outermost cells */
    int sides[7][3];   /* crossed sides: the copies' shift in box sizes */
} Shown;

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

static void shown(const Cpu *cpu, uint32_t cell, Shown *out)
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
    Shown across;
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
    return cpu->copies <= cpu->copy_room;
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
    Shown across = {.count = 0};
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

typedef struct Copying {
    Cpu *cpu;
    const ColumnRows *rows;
} Copying;

static void copy_rows(void *state, size_t begin, size_t end)
{
    const Copying *copying = state;
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
    Copying copying = {cpu, rows};
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
