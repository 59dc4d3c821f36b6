/* The CPU backend's state: structure of arrays, sorted by cell, and the grid that sorts it. */
#ifndef SLOSH_CPU_H
#define SLOSH_CPU_H

#include "sim/backend.h"
#include "sim/cpu/pairs.h"
#include "sim/cpu/parallel.h"

typedef ParticleColumns CpuParticles; /* what moves when particles are sorted */

typedef struct Cpu {
    const Solver *solver;
    const PairOps *pairs;
    int threads;
    size_t count;
    CpuParticles now, spare;     /* `spare` is what `grid` sorts into; then they change places */
    float *volume, *pressure;    /* by `density`: 1 / n, m3; Pa */
    float *pressure_term;        /* by `density`: p V^2, J m3 */
    float *viscosity;            /* by `density`: Pa s; NULL with one fluid or none viscous */
    float *artificial;           /* wcsph's, as PairArgs has it; NULL: none */
    float *relative;             /* wcsph's, for the diffusion of density; NULL: none */
    float *tension;              /* as PairArgs has it; NULL: none */
    float *kind;                 /* the fluid as a number, for these two; NULL: not needed */
    float *ax, *ay, *az;         /* by `force`, m/s2; `ax` also by `continuity` */
    uint32_t *cell, *spare_cell; /* by `grid`: of each particle, sorted; before the sort */
    uint32_t *rank;              /* by `grid`: place within the cell before its sort by id */
    uint32_t *order;             /* by `grid`: old place of each new one */
    uint32_t *cell_start;        /* by `grid`: cells + 1 */
    WorldSums *partial;          /* by `sums`: one a range */
    size_t bytes;                /* of all these */
    size_t guarded;              /* atomic */
    StepWatch watch;             /* by `kick`; atomic while it runs */
} Cpu;

enum { CPU_GRAIN = 512 }; /* particles in a range: some 0.2 ms of work, small against a step */

PairArgs cpu_pair_args(const Cpu *cpu);

/* What the pair sums need of particle i's fluid, of the terms that the scene names. */
static inline void cpu_fill_terms(Cpu *cpu, size_t i)
{
    const Solver *s = cpu->solver;
    const int fluid = cpu->now.fluid[i];
    if (cpu->viscosity)
        cpu->viscosity[i] = s->viscosity[fluid];
    if (cpu->artificial)
        cpu->artificial[i] = s->artificial_viscosity[fluid];
    if (cpu->tension)
        cpu->tension[i] = s->tension[fluid];
    if (cpu->kind)
        cpu->kind[i] = (float)fluid;
}

void cpu_grid(void *state);
void cpu_density(void *state);
void cpu_continuity(void *state, float dt);

/* Of wcsph: volume, pressure and the pair sums' arrays, from the density that is carried. */
void cpu_equation_of_state(Cpu *cpu);
void cpu_force(void *state, const ApparentGravity *gravity);
void cpu_drift(void *state, const FrameStep *step);
StepWatch cpu_kick(void *state, const float gravity[3], float dt);
void cpu_sums(void *state, WorldSums *sums);
void cpu_read(void *state, const ParticleArrays *out);

#endif
