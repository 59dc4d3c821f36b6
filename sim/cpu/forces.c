/* Forces on box and solids. All that fluid particles are pushed with is m a at the kick; what boundary
   particles have of it is summed over pairs once more, for these alone. */
#include "sim/cpu/pass.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KICK_GRAIN = 4 * CPU_GRAIN }; /* of kick and drift */

static size_t ranges(size_t count, size_t grain)
{
    return (count + grain - 1) / grain;
}

bool cpu_feel(void *state, Forces *to, Error *error)
{
    Cpu *cpu = state;
    const Constants *s = cpu->constants;
    const size_t of_solids = ranges(s->boundary.count, CPU_GRAIN) * (size_t)s->solid_count,
                 of_guards = ranges(cpu->capacity, KICK_GRAIN) * (size_t)(s->solid_count + 1),
                 rows = of_solids > of_guards ? of_solids : of_guards;
    cpu->forces = NULL;
    if (to && !cpu->pushes && !(cpu->pushes = malloc(rows * sizeof *cpu->pushes)))
        return error_set(error, "no memory to sum forces");
    cpu->forces = to;
    return true;
}

typedef struct Kick {
    const Cpu *cpu;
    double dt;
} Kick;

static void kick_range(void *context, size_t begin, size_t end)
{
    const Kick *kick = context;
    const Cpu *cpu = kick->cpu;
    const CpuParticles *p = &cpu->now;
    Push *sum = &cpu->pushes[begin / KICK_GRAIN];
    *sum = (Push){.force = {0}};
    for (size_t i = begin, stop; cpu_run(cpu, &i, end, &stop); i = stop)
        for (; i < stop; i++) {
            const double m = -kick->dt * (double)cpu->constants->mass[p->fluid[i]];
            push_at(sum, (double[]){(double)p->x[i], (double)p->y[i], (double)p->z[i]},
                    (double[]){m * (double)p->ax[i], m * (double)p->ay[i], m * (double)p->az[i]});
        }
}

void cpu_feel_kick(Cpu *cpu, float dt)
{
    Kick kick = {cpu, (double)dt};
    parallel_ranges(cpu->threads, cpu->count, KICK_GRAIN, kick_range, &kick);
    for (size_t r = 0; r < ranges(cpu->count, KICK_GRAIN); r++)
        push_add(&cpu->forces->box, 1, &cpu->pushes[r]);
    cpu->forces->seconds += (double)dt;
}

Push *cpu_felt(Cpu *cpu, size_t begin)
{
    const size_t width = (size_t)cpu->constants->solid_count + 1;
    Push *felt = &cpu->pushes[begin / KICK_GRAIN * width];
    memset(felt, 0, width * sizeof *felt);
    return felt;
}

void cpu_feel_guard(Push *felt, float mass, const float x[3], const float v[3], float before[3])
{
    double at[3], impulse[3];
    for (int k = 0; k < 3; k++) {
        at[k] = (double)x[k];
        impulse[k] = (double)mass * ((double)before[k] - (double)v[k]);
        before[k] = v[k];
    }
    if (felt)
        push_at(felt, at, impulse);
}

/* To a solid what stands about the box's origin. */
static void add_to_solid(Cpu *cpu, size_t solid, Push *push)
{
    const float *x = cpu->solid[solid].end.x;
    push_about(push, (double[]){(double)x[0], (double)x[1], (double)x[2]});
    push_add(&cpu->forces->solid[solid], 1, push);
}

void cpu_feel_drift(Cpu *cpu)
{
    const size_t width = (size_t)cpu->constants->solid_count + 1;
    for (size_t r = 0; r < ranges(cpu->count, KICK_GRAIN); r++) {
        Push *felt = &cpu->pushes[r * width];
        push_add(&cpu->forces->box, 1, felt);
        for (size_t k = 1; k < width; k++)
            add_to_solid(cpu, k - 1, &felt[k]);
    }
}

typedef struct SolidPass {
    Cpu *cpu;
    SolidForce force;
    float dt;
} SolidPass;

/* What fluid particle i does to boundary particle b. */
static void add_pair(const SolidPass *pass, const float from[3], size_t i, size_t b, Push *sum)
{
    const CpuParticles *p = &pass->cpu->now;
    const float h = pass->cpu->constants->support_radius;
    SolidPair pair = {pass->cpu, pass->dt, i, b, {p->x[i] - from[0], p->y[i] - from[1], p->z[i] - from[2]},
                      0};
    const float *d = pair.d, r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    float force[3];
    pair.r = sqrtf(r2);
    if (pair.r >= h || pair.r < 1e-6F * h)
        return;
    pass->force(&pair, force);
    const double t = -(double)pass->dt;
    push_at(sum, (double[]){(double)p->x[b], (double)p->y[b], (double)p->z[b]},
            (double[]){t * (double)force[0], t * (double)force[1], t * (double)force[2]});
}

static void add_boundary(const SolidPass *pass, const PairArgs *args, size_t b, Push *sum)
{
    const Cpu *cpu = pass->cpu;
    const CpuParticles *p = &cpu->now;
    CellRow rows[CELL_ROWS];
    if (cpu->cell[b] == cpu->constants->cells.count)
        return;
    const int count = cell_rows(cpu->constants, args->cell_start, cpu->cell[b], rows);
    for (int row = 0; row < count; row++) {
        const float *shift = rows[row].shift,
                    from[3] = {p->x[b] + shift[0], p->y[b] + shift[1], p->z[b] + shift[2]};
        for (uint32_t k = cpu->fluid_before[rows[row].begin]; k < cpu->fluid_before[rows[row].end]; k++)
            add_pair(pass, from, cpu->fluid_at[k], b, sum);
    }
}

static void solid_range(void *context, size_t begin, size_t end)
{
    const SolidPass *pass = context;
    Cpu *cpu = pass->cpu;
    const PairArgs args = cpu_pair_args(cpu);
    const size_t solids = (size_t)cpu->constants->solid_count;
    Push *sums = &cpu->pushes[begin / CPU_GRAIN * solids];
    memset(sums, 0, solids * sizeof *sums);
    for (size_t k = begin; k < end; k++) {
        const size_t b = cpu->boundary_at[k];
        add_boundary(pass, &args, b, &sums[cpu->now.fluid[b] - FLUIDS_MAX]);
    }
}

/* The sums, in the order of ranges; what solids take the box does not. */
void cpu_feel_solids(Cpu *cpu, SolidForce force, float dt)
{
    const size_t count = cpu->constants->boundary.count, solids = (size_t)cpu->constants->solid_count;
    SolidPass pass = {cpu, force, dt};
    parallel_ranges(cpu->threads, count, CPU_GRAIN, solid_range, &pass);
    for (size_t k = 0; k < solids; k++) {
        Push all = {.force = {0}};
        for (size_t r = 0; r < ranges(count, CPU_GRAIN); r++)
            push_add(&all, 1, &cpu->pushes[r * solids + k]);
        push_add(&cpu->forces->box, -1, &all);
        add_to_solid(cpu, k, &all);
    }
}
