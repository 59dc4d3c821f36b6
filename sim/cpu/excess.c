/* Sums over a column: a partial sum a range, and these in their order, so that no thread count changes a bit.
 */
#include "sim/cpu/cpu.h"

typedef struct ExcessPass {
    Cpu *cpu;
    const float *column;
} ExcessPass;

static void excess_range(void *context, size_t begin, size_t end)
{
    const ExcessPass *pass = context;
    WorldSums *part = &pass->cpu->partial[begin / CPU_GRAIN];
    double sum = 0;
    float most = 0;
    for (size_t k = begin; k < end; k++) {
        const float value = pass->column[cpu_owned(pass->cpu, k)];
        sum += value < 0 ? 0 : (double)value; /* NaN stays */
        most = value > most ? value : most;
    }
    part->mass = sum;
    part->max_speed = (double)most;
}

Excess cpu_excess(void *state, const ColumnDef *column)
{
    Cpu *cpu = state;
    ExcessPass pass = {cpu, *column_array(&cpu->now, column, 0)};
    Excess all = {0};
    parallel_ranges(cpu->threads, cpu->owned, CPU_GRAIN, excess_range, &pass);
    for (size_t r = 0; r * CPU_GRAIN < cpu->owned; r++) {
        const float most = (float)cpu->partial[r].max_speed;
        all.mean += cpu->partial[r].mass;
        all.greatest = most > all.greatest ? most : all.greatest;
    }
    all.mean /= cpu->owned > 0 ? (double)cpu->owned : 1;
    return all;
}

static void sum_range(void *context, size_t begin, size_t end)
{
    const ExcessPass *pass = context;
    double sum = 0;
    for (size_t k = begin; k < end; k++)
        sum += (double)pass->column[cpu_owned(pass->cpu, k)];
    pass->cpu->partial[begin / CPU_GRAIN].mass = sum;
}

double cpu_sum(void *state, const ColumnDef *column)
{
    Cpu *cpu = state;
    ExcessPass pass = {cpu, *column_array(&cpu->now, column, 0)};
    double sum = 0;
    parallel_ranges(cpu->threads, cpu->owned, CPU_GRAIN, sum_range, &pass);
    for (size_t r = 0; r * CPU_GRAIN < cpu->owned; r++)
        sum += cpu->partial[r].mass;
    return sum;
}
