/* Sums over a column: per cell in double, then exact over cells. So the bits depend neither on threads nor
   on ranks. */
#include "sim/cpu/cpu.h"

typedef struct ExcessPass {
    Cpu *cpu;
    const float *column;
    ExactSum *sum;
    float most;
} ExcessPass;

static void add_part(ExcessPass *pass, const ExactSum *sum, float most)
{
    parallel_lock();
    exact_merge(pass->sum, sum);
    pass->most = most > pass->most ? most : pass->most;
    parallel_unlock();
}

static void excess_range(void *context, size_t begin, size_t end)
{
    ExcessPass *pass = context;
    ExactSum sum = {.strange = false};
    float most = 0;
    const size_t last = cpu_cell_first(pass->cpu, end);
    for (size_t k = cpu_cell_first(pass->cpu, begin); k < last;) {
        double of_cell = 0;
        do {
            const float value = pass->column[cpu_owned(pass->cpu, k)];
            of_cell += value < 0 ? 0 : (double)value; /* NaN stays */
            most = value > most ? value : most;
        } while (++k < last && cpu_cell_goes_on(pass->cpu, k));
        exact_add(&sum, of_cell);
    }
    add_part(pass, &sum, most);
}

float cpu_excess_part(Cpu *cpu, const ColumnDef *column, ExactSum *sum)
{
    ExcessPass pass = {cpu, *column_array(&cpu->now, column, 0), sum, 0};
    parallel_ranges(cpu->threads, cpu->owned, 8 * CPU_GRAIN, excess_range, &pass);
    return pass.most;
}

Excess cpu_excess(void *state, const ColumnDef *column)
{
    Cpu *cpu = state;
    ExactSum sum = {.strange = false};
    const float most = cpu_excess_part(cpu, column, &sum);
    return (Excess){.mean = exact_value(&sum) / (cpu->owned > 0 ? (double)cpu->owned : 1), .greatest = most};
}

static void sum_range(void *context, size_t begin, size_t end)
{
    ExcessPass *pass = context;
    ExactSum sum = {.strange = false};
    const size_t last = cpu_cell_first(pass->cpu, end);
    for (size_t k = cpu_cell_first(pass->cpu, begin); k < last;) {
        double of_cell = 0;
        do
            of_cell += (double)pass->column[cpu_owned(pass->cpu, k)];
        while (++k < last && cpu_cell_goes_on(pass->cpu, k));
        exact_add(&sum, of_cell);
    }
    add_part(pass, &sum, 0);
}

void cpu_sum_part(Cpu *cpu, const ColumnDef *column, ExactSum *sum)
{
    ExcessPass pass = {cpu, *column_array(&cpu->now, column, 0), sum, 0};
    parallel_ranges(cpu->threads, cpu->owned, 8 * CPU_GRAIN, sum_range, &pass);
}

double cpu_sum(void *state, const ColumnDef *column)
{
    ExactSum sum = {.strange = false};
    cpu_sum_part(state, column, &sum);
    return exact_value(&sum);
}
