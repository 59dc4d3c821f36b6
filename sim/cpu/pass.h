/* A method's pass on the CPU: loops over all particles in sequence, each loop in parallel ranges. */
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
    /* Before a walk, for all particles: fills Cpu.place, .motion or both, as the walk requires. NULL:
       both. */
    void (*pack)(const CpuRange *range);
    bool packed; /* the previous pass has filled them */
    bool solids; /* also over boundary particles; otherwise over runs of own fluid particles */
} CpuLoop;

/* Fluid particle i next to boundary particle b. */
typedef struct SolidPair {
    const Cpu *cpu;
    float dt; /* of the step, s */
    size_t i, b;
    float d[3], r; /* x_i - x_b, m; its length in (0, h) */
} SolidPair;

/* Force of b on i, N in units of Constants.unit_volume. */
typedef void (*SolidForce)(const SolidPair *pair, float force[3]);

typedef struct CpuPass {
    CpuLoop loops[3];                             /* ended by a loop without a body */
    PairCost (*pair)(const Constants *constants); /* counted as in sim/world/micro.h; NULL: no pairs */
    SolidForce solid; /* for forces on solids, after the pass; NULL: no lasting force on solids */
} CpuPass;

/* True if `name` is in the blank-separated list, as in Pass.reads. */
bool cpu_name_among(const char *list, const char *name);

/* Runs the pair sums of a range. */
static inline void cpu_pairs(const CpuRange *range, const PairLoops *loops)
{
    loops->in[range->cpu->pairs](range->args, range->begin, range->end);
}

/* sim/cpu/forces.c: adds the forces of a pass on solids over dt (s). */
void cpu_feel_solids(Cpu *cpu, SolidForce force, float dt);

/* F U = -W'(r) / r of a kernel, 1/m2, times `scale`: for few pairs. */
static inline float cpu_slope(const Kernel *kernel, const SolidPair *pair, double scale)
{
    const Constants *s = pair->cpu->constants;
    const double r = (double)pair->r;
    return (float)(-scale * s->unit_volume * kernel->derivative(r, (double)s->support_radius) / r);
}

/* pair_viscosity of sim/matter/viscosity.h, Pa s, for forces with friction. */
static inline float cpu_pair_viscosity(const SolidPair *pair)
{
    const float *viscosity = pair->cpu->now.viscosity;
    return viscosity ? (float)pair_viscosity((double)viscosity[pair->i], (double)viscosity[pair->b])
                     : 2 * pair->cpu->constants->viscosity[0];
}

/* Adds surface tension, then turns the summed forces into accelerations. */
void cpu_force_end(const CpuRange *range);

/* Adds sim/box/wall_cushion.h; call after cpu_force_end. */
void cpu_cushion(const CpuRange *range);

#endif
