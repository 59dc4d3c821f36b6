/* Reads of the state: copies and sums. */
#include "sim/cpu/cpu.h"
#include "sim/world/sums.h"

#include <math.h>
#include <string.h>

typedef struct Read {
    const Cpu *cpu;
    const ParticleArrays *out;
} Read;

static void read_range(void *context, size_t begin, size_t end)
{
    const Read *read = context;
    particles_read(&read->cpu->now, read->cpu->constants, read->cpu->owned_at, begin, end, read->out);
}

bool cpu_read(void *state, const ParticleArrays *out)
{
    Cpu *cpu = state;
    Read read = {cpu, out};
    parallel_ranges(cpu->threads, cpu->owned, 4 * CPU_GRAIN, read_range, &read);
    return true;
}

/* Number of fluid neighbours with r < h, without boundary particles. */
static int neighbours_of(const Cpu *cpu, const PairArgs *args, size_t i)
{
    const float h2 = args->constants->support_radius * args->constants->support_radius;
    int count = -1; /* without the particle itself */
    CellRow rows[CELL_ROWS];
    const int row_count = cell_rows(args->constants, args->fold, args->cell_start, args->cell[i], rows);
    for (int row = 0; row < row_count; row++) {
        if (cell_row_again(args->constants, &rows[row]))
            continue;
        for (uint32_t j = rows[row].begin; j < rows[row].end; j++) {
            float d[3] = {args->x[i] - args->x[j], args->y[i] - args->y[j], args->z[i] - args->z[j]};
            periodic_nearest(&args->constants->periodic, d); /* for particles that crossed a side since the
                                                                grid */
            count += d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < h2 && cpu->now.fluid[j] < FLUIDS_MAX;
        }
    }
    return count;
}

static void add_particle(const Cpu *cpu, const PairArgs *args, size_t i, WorldSums *sums)
{
    const CpuParticles *p = &cpu->now;
    const double x[3] = {p->x[i], p->y[i], p->z[i]}, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
    sums_add(sums, constants_mass(cpu->constants, p->fluid[i]), x, v);
    sums->neighbours_mean += neighbours_of(cpu, args, i);
}

typedef struct SumPass {
    const Cpu *cpu;
    PairArgs args;
    WorldSums *partial; /* an entry per range */
} SumPass;

static void sum_range(void *context, size_t begin, size_t end)
{
    SumPass *pass = context;
    WorldSums *sums = &pass->partial[begin / CPU_GRAIN];
    for (size_t k = begin; k < end; k++)
        add_particle(pass->cpu, &pass->args, cpu_owned(pass->cpu, k), sums);
}

static void add_sums(const WorldSums *part, WorldSums *sums)
{
    sums->mass += part->mass;
    for (int k = 0; k < 3; k++) {
        sums->momentum[k] += part->momentum[k];
        sums->angular_momentum[k] += part->angular_momentum[k];
        sums->centre[k] += part->centre[k];
    }
    sums->momentum_scale += part->momentum_scale;
    sums->angular_scale += part->angular_scale;
    sums->kinetic_energy += part->kinetic_energy;
    sums->max_speed = fmax(sums->max_speed, part->max_speed);
    sums->neighbours_mean += part->neighbours_mean;
}

void cpu_sums(void *state, WorldSums *sums)
{
    Cpu *cpu = state;
    const size_t ranges = (cpu->owned + CPU_GRAIN - 1) / CPU_GRAIN;
    SumPass pass = {cpu, cpu_pair_args(cpu), cpu->partial};
    *sums = (WorldSums){0};
    memset(cpu->partial, 0, ranges * sizeof *cpu->partial);
    parallel_ranges(cpu->threads, cpu->owned, CPU_GRAIN, sum_range, &pass);
    for (size_t r = 0; r < ranges; r++)
        add_sums(&pass.partial[r], sums);
    for (int k = 0; k < 3 && cpu->owned > 0; k++)
        sums->centre[k] /= sums->mass;
    sums->neighbours_mean /= cpu->owned > 0 ? (double)cpu->owned : 1;
}
