/* What a method's pass is on the CPU: loops over all particles, one behind the other, each in ranges side by
   side. */
#ifndef SLOSH_CPU_PASS_H
#define SLOSH_CPU_PASS_H

#include "sim/cpu/cpu.h"
#include "sim/matter/viscosity.h"
#include "sim/world/method.h"
#include "sim/world/micro.h"

typedef struct CpuRange {
    Cpu *cpu;
    const PairArgs *args;
    const PassInput *input;
    size_t begin, end;
} CpuRange;

typedef struct CpuLoop {
    void (*body)(const CpuRange *range);
    bool walks; /* over neighbours */
    /* Before a walk, for all particles: fills Cpu.place, .motion or both as the walk needs them. NULL: both.
     */
    void (*pack)(const CpuRange *range);
    bool packed; /* the pass before has filled them */
    bool solids; /* over the particles of solids too; else over runs of the fluids' alone */
} CpuLoop;

/* Fluid particle i next to boundary particle b. */
typedef struct SolidPair {
    const Cpu *cpu;
    float dt; /* of the step, s */
    size_t i, b;
    float d[3], r; /* x_i - x_b, m, and its length: in (0, h) */
} SolidPair;

/* What b pushes i with, N over Constants.unit_volume. */
typedef void (*SolidForce)(const SolidPair *pair, float force[3]);

typedef struct CpuPass {
    CpuLoop loops[3];                             /* ended by one without a body */
    PairCost (*pair)(const Constants *constants); /* counted as sim/world/micro.h says; NULL: no pairs */
    SolidForce solid; /* of the pass that has run; NULL: it pushes nothing that stays */
} CpuPass;

/* Whether the name is one of the list, which has blanks between them; as Pass.reads. */
bool cpu_name_among(const char *list, const char *name);

/* The pair sums of a range. */
static inline void cpu_pairs(const CpuRange *range, const PairLoops *loops)
{
    loops->in[range->cpu->pairs](range->args, range->begin, range->end);
}

/* sim/cpu/forces.c: adds what solids feel of a pass over dt (s). */
void cpu_feel_solids(Cpu *cpu, SolidForce force, float dt);

/* F U = -W'(r) / r of a kernel, 1/m2, times `scale`: of pairs that are few. */
static inline float cpu_slope(const Kernel *kernel, const SolidPair *pair, double scale)
{
    const Constants *s = pair->cpu->constants;
    const double r = (double)pair->r;
    return (float)(-scale * s->unit_volume * kernel->derivative(r, (double)s->support_radius) / r);
}

/* pair_viscosity of sim/matter/viscosity.h, Pa s, where forces have friction. */
static inline float cpu_pair_viscosity(const SolidPair *pair)
{
    const float *viscosity = pair->cpu->now.viscosity;
    return viscosity ? (float)pair_viscosity((double)viscosity[pair->i], (double)viscosity[pair->b])
                     : 2 * pair->cpu->constants->viscosity[0];
}

/* Forces as sums over pairs and walls become accelerations, surface tension among them. */
void cpu_force_end(const CpuRange *range);

/* sim/box/wall_cushion.h, behind cpu_force_end. */
void cpu_cushion(const CpuRange *range);

#endif
