/* Emitters, guides and drains, between steps. */
#include "sim/cpu/cpu.h"
#include "sim/matter/fill.h"

#include <math.h>

static const float ROOM = 0.9f; /* least distance to present particles, in spacings */

/* True if no particle is near x: neither a particle in the grid nor a particle added since the grid. */
bool cpu_has_room(Cpu *cpu, const float x[3])
{
    const PairArgs pairs = cpu_pair_args(cpu), *args = &pairs;
    const float least = ROOM * cpu->constants->spacing;
    const uint32_t cell = cpu_cell_of(cpu->constants, x);
    CellRow rows[CELL_ROWS];
    const int row_count = cell_rows(args->constants, args->fold, args->cell_start, cell, rows);
    for (int row = 0; row < row_count; row++) {
        const float *shift = rows[row].shift;
        for (uint32_t j = rows[row].begin; j < rows[row].end; j++) {
            const float d[3] = {x[0] + shift[0] - args->x[j], x[1] + shift[1] - args->y[j],
                                x[2] + shift[2] - args->z[j]};
            if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < least * least)
                return false;
        }
    }
    for (size_t j = cpu->gridded; j < cpu->count; j++) {
        float d[3] = {x[0] - args->x[j], x[1] - args->y[j], x[2] - args->z[j]};
        periodic_nearest(&cpu->constants->periodic, d);
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < least * least)
            return false;
    }
    for (int k = 0; k < cpu->constants->solid_count; k++) {
        const float half = 0.5f * cpu->constants->spacing;
        if (solid_clearance(&cpu->constants->solids[k], &cpu->solid[k].end, cpu->constants->dimensions, x,
                            half) < half * 0.999f)
            return false;
    }
    return true;
}

void cpu_append(Cpu *cpu, const EmitLayer *layer, const float x[3], size_t number)
{
    const CpuParticles *p = &cpu->now;
    const size_t i = cpu->count++;
    columns_clear(&cpu->sorted, p, i);
    p->x[i] = x[0], p->y[i] = x[1], p->z[i] = x[2];
    p->vx[i] = layer->velocity[0], p->vy[i] = layer->velocity[1], p->vz[i] = layer->velocity[2];
    p->id[i] = layer->first_id + number;
    p->fluid[i] = (uint8_t)layer->fluid;
    if (cpu->ghost)
        cpu->ghost[i] = 0;
    if (cpu->owned_at)
        cpu->owned_at[cpu->owned] = (uint32_t)i;
    cpu->owned++;
}

size_t cpu_emit(void *state, const EmitLayer *layer, size_t most)
{
    Cpu *cpu = state;
    size_t number = 0;
    for (size_t k = 0; k < layer->count && number < most; k++) {
        const float *x = layer->position + 3 * k;
        if (walls_contain(&cpu->constants->walls, x) && cpu_has_room(cpu, x))
            cpu_append(cpu, layer, x, number++);
    }
    return number;
}

typedef struct Guiding {
    Cpu *cpu;
    const Guide *guides;
    int count;
    ExactSum *work;
} Guiding;

/* Adds the work of setting a particle to the guide's velocity: impulse times guide velocity, as for a
   moving wall. Owners count the work of ghosts. */
static void guide_one(const Guiding *pass, size_t i, const float to[3], ExactSum *work)
{
    const Cpu *cpu = pass->cpu;
    const CpuParticles *p = &cpu->now;
    const float v[3] = {p->vx[i], p->vy[i], p->vz[i]};
    double gain = 0;
    for (int k = 0; k < 3; k++)
        gain += (double)to[k] * ((double)to[k] - (double)v[k]);
    if (cpu_owns(cpu, i))
        exact_add(work, constants_mass(cpu->constants, p->fluid[i]) * gain);
    p->vx[i] = to[0], p->vy[i] = to[1], p->vz[i] = to[2];
}

static void guide_range(void *context, size_t begin, size_t end)
{
    const Guiding *pass = context;
    const CpuParticles *p = &pass->cpu->now;
    ExactSum work = {.strange = false};
    for (size_t i = begin; i < end; i++) {
        const float x[3] = {p->x[i], p->y[i], p->z[i]};
        for (int k = 0; k < pass->count; k++)
            if (guide_holds(&pass->guides[k], &pass->cpu->constants->periodic, p->fluid[i], x))
                guide_one(pass, i, pass->guides[k].velocity, &work);
    }
    parallel_lock();
    exact_merge(pass->work, &work);
    parallel_unlock();
}

double cpu_guide(void *state, const Guide *guides, int count)
{
    Cpu *cpu = state;
    ExactSum work = {.strange = false};
    Guiding pass = {cpu, guides, count, &work};
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, guide_range, &pass);
    if (cpu->sum_all)
        cpu->sum_all(&work, 1);
    return exact_value(&work);
}

static bool drains(const Fill *regions, int count, int dimensions, const double x[3])
{
    for (int k = 0; k < count; k++)
        if (fill_holds(&regions[k], dimensions, x, 0))
            return true;
    return false;
}

size_t cpu_drain(void *state, const Fill *regions, int count)
{
    Cpu *cpu = state;
    const CpuParticles *p = &cpu->now;
    size_t gone = 0;
    for (size_t i = 0; i < cpu->count;) {
        const double x[3] = {p->x[i], p->y[i], p->z[i]};
        if (!cpu_owns(cpu, i) || !drains(regions, count, cpu->constants->dimensions, x)) {
            i++;
            continue;
        }
        columns_move(&cpu->sorted, p, --cpu->count, i);
        if (cpu->ghost)
            cpu->ghost[i] = cpu->ghost[cpu->count];
        gone++;
    }
    cpu->owned -= gone;
    if (gone > 0 && cpu->owned_at)
        cpu_find(cpu);
    return gone;
}
