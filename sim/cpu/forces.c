/* Forces on box and solids. The total force on the fluid is m a at the kick. The part on boundary particles
   is summed over pairs in a separate loop, only on request. */
#include "sim/cpu/felt.h"
#include "sim/cpu/pass.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KICK_GRAIN = 4 * CPU_GRAIN };

bool cpu_feel(void *state, Forces *to, Error *error)
{
    Cpu *cpu = state;
    cpu->forces = NULL;
    if (to && !cpu->felt && !(cpu->felt = malloc(sizeof *cpu->felt)))
        return error_set(error, "no memory to sum forces");
    cpu->forces = to;
    return true;
}

/* ---- sums ---- */

void cpu_felt_begin(Cpu *cpu)
{
    memset(cpu->felt, 0, sizeof *cpu->felt);
}

void cpu_felt_add(CpuFelt *felt, int whom, const Push *push)
{
    ExactSum *number;
    if (!felt->any)
        memset(felt, 0, sizeof *felt);
    felt->any = true;
    number = felt->of[whom].number;
    for (int k = 0; k < 3; k++) {
        exact_add(&number[k], push->force[k]);
        exact_add(&number[3 + k], push->torque[k]);
    }
}

void cpu_felt_merge(Cpu *cpu, const CpuFelt *felt)
{
    if (!felt->any)
        return;
    parallel_lock();
    for (int whom = 0; whom <= cpu->constants->solid_count; whom++)
        for (int k = 0; k < PUSH_NUMBERS; k++)
            exact_merge(&cpu->felt->of[whom].number[k], &felt->of[whom].number[k]);
    parallel_unlock();
}

/* The sums over all processes of the world, as force times time. */
static void sum_up(Cpu *cpu, Push out[FELT_MOST])
{
    const int width = cpu->constants->solid_count + 1;
    const double unit = cpu->constants->unit_volume; /* forces are in units of U */
    if (cpu->sum_all)
        cpu->sum_all(cpu->felt->of[0].number, width * PUSH_NUMBERS);
    for (int whom = 0; whom < width; whom++)
        for (int k = 0; k < 3; k++) {
            out[whom].force[k] = unit * exact_value(&cpu->felt->of[whom].number[k]);
            out[whom].torque[k] = unit * exact_value(&cpu->felt->of[whom].number[3 + k]);
        }
}

/* Adds to a solid a push given about the box's origin. */
static void add_to_solid(Cpu *cpu, int solid, Push *push)
{
    const float *x = cpu->solid[solid].end.x;
    push_about(push, (double[]){(double)x[0], (double)x[1], (double)x[2]});
    push_add(&cpu->forces->solid[solid], 1, push);
}

/* ---- the kick ---- */

typedef struct Kick {
    Cpu *cpu;
    double dt;
} Kick;

static void kick_range(void *context, size_t begin, size_t end)
{
    const Kick *kick = context;
    Cpu *cpu = kick->cpu;
    const CpuParticles *p = &cpu->now;
    const size_t last = cpu_cell_first(cpu, end);
    CpuFelt felt;
    felt.any = false;
    for (size_t k = cpu_cell_first(cpu, begin); k < last;) {
        Push of_cell = {.force = {0}};
        do {
            const size_t i = cpu_owned(cpu, k);
            const double m = -kick->dt * (double)cpu->constants->mass[p->fluid[i]];
            push_at(&of_cell, (double[]){(double)p->x[i], (double)p->y[i], (double)p->z[i]},
                    (double[]){m * (double)p->ax[i], m * (double)p->ay[i], m * (double)p->az[i]});
        } while (++k < last && cpu_cell_goes_on(cpu, k));
        cpu_felt_add(&felt, 0, &of_cell);
    }
    cpu_felt_merge(cpu, &felt);
}

void cpu_feel_kick(Cpu *cpu, float dt)
{
    Kick kick = {cpu, (double)dt};
    Push all[FELT_MOST];
    cpu_felt_begin(cpu);
    parallel_ranges(cpu->threads, cpu->owned, KICK_GRAIN, kick_range, &kick);
    sum_up(cpu, all);
    push_add(&cpu->forces->box, 1, &all[0]);
    cpu->forces->seconds += (double)dt;
}

