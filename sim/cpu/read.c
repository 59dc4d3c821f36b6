/* Plotted sums of the state, computed on request. */
#include "sim/cpu/cpu.h"

#include "sim/step/backend.h"

#include <math.h>
#include <string.h>

enum { ENERGY_ALWAYS = offsetof(EnergySums, second) / sizeof(double) };

typedef struct GaugePass {
    const Cpu *cpu;
    const double *gravity;
    WorldGauge *partial; /* an entry per range */
} GaugePass;

static void gauge_range(void *context, size_t begin, size_t end)
{
    const GaugePass *pass = context;
    const Cpu *cpu = pass->cpu;
    const CpuParticles *p = &cpu->now;
    WorldGauge *gauge = &pass->partial[begin / CPU_GRAIN];
    *gauge = (WorldGauge){0};
    for (size_t k = begin; k < end; k++) {
        const size_t i = cpu_owned(cpu, k);
        const float x[3] = {p->x[i], p->y[i], p->z[i]}, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        gauge_add(gauge, cpu->constants, pass->gravity, p->fluid[i],
                  (double)particle_compression(p, cpu->constants, i), x, v);
    }
}

/* Sums in a fixed order for any number of threads; shares the memory of `sums`. */
bool cpu_gauge(void *state, const double gravity[3])
{
    Cpu *cpu = state;
    WorldGauge *gauge = &cpu->gauge;
    _Static_assert(sizeof(WorldGauge) <= sizeof(WorldSums), "their memory is shared");
    GaugePass pass = {cpu, gravity, (WorldGauge *)(void *)cpu->partial};
    parallel_ranges(cpu->threads, cpu->owned, CPU_GRAIN, gauge_range, &pass);
    *gauge = (WorldGauge){0};
    for (size_t r = 0; r < (cpu->owned + CPU_GRAIN - 1) / CPU_GRAIN; r++) {
        const WorldGauge *part = &pass.partial[r];
        gauge->density_error_mean += part->density_error_mean;
        gauge->density_error_max = fmax(gauge->density_error_max, part->density_error_max);
        gauge->kinetic_energy += part->kinetic_energy;
        gauge->potential_energy += part->potential_energy;
        gauge->compression_energy += part->compression_energy;
    }
    gauge->density_error_mean /= cpu->owned > 0 ? (double)cpu->owned : 1;
    return true;
}

bool cpu_gauged(void *state, WorldGauge *gauge, bool waits)
{
    (void)waits;
    const Cpu *cpu = state;
    const double time = gauge->time;
    *gauge = cpu->gauge;
    gauge->time = time;
    return true;
}

typedef struct EnergyPass {
    const Cpu *cpu;
    bool turning;
    ExactSum *sums;
} EnergyPass;

/* Surface of the fluid in a cell, m2: sides between the cell and empty cells. For a ball, 1.3 to 1.5 times
   the ball's surface; for a particle alone in a cell, all sides. */
static double bare_sides(const Cpu *cpu, size_t i)
{
    const Constants *s = cpu->constants;
    const uint32_t cell = cpu->cell[i], *start = cpu->cell_start;
    const uint32_t step[3] = {1, (uint32_t)s->cells.size[0], (uint32_t)(s->cells.size[0] * s->cells.size[1])};
    int bare = 0;
    for (int k = 0; k < 3 && k < s->dimensions && cell < s->cells.count; k++) {
        const uint32_t low = cell_fold_of(&cpu->fold, &s->cells, cell - step[k]),
                       high = cell_fold_of(&cpu->fold, &s->cells, cell + step[k]);
        bare += (start[low + 1] == start[low]) + (start[high + 1] == start[high]);
    }
    return bare * pow((double)s->support_radius, s->dimensions - 1);
}

/* Adds the own particles of a cell from the k-th on, before `last`. Returns the first particle of the next
   cell. */
static size_t energy_cell(const EnergyPass *pass, size_t k, size_t last, EnergySums *sums)
{
    const Cpu *cpu = pass->cpu;
    const CpuParticles *p = &cpu->now;
    if (cpu->constants->tension_model != TENSION_NONE && cpu->gridded == cpu->count)
        sums->bare = bare_sides(cpu, cpu_owned(cpu, k));
    do {
        const size_t i = cpu_owned(cpu, k);
        const float x[3] = {p->x[i], p->y[i], p->z[i]}, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        energy_add(sums, cpu->constants, p->fluid[i], (double)particle_compression(p, cpu->constants, i), x,
                   v, pass->turning);
    } while (++k < last && cpu_cell_goes_on(cpu, k));
    return k;
}

/* Adds each cell's sums exactly: energies decide about steps, and ranks must get the same bits. */
static void energy_range(void *context, size_t begin, size_t end)
{
    const EnergyPass *pass = context;
    const size_t last = cpu_cell_first(pass->cpu, end);
    const int count = pass->turning ? ENERGY_SUMS : ENERGY_ALWAYS;
    ExactSum sums[ENERGY_SUMS] = {{.strange = false}};
    for (size_t k = cpu_cell_first(pass->cpu, begin); k < last;) {
        EnergySums cell = {0};
        double each[ENERGY_SUMS];
        k = energy_cell(pass, k, last, &cell);
        memcpy(each, &cell, sizeof each);
        for (int s = 0; s < count; s++)
            exact_add(&sums[s], each[s]);
    }
    parallel_lock();
    for (int s = 0; s < count; s++)
        exact_merge(&pass->sums[s], &sums[s]);
    parallel_unlock();
}

void cpu_energy_part(Cpu *cpu, bool turning, ExactSum sums[ENERGY_SUMS])
{
    EnergyPass pass = {cpu, turning, sums};
    parallel_ranges(cpu->threads, cpu->owned, 8 * CPU_GRAIN, energy_range, &pass);
}

void cpu_energy(void *state, bool turning, EnergySums *sums)
{
    ExactSum all[ENERGY_SUMS] = {{.strange = false}};
    double each[ENERGY_SUMS];
    cpu_energy_part(state, turning, all);
    for (int s = 0; s < ENERGY_SUMS; s++)
        each[s] = exact_value(&all[s]);
    memcpy(sums, each, sizeof *sums);
}

/* Reads of the state: copies and sums. */

typedef struct ReadJob {
    const Cpu *cpu;
    const ParticleArrays *out;
} ReadJob;

static void read_range(void *context, size_t begin, size_t end)
{
    const ReadJob *read = context;
    particles_read(&read->cpu->now, read->cpu->constants, read->cpu->owned_at, begin, end, read->out);
}

bool cpu_read(void *state, const ParticleArrays *out)
{
    Cpu *cpu = state;
    ReadJob read = {cpu, out};
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
        if (cell_row_repeats(args->constants, &rows[row]))
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
