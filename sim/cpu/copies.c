/* What stands across a periodic side. The grid's outermost cells lie outside of the box: along a periodic
   axis each shows a cell of the other side, and its particles stand there once more, a size of the box
   further. Lists of neighbours have these copies, so that pair sums know nothing of sides. */
#include "sim/cpu/pass.h"

#include <string.h>

/* The cell that an outermost cell shows, with the copies' shift in sizes of the box; false: it shows none. */
static bool shown_cell(const Constants *s, int at[3], int sides[3])
{
    bool shows = false;
    for (int k = 0; k < 3; k++) {
        const int last = s->cells.size[k] - 1;
        sides[k] = 0;
        if (!s->periodic.axis[k] || (at[k] > 0 && at[k] < last))
            continue;
        sides[k] = at[k] == 0 ? -1 : 1;
        at[k] = at[k] == 0 ? last - 1 : 1;
        shows = true;
    }
    return shows;
}

static size_t cell_index(const Constants *s, const int at[3])
{
    const int *size = s->cells.size;
    return ((size_t)at[2] * (size_t)size[1] + (size_t)at[1]) * (size_t)size[0] + (size_t)at[0];
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

/* Behind the counts of cells: where the copies of each cell begin; how many there are. */
static size_t count_copies(Cpu *cpu)
{
    const Constants *s = cpu->constants;
    const int *size = s->cells.size;
    uint32_t count = 0;
    size_t cell = 0;
    for (int z = 0; z < size[2]; z++)
        for (int y = 0; y < size[1]; y++)
            for (int x = 0; x < size[0]; x++, cell++) {
                int at[3] = {x, y, z}, sides[3];
                cpu->copy_start[cell] = count;
                if (!shown_cell(s, at, sides))
                    continue;
                const size_t from = cell_index(s, at);
                count += cpu->cell_start[from + 1] - cpu->cell_start[from];
            }
    cpu->copy_start[cell] = count;
    return count;
}

bool cpu_copies_fit(Cpu *cpu)
{
    cpu->copies = count_copies(cpu);
    return cpu->copies <= cpu->copy_room;
}

void cpu_copies_drop(Cpu *cpu)
{
    memset(cpu->copy_start, 0, (cpu->constants->cells.count + 1) * sizeof *cpu->copy_start);
    cpu->copies = 0;
    cpu->watch.memory = true;
}

static void place_cell(Cpu *cpu, size_t cell, int at[3], const int sides[3])
{
    const size_t from = cpu->cell_start[cell_index(cpu->constants, at)];
    const uint8_t code = side_code(sides);
    for (uint32_t k = cpu->copy_start[cell]; k < cpu->copy_start[cell + 1]; k++) {
        cpu->copy_of[cpu->count + k] = (uint32_t)(from + k - cpu->copy_start[cell]);
        cpu->copy_side[k] = code;
    }
}

/* Columns whose names stand in one of the lists. */
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
    const Constants *s = cpu->constants;
    const int *size = s->cells.size;
    size_t cell = 0;
    for (int z = 0; z < size[2]; z++)
        for (int y = 0; y < size[1]; y++)
            for (int x = 0; x < size[0]; x++, cell++) {
                int at[3] = {x, y, z}, sides[3];
                if (cpu->copy_start[cell + 1] > cpu->copy_start[cell] && shown_cell(s, at, sides))
                    place_cell(cpu, cell, at, sides);
            }
    const ColumnRows rows = rows_among(cpu, "position id fluid viscosity tension kind", "");
    copies_of_rows(cpu, &rows);
    parallel_ranges(cpu->threads, cpu->copies, 4 * CPU_GRAIN, shift_places, cpu);
}

void cpu_copies_update(Cpu *cpu, const Pass *pass)
{
    const ColumnRows rows = rows_among(cpu, pass->reads, pass->writes);
    ColumnRows wanted = {0};
    for (int r = 0; r < rows.count;
         r++) /* not what the grid has placed, nor what only the particle itself reads */
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