/* ---- guards ---- */

void cpu_feel_guard(CpuFelt *felt, int whom, float mass, const float x[3], const float v[3], float before[3])
{
    Push push = {.force = {0}};
    double at[3], impulse[3];
    for (int k = 0; k < 3; k++) {
        at[k] = (double)x[k];
        impulse[k] = (double)mass * ((double)before[k] - (double)v[k]);
        before[k] = v[k];
    }
    if (!felt)
        return;
    push_at(&push, at, impulse);
    cpu_felt_add(felt, whom, &push);
}

void cpu_feel_drift(Cpu *cpu)
{
    Push all[FELT_MOST];
    sum_up(cpu, all);
    push_add(&cpu->forces->box, 1, &all[0]);
    for (int k = 0; k < cpu->constants->solid_count; k++)
        add_to_solid(cpu, k, &all[1 + k]);
}

/* ---- pairs with boundary particles ---- */

typedef struct SolidPass {
    Cpu *cpu;
    SolidForce force;
    float dt;
} SolidPass;

/* Push of fluid particle i on boundary particle b. */
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

/* Adds the fluid in entries [begin, end) of Cpu.fluid_at, cell by cell. Ghosts are left to their owners. */
static void add_fluid(const SolidPass *pass, const float from[3], size_t begin, size_t end, size_t b,
                      CpuFelt *felt)
{
    const Cpu *cpu = pass->cpu;
    const int whom = 1 + cpu->now.fluid[b] - FLUIDS_MAX;
    for (size_t k = begin; k < end;) {
        Push of_cell = {.force = {0}};
        const uint32_t cell = cpu->cell[cpu->fluid_at[k]];
        const bool own = cpu_owns(cpu, cpu->fluid_at[k]);
        for (; k < end && cpu->cell[cpu->fluid_at[k]] == cell; k++)
            if (own)
                add_pair(pass, from, cpu->fluid_at[k], b, &of_cell);
        if (own)
            cpu_felt_add(felt, whom, &of_cell);
    }
}

static void add_boundary(const SolidPass *pass, const PairArgs *args, size_t b, CpuFelt *felt)
{
    const Cpu *cpu = pass->cpu;
    const CpuParticles *p = &cpu->now;
    CellRow rows[CELL_ROWS];
    if (cpu->cell[b] == cpu->constants->cells.count)
        return;
    const int count = cell_rows(cpu->constants, args->fold, args->cell_start, cpu->cell[b], rows);
    for (int row = 0; row < count; row++) {
        const float *shift = rows[row].shift,
                    from[3] = {p->x[b] + shift[0], p->y[b] + shift[1], p->z[b] + shift[2]};
        add_fluid(pass, from, cpu->fluid_before[rows[row].begin], cpu->fluid_before[rows[row].end], b, felt);
    }
}

static void solid_range(void *context, size_t begin, size_t end)
{
    const SolidPass *pass = context;
    const PairArgs args = cpu_pair_args(pass->cpu);
    CpuFelt felt;
    felt.any = false;
    for (size_t k = begin; k < end; k++)
        add_boundary(pass, &args, pass->cpu->boundary_at[k], &felt);
    cpu_felt_merge(pass->cpu, &felt);
}

/* A push on a solid is taken off the box. */
void cpu_feel_solids(Cpu *cpu, SolidForce force, float dt)
{
    SolidPass pass = {cpu, force, dt};
    Push all[FELT_MOST];
    cpu_felt_begin(cpu);
    parallel_ranges(cpu->threads, cpu->constants->boundary.count, CPU_GRAIN, solid_range, &pass);
    sum_up(cpu, all);
    for (int k = 0; k < cpu->constants->solid_count; k++) {
        push_add(&cpu->forces->box, -1, &all[1 + k]);
        add_to_solid(cpu, k, &all[1 + k]);
    }
}
